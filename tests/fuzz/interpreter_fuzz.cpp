// Any bytes: the language neither crashes nor hangs, and printing is a fixpoint (law 3).
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/target.h"
#include "interpreter/interpreter.h"
#include "interpreter/print.h"

namespace {

using namespace trunnion;

struct AnySystem : interpreter::SystemVariables {
    double get(int number) override { return number % 7; }
    void set(int, double, const char*) override {}
    double parameter(int number, int bit, int axis) override { return number + bit + axis; }
};

void run(std::string_view text) {
    interpreter::ProgramsInMemory none;
    AnySystem system;
    interpreter::InterpreterOptions options;
    options.max_blocks = 2000;
    options.skip_switches[2] = true;
    options.calls.m[6] = {9001, false, false};
    options.calls.g[1000] = {9010, true, true};
    options.calls.t_calls_9000 = true;
    interpreter::Interpreter nc(none, options, system, [](std::string_view) {});
    try {
        nc.open(interpreter::ProgramText{"fuzz", text, nullptr});
        while (const interpreter::BlockWords* words = nc.next())
            if (words->count > 1) nc.block_moved();
        ++fuzz::accepted;
    } catch (const Alarm& alarm) {
        if (alarm.where.line < 1) std::abort();
    }
}

void check_fixpoint(std::string_view text) {
    const interpreter::ParsedProgram a = interpreter::parse_program({"a", text, nullptr}, {});
    const std::string once = interpreter::print_program(a);
    const interpreter::ParsedProgram b = interpreter::parse_program({"b", once, nullptr}, {});
    if (!b.faults.empty() || a.blocks.size() != b.blocks.size()) std::abort();
    for (std::size_t i = 0; i < a.blocks.size(); ++i)
        if (!interpreter::same_block(a, a.blocks[i], b, b.blocks[i])) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    run(text);
    check_fixpoint(text);
    return 0;
}
