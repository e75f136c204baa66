// Any bytes as a table of readings: refused with a line, or read, written and read again as the
// same text; what the machine would read at these positions is finite.
#include <cmath>

#include "base/alarm.h"
#include "emulator/replay.h"
#include "fuzz/machine.h"
#include "fuzz/target.h"
#include "records/readings.h"

namespace {

using namespace trunnion;

void check_table(std::string_view text) {
    std::vector<std::string> notes;
    const setup::Setup& setup = fuzz::machine();
    const auto& names = setup.machine.chain.names();
    const records::ReadingTable table = records::parse_readings(text, "f.csv", notes, names);
    const std::string once = records::format_readings(table);
    const records::ReadingTable again = records::parse_readings(once, "again.csv", notes, names);
    fuzz::law(records::format_readings(again) == once, "a table that was written reads back");
    const emulator::Replay replay(setup, table);
    for (const double value : replay.predict(setup.machine, {}, {}))
        fuzz::law(std::isfinite(value), "predictions are finite");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        check_table(fuzz::text_of(data, size));
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
