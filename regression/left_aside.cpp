#include "regression/left_aside.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interpreter/lexical.h"

namespace trunnion::regression {

namespace {

bool spells(std::string_view text, std::size_t at, std::string_view word) {
    if (text.size() - at < word.size()) return false;
    for (std::size_t k = 0; k < word.size(); ++k)
        if (interpreter::upper(text[at + k]) != word[k]) return false;
    return true;
}

bool ended(const RecordedRun& run, controller::RunStatus how) {
    return run.result.status == how;
}

OpenWays ways_of_all(const RecordedRun* a, const RecordedRun& b,
                     const std::vector<interpreter::ProgramText>& programs) {
    OpenWays all;
    const auto look = [&all](std::string_view text) {
        const OpenWays ways = open_ways(text);
        all = {all.branches || ways.branches, all.skips || ways.skips};
    };
    for (const interpreter::ProgramText& program : programs) look(program.text);
    for (const RecordedRun* run : {a, &b})
        if (run != nullptr)
            for (const OpenedProgram& opened : run->opened)
                if (opened.found) look(opened.found->text);
    return all;
}

}  // namespace

OpenWays open_ways(std::string_view text) {
    OpenWays ways;
    bool comment = false, begins = true;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (interpreter::is_line_end(c)) {
            comment = false;
            begins = true;
        } else if (c == '(' || c == ')') {
            comment = c == '(';
        } else if (!comment && !interpreter::is_blank(c)) {
            // An N number may precede '/'.
            ways.skips = ways.skips || (begins && c == '/');
            begins = begins && (interpreter::upper(c) == 'N' || interpreter::is_digit(c));
            ways.branches = ways.branches || spells(text, at, "IF") || spells(text, at, "GO") ||
                            spells(text, at, "WH");
        }
    }
    return ways;
}

std::string left_aside(const RecordedRun* a, const RecordedRun& b,
                       const std::vector<interpreter::ProgramText>& programs,
                       const CompareOptions& options, std::vector<std::string> more) {
    const auto either = [&](const auto& holds) { return holds(b) || (a != nullptr && holds(*a)); };
    const OpenWays ways = ways_of_all(a, b, programs);
    if (ways.branches) more.emplace_back("branches that were not taken");
    if (ways.skips) more.emplace_back("blocks behind '/' with other switches");
    if (!options.devices && either([](const RecordedRun& run) { return run.skips; }))
        more.emplace_back(
            "what a probe would answer (G31 runs to its end; --devices asks the emulated one)");
    if (options.by)
        more.push_back(fmt::format("layers other than {} (--by)", name_of(*options.by)));
    if (either([](const RecordedRun& run) { return ended(run, controller::RunStatus::alarm); }))
        more.emplace_back("what follows an alarm");
    if (either([](const RecordedRun& run) { return ended(run, controller::RunStatus::limit); }))
        more.emplace_back("what follows the limit");
    return more.empty() ? "" : fmt::format("not compared: {}", fmt::join(more, ", "));
}

}  // namespace trunnion::regression
