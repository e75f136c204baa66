#include "cli/against.h"

#include <algorithm>
#include <filesystem>

#include "base/alarm.h"
#include "base/numbers.h"
#include "choices/choice_table.h"
#include "cli/setups.h"
#include "emulator/run.h"
#include "inputs/program_choice.h"
#include "interpreter/program_folders.h"
#include "regression/two_controls.h"

namespace trunnion::cli {

namespace {

constexpr std::size_t most_findings = 50;  ///< limit for one program

/// Applies a row of the table of options, a control's name alone, or "NUMBER=VALUE" of a parameter.
bool take_choice(const std::string& what, setup::Setup& setup) {
    for (const char* const key : {"", "dialect=", "generation="})
        if (const auto choice = choices::find_choice(key + what)) {
            choice->take(setup);
            return true;
        }
    const std::size_t equals = what.find('=');
    if (equals == std::string::npos) return false;
    const auto number = parse_number(what.substr(0, equals)),
               wanted = parse_number(what.substr(equals + 1));
    if (!number || !wanted || *number < 0 || *number > 99999) return false;
    setup.stores.parameters.set(static_cast<int>(*number), *wanted);
    return true;
}

regression::ControlReading reading_of(const setup::Setup& setup, const std::string& name,
                                      const RunLimits& limits) {
    regression::ControlReading out{name, emulator::control_config(setup), setup.stores};
    out.config.max_blocks = limits.max_blocks;
    out.config.go_on = limits.go_on;
    return out;
}

}  // namespace

setup::Setup other_reading(const setup::Setup& setup, const std::string& what) {
    setup::Setup other = setup;
    if (what.starts_with("hurco.") && setup.dialect.family != interpreter::DialectFamily::hurco)
        throw InputError("--against " + what +
                         " concerns a Hurco, and the setup is none (dialect)");
    if (take_choice(what, other)) return other;
    if (std::filesystem::is_regular_file(what)) return open_setup(what);
    throw InputError(
        "--against takes hurco, hurco-bnc, fanuc, 16i, 30i, 0i-F, a choice like "
        "tcp_frame=rotary_zero or 5006#6=1 (docs/compare.md lists them), a parameter like "
        "5114=0.5, or a setup file; "
        "not '" +
        what + "'");
}

std::vector<check::Finding> differences_against(const setup::Setup& setup,
                                                const OtherReading& other,
                                                const interpreter::ProgramText& program,
                                                const std::vector<std::string>& folders,
                                                const RunLimits& limits) {
    const auto found =
        regression::compare_controls(reading_of(setup, "this control", limits),
                                     reading_of(other.setup, other.name, limits), program, [&] {
                                         return std::make_unique<interpreter::ProgramFolders>(
                                             inputs::folders_of_file(program, folders));
                                     });
    std::vector<check::Finding> out;
    for (const regression::ReadingDifference& d : found) {
        if (out.size() == most_findings) break;
        out.push_back({"reading", check::Severity::warning,
                       d.program.empty() ? program.name : d.program, std::max(1, d.line),
                       std::max(1, d.column), d.text,
                       "Decide which control the program is for, or write it so that both agree."});
    }
    if (found.size() > out.size())
        out.back().text += " (and " + std::to_string(found.size() - out.size()) + " more)";
    return out;
}

}  // namespace trunnion::cli
