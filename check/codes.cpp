// G codes: unknown codes, and incompatible states.
#include <fmt/format.h>

#include "check/section.h"

namespace trunnion::check {

namespace {

/// Modal states followed by the checks, in written order.
struct Followed {
    bool compensation = false;  ///< G41, G42
    bool tool_centre = false;   ///< G43.4, G43.5
    bool tilted_plane = false;  ///< G68.2 to G68.4
};

struct Effect {
    int code10;
    bool Followed::*state;
    bool on;
};
constexpr Effect effects[] = {
    {400, &Followed::compensation, false}, {410, &Followed::compensation, true},
    {420, &Followed::compensation, true},  {434, &Followed::tool_centre, true},
    {435, &Followed::tool_centre, true},   {490, &Followed::tool_centre, false},
    {430, &Followed::tool_centre, false},  {682, &Followed::tilted_plane, true},
    {683, &Followed::tilted_plane, true},  {684, &Followed::tilted_plane, true},
    {690, &Followed::tilted_plane, false}};

std::string name_of_code(int code10) {
    return code10 % 10 == 0 ? fmt::format("G{}", code10 / 10)
                            : fmt::format("G{}.{}", code10 / 10, code10 % 10);
}

void at_end(const Followed& state, const interpreter::Block& block, Findings& findings) {
    if (state.tool_centre)
        findings.add("left-on", Severity::warning, {block, 1},
                     "tool centre point control (G43.4, G43.5) is still on at the end",
                     "Cancel it with G49 before M30.");
    if (state.tilted_plane)
        findings.add("left-on", Severity::warning, {block, 1},
                     "a tilted working plane (G68.2) is still on at the end",
                     "Cancel it with G69 before M30.");
}

void refuse_code(const CheckOptions& options, int code10, BlockPlace place, Findings& findings) {
    const std::string option = options.missing_option ? options.missing_option(code10) : "";
    const std::string name = name_of_code(code10);
    const char* const haas = haas_meaning(code10);
    if (option.empty())
        findings.add("unknown-code", Severity::error, place,
                     "this control has no " + name +
                         (haas ? fmt::format(" (on a Haas: {})", haas) : std::string()),
                     "Use a code of this control, or map it to a program (parameters 6050-6059).");
    else
        findings.add("unknown-code", Severity::error, place,
                     fmt::format("{} ({}) is an option that is not emulated", name, option),
                     "Leave it out, or map it to a program (parameters 6050-6059).");
}

/// An M code that passes without effect: builders have their own, so it is only said.
void note_unknown_m(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                    const CheckOptions& options, Findings& findings) {
    if (!options.knows_m || passes_arguments(program, block, options)) return;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word || item.letter != 'M') continue;
        const auto value = interpreter::constant_value(program, item);
        if (!value || *value < 0.0 || *value != std::floor(*value)) continue;
        const int code = whole_of(*value);
        if (options.knows_m(code)) continue;
        findings.add(
            "unknown-m", Severity::note, {block, item.column},
            fmt::format("M{:02} is not known to this control: it passes without effect", code),
            "Declare it in [control.builder] of the setup, or map it to a program (parameters "
            "6071-6089).");
    }
}

}  // namespace

void check_codes(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    const interpreter::ParsedProgram& program = *section.program;
    // G43.4 of a Hurco is the linearisation; M129 ends it.
    const bool hurco = options.dialect.family == interpreter::DialectFamily::hurco;
    Followed state;
    for (const interpreter::Block* block : section.blocks) {
        note_unknown_m(program, *block, options, findings);
        for (const interpreter::Item& item : program.items(*block)) {
            if (item.kind != interpreter::ItemKind::word || item.letter != 'G') continue;
            const auto value = interpreter::constant_value(program, item);
            if (!value) continue;
            const int code = code10_of(*value);
            if (options.knows_g && !options.knows_g(code))
                refuse_code(options, code, {*block, item.column}, findings);
            for (const Effect& e : effects)
                if (e.code10 == code && !(hurco && e.state == &Followed::tool_centre))
                    state.*e.state = e.on;
        }
        if (state.compensation && has_code(program, *block, 'G', 310))
            findings.add("skip-compensation", Severity::error, {*block, 1},
                         "G31 while cutter compensation (G41, G42) is on",
                         "Cancel it with G40 before the skip.");
        if (has_code(program, *block, 'M', 300) || has_code(program, *block, 'M', 20))
            at_end(state, *block, findings);
    }
}

}  // namespace trunnion::check
