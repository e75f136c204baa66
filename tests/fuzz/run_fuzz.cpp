// Any bytes as a program on the whole machine: probe, sphere, truth and trace. It ends with a
// result; its readings are finite.
#include <cmath>

#include "base/alarm.h"
#include "emulator/run.h"
#include "fuzz/machine.h"
#include "fuzz/target.h"

namespace {

using namespace trunnion;

void check_run(std::string_view text) {
    const auto owner = std::make_shared<const std::string>(text);
    interpreter::ProgramsInMemory programs;
    emulator::RunOptions options;
    options.trace = options.truth = true;
    options.budget.blocks = 300;
    options.budget.rows = 500;
    options.budget.printed_bytes = 10'000;
    const emulator::RunLog log = emulator::run_program(
        fuzz::machine(), programs, interpreter::ProgramText{"f.nc", *owner, owner}, options);
    fuzz::law(!log.result.alarm || log.result.alarm->where.line > 0, "an alarm has a line");
    for (const records::Reading& row : log.readings.rows)
        fuzz::law(!row.value_mm || std::isfinite(*row.value_mm), "readings are finite");
    fuzz::law(log.trace_csv.find("nan") == std::string::npos, "the trace has no NaN");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        check_run(fuzz::text_of(data, size));
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
