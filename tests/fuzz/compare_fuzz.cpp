// Any two programs, cut at 0x1E: the answer is the same from both sides, and a program equals
// itself.
#include <memory>

#include "base/alarm.h"
#include "fuzz/machine.h"
#include "fuzz/target.h"
#include "regression/compare_programs.h"

namespace {

using namespace trunnion;

interpreter::ProgramText program(const char* name, std::string_view text) {
    const auto owner = std::make_shared<const std::string>(text);
    return {name, *owner, owner};
}

bool equal(std::string_view a, std::string_view b) {
    regression::CompareOptions options;
    options.max_blocks = 300;
    const setup::Setup& setup = fuzz::machine();
    return regression::compare_programs(program("a.nc", a), setup, program("b.nc", b), setup,
                                        options)
        .equal;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const std::size_t cut = text.find('\x1e');
    const std::string_view a = text.substr(0, cut);
    const std::string_view b = cut == std::string_view::npos ? a : text.substr(cut + 1);
    try {
        fuzz::law(equal(a, b) == equal(b, a), "equal is the same from both sides");
        fuzz::law(a != b || equal(a, b), "a program equals itself");
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
