// Any bytes as a setup file: refused with a place, or read; what was read is written and read again
// as the same text.
#include "base/alarm.h"
#include "fuzz/target.h"
#include "setup/setup.h"

namespace {

using namespace trunnion;

void check_again(const setup::Setup& read) {
    std::vector<std::string> notes;
    const std::string once = setup::format_setup(read);
    try {
        const std::string twice =
            setup::format_setup(setup::parse_setup(once, "again.toml", notes));
        fuzz::law(once == twice, "a setup that was written reads back as the same");
    } catch (const InputError&) {
        fuzz::law(false, "a setup that was written can be read");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> notes;
    try {
        check_again(setup::parse_setup(std::string(fuzz::text_of(data, size)), "f.toml", notes));
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
