// Any bytes as the log of a control that ran a small program: refused with a place, or a gap in
// finite numbers.
#include <cmath>
#include <memory>
#include <string>

#include "base/alarm.h"
#include "choices/control_gap.h"
#include "choices/control_path.h"
#include "fuzz/machine.h"
#include "fuzz/target.h"
#include "imports/position_log.h"
#include "interpreter/program_folders.h"

namespace {

using namespace trunnion;

/// A search takes longer with each row; what reads a log has met all its cells before.
constexpr std::size_t most_rows = 24;

interpreter::ProgramText program() {
    static const auto text = std::make_shared<const std::string>(
        "O1\nN1 G90 G21 G54\nN2 G0 X0 Y0 Z0\nN3 G1 X10. F500.\nN4 G2 X20. Y10. R10.\nN5 G0 B30. "
        "C45.\nN6 G43.4 H1 X5. Y5. Z50.\nN7 G1 X8. B20.\nM30\n");
    return {"part.nc", *text, text};
}

void judge(const records::PositionLog& log) {
    interpreter::ProgramFolders folders({});
    folders.add_file(program());
    const choices::GapQuestion question{fuzz::machine(), log, program(), 200, [](const char*) {}};
    const choices::ControlGap gap =
        choices::control_gap(question, folders, [&folders] { return folders.used(); });
    for (const double number : {gap.rms_um, gap.noise_um, gap.excess_um, gap.after_rms_um})
        fuzz::law(std::isfinite(number), "a gap is a finite number");
    fuzz::law(gap.p_value >= 0.0 && gap.p_value <= 1.0, "a probability is 0 to 1");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const records::PositionLog log =
            imports::read_position_log(fuzz::text_of(data, size), "log.csv", fuzz::machine());
        ++fuzz::accepted;
        if (log.rows.size() <= most_rows) judge(log);
    } catch (const InputError&) {
    } catch (const choices::PathEnded&) {
    }
    return 0;
}
