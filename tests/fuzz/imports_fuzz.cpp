// Any bytes as a file of an instrument, the first byte says of which kind: refused with a place, or
// readings that the product itself reads.
#include <array>

#include "base/alarm.h"
#include "fuzz/machine.h"
#include "fuzz/target.h"
#include "imports/import.h"
#include "records/readings.h"

namespace {

using namespace trunnion;
using imports::ImportKind;

void import_as(ImportKind kind, std::string_view text) {
    const std::vector<imports::ImportFile> files{{"f.txt", std::string(text)}};
    const setup::Setup& setup = fuzz::machine();
    const imports::ImportRequest request{setup, files, imports::Facts({"axis=X"}), {}};
    const imports::Imported imported = imports::import_readings(kind, request);
    std::vector<std::string> notes;
    try {
        records::parse_readings(imported.readings, "out.csv", notes, setup.machine.chain.names());
    } catch (const InputError& e) {
        fuzz::law(false, e.what());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::array kinds{ImportKind::ballbar,  ImportKind::iso230_2, ImportKind::points,
                               ImportKind::axis_log, ImportKind::table,    ImportKind::dprnt,
                               ImportKind::pointing};
    if (size == 0) return 0;
    try {
        import_as(kinds[data[0] % kinds.size()], fuzz::text_of(data + 1, size - 1));
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
