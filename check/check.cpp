#include "check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/section.h"
#include "interpreter/alarms.h"

namespace trunnion {

const std::vector<CheckRule>& check_rules() {
    static const std::vector<CheckRule> table = {
        {"syntax", "The control cannot read the block"},
        {"merge-marker", "A version control conflict was left in the file"},
        {"jump-target", "GOTO to a sequence number that the program does not have"},
        {"duplicate-target", "GOTO to a sequence number that stands more than once"},
        {"loop", "DO and END do not belong together"},
        {"unknown-code", "A G code the control does not have"},
        {"subprogram-missing", "A called program is nowhere"},
        {"arc-radius", "The arc's end is not on its circle"},
        {"arc-plane", "Arcs in a program that names no plane"},
        {"skip-compensation", "G31 while cutter compensation is on"},
        {"unreachable", "Blocks that never run"},
        {"left-on", "A five-axis function is still on at the end"},
        {"alarm", "Running the program stops with an alarm"}};
    return table;
}

int code10_of(double value) {
    return whole_of(std::round(value * 10.0));
}

void Findings::add(const char* rule, Severity severity, const Block& block, int column,
                   std::string text, std::string remedy) {
    found_.push_back({rule, severity, program_.source.name, block.line, std::max(1, column),
                      std::move(text), std::move(remedy)});
}

std::vector<Finding> Findings::take() {
    std::stable_sort(found_.begin(), found_.end(), [](const Finding& a, const Finding& b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    return std::move(found_);
}

std::optional<double> word_value(const ParsedProgram& program, const Block& block, char letter) {
    for (const Item& item : program.items(block))
        if (item.kind == ItemKind::word && item.letter == letter)
            return constant_value(program, item);
    return std::nullopt;
}

bool has_code(const ParsedProgram& program, const Block& block, char letter, int code10) {
    for (const Item& item : program.items(block)) {
        if (item.kind != ItemKind::word || item.letter != letter) continue;
        const auto value = constant_value(program, item);
        if (value && code10_of(*value) == code10) return true;
    }
    return false;
}

namespace {

void note_jumps(const ParsedProgram& program, const Block& block, CheckSection& section) {
    for (const Item& item : program.items(block)) {
        if (item.kind != ItemKind::go_to) continue;
        const auto target = constant_value(program, item);
        if (target)
            section.targets.insert(whole_of(*target));
        else
            section.computed_jump = true;
    }
}

bool is_marker(std::string_view text) {
    return text.starts_with("<<<<<<<") || text.starts_with("=======") ||
           text.starts_with(">>>>>>>");
}

void add_faults(const ParsedProgram& program, Findings& findings) {
    for (const Alarm& fault : program.faults) {
        Finding f;
        f.path = program.source.name;
        f.line = fault.where.line;
        f.column = std::max(1, fault.where.column);
        f.rule = is_marker(fault.block) ? "merge-marker" : "syntax";
        f.text = is_marker(fault.block) ? "a merge conflict was left in the file"
                                        : fmt::format("alarm {} {}", fault.number, fault.text);
        const AlarmInfo* row = language_alarm(fault.number);
        f.remedy = is_marker(fault.block) ? "Resolve the conflict and remove the markers."
                   : row != nullptr       ? row->remedy
                                          : "";
        findings.add(std::move(f));
    }
}

}  // namespace

std::vector<CheckSection> sections_of(const ParsedProgram& program) {
    std::vector<CheckSection> sections;
    bool open = false;
    for (const Block& block : program.blocks) {
        if (block.kind == BlockKind::end_of_record) {
            open = false;
            continue;
        }
        if (block.items.count == 0 && block.sequence_number < 0 && block.kind != BlockKind::program)
            continue;
        if (!open || block.kind == BlockKind::program) sections.emplace_back().program = &program;
        open = true;
        CheckSection& section = sections.back();
        section.blocks.push_back(&block);
        if (block.sequence_number >= 0) section.numbered[block.sequence_number].push_back(&block);
        note_jumps(program, block, section);
        if (has_code(program, block, 'M', 990)) section.subprogram = true;
    }
    return sections;
}

std::vector<Finding> check_program(const ProgramText& text, const CheckOptions& options) {
    const ParsedProgram program = parse_program(text, options.dialect);
    Findings findings(program);
    add_faults(program, findings);
    const std::vector<CheckSection> sections = sections_of(program);
    for (const CheckSection& section : sections) {
        check_flow(section, findings);
        check_codes(section, options, findings);
        check_arcs(section, options, findings);
    }
    check_calls(program, sections, options, findings);
    return findings.take();
}

}  // namespace trunnion
