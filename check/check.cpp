#include "check/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/trial.h"
#include "interpreter/alarms.h"
#include "interpreter/line_scan.h"

namespace trunnion::check {

const std::vector<CheckRule>& check_rules() {
    static const std::vector<CheckRule> table = {
        {"syntax", "The control cannot read the block"},
        {"merge-marker", "A version control conflict was left in the file"},
        {"jump-target", "GOTO to a sequence number that the program does not have"},
        {"duplicate-target", "GOTO to a sequence number that stands more than once"},
        {"branch", "IF .. THEN, ELSE and ENDIF do not belong together"},
        {"loop", "DO and END do not belong together"},
        {"unknown-code", "A G code the control does not have"},
        {"unknown-m", "An M code that passes without effect"},
        {"subprogram-missing", "A called program is nowhere"},
        {"arc-radius", "The arc's end is not on its circle"},
        {"decimal-point", "A number without a decimal point, which controls read differently"},
        {"offset", "A length or radius that nothing has set: 0 is used"},
        {"program-end", "No M02, M30 or M99, or an M99 that starts the main program again"},
        {"lower-case", "Small letters outside of comments"},
        {"arc-plane", "Arcs in a program that names no plane"},
        {"skip-compensation", "G31 while cutter compensation is on"},
        {"unreachable", "Blocks that never run"},
        {"left-on", "A five-axis function is still on at the end"},
        {"word", "A word holds what the control does not take"},
        {"modal-group", "#4012 is read: some controls have G54-G59 there"},
        {"dwell-point", "A dwell in P with a decimal point"},
        {"variable", "A variable that does not exist or cannot be written"},
        {"tcp-frame", "G43.4 starts with the table off zero: its frame depends on tcp_frame"},
        {"family", "The program is written for another kind of control"},
        {"backup-file", "A file of a backup that is not a program"},
        {"reading", "Another control would move differently"},
        {"alarm", "Running the program stops with an alarm"}};
    return table;
}

const char* name_of(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::note ? "note" : "warning";
}

std::size_t count_faults(const std::vector<Finding>& findings) {
    return static_cast<std::size_t>(
        std::count_if(findings.begin(), findings.end(),
                      [](const Finding& finding) { return finding.severity != Severity::note; }));
}

int code10_of(double value) {
    return whole_of(std::round(value * 10.0));
}

std::optional<double> word_value(const interpreter::ParsedProgram& program,
                                 const interpreter::Block& block, char letter) {
    for (const interpreter::Item& item : program.items(block))
        if (item.kind == interpreter::ItemKind::word && item.letter == letter)
            return interpreter::constant_value(program, item);
    return std::nullopt;
}

namespace {

/// M30 and M99 in a block with G65 or G66 are arguments.
bool is_macro_call(const interpreter::ParsedProgram& program, const interpreter::Block& block) {
    return has_code(program, block, 'G', 650) || has_code(program, block, 'G', 660) ||
           has_code(program, block, 'G', 661);
}

}  // namespace

bool passes_arguments(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                      const CheckOptions& options) {
    if (is_macro_call(program, block)) return true;
    if (!options.calls_program) return false;
    const auto items = program.items(block);
    return std::any_of(items.begin(), items.end(), [&](const interpreter::Item& item) {
        if (item.kind != interpreter::ItemKind::word) return false;
        const auto value = interpreter::constant_value(program, item);
        if (item.letter == 'T') return options.calls_program('T', 0);
        return value && (item.letter == 'G' || item.letter == 'M') &&
               options.calls_program(item.letter, code10_of(*value));
    });
}

bool has_code(const interpreter::ParsedProgram& program, const interpreter::Block& block,
              char letter, int code10) {
    if (letter == 'M' && is_macro_call(program, block)) return false;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word || item.letter != letter) continue;
        const auto value = interpreter::constant_value(program, item);
        if (value && code10_of(*value) == code10) return true;
    }
    return false;
}

namespace {

void note_jumps(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                CheckSection& section) {
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::go_to) continue;
        const auto target = interpreter::constant_value(program, item);
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

void add_faults(const interpreter::ParsedProgram& program,
                const std::vector<CheckSection>& sections, const CheckOptions& options,
                Findings& findings) {
    for (const Alarm& fault : program.faults) {
        if (std::any_of(sections.begin(), sections.end(), [&](const CheckSection& section) {
                return section.foreign && fault.where.line >= section.blocks.front()->line &&
                       fault.where.line <= section.last_line;
            }))
            continue;
        Finding f;
        f.path = program.source.name;
        f.line = fault.where.line;
        f.column = std::max(1, fault.where.column);
        f.rule = is_marker(fault.block) ? "merge-marker" : "syntax";
        f.text = is_marker(fault.block) ? "a merge conflict was left in the file"
                                        : alarm_line(fault, options);
        const interpreter::AlarmInfo* row = interpreter::language_alarm(fault.number);
        f.remedy = is_marker(fault.block) ? "Resolve the conflict and remove the markers."
                   : row != nullptr       ? row->remedy
                                          : "";
        findings.add(std::move(f));
    }
}

}  // namespace

std::vector<CheckSection> sections_of(const interpreter::ParsedProgram& program) {
    std::vector<CheckSection> sections;
    bool open = false;
    for (const interpreter::Block& block : program.blocks) {
        if (block.kind == interpreter::BlockKind::end_of_record) {
            open = false;
            continue;
        }
        if (block.items.count == 0 && block.sequence_number < 0 &&
            block.kind != interpreter::BlockKind::program)
            continue;
        if (!open || block.kind == interpreter::BlockKind::program) {
            if (!sections.empty()) sections.back().last_line = block.line - 1;
            sections.emplace_back().program = &program;
        }
        open = true;
        CheckSection& section = sections.back();
        section.blocks.push_back(&block);
        if (block.sequence_number >= 0) section.numbered[block.sequence_number].push_back(&block);
        note_jumps(program, block, section);
        if (has_code(program, block, 'M', 990)) section.subprogram = true;
    }
    if (!sections.empty()) sections.back().last_line = std::numeric_limits<int>::max();
    return sections;
}

std::vector<Finding> check_program(const interpreter::ProgramText& text,
                                   const CheckOptions& options) {
    const interpreter::ParsedProgram program = interpreter::parse_program(text, options.dialect);
    Findings findings(program);
    std::vector<CheckSection> sections = sections_of(program);
    for (CheckSection& section : sections)
        section.foreign = check_family(section, options, findings);
    if (!sections.empty()) sections.front().may_start = may_start(sections.front());
    add_faults(program, sections, options, findings);
    for (const CheckSection& section : sections) {
        if (section.foreign) continue;
        check_flow(section, findings);
        check_codes(section, options, findings);
        check_arcs(section, options, findings);
        check_words(section, options, findings);
        check_trial(section, options, findings);
    }
    check_calls(program, sections, options, findings);
    check_ends(program, sections, options, findings);
    return findings.take();
}

bool begins_foreign(std::string_view text, const std::vector<Finding>& findings) {
    int end = std::numeric_limits<int>::max();  // line of the second program
    bool open = false;
    for (interpreter::LineScan scan(text, interpreter::start_of_text(text)); scan.next();) {
        const interpreter::LineHead& head = scan.head();
        if (head.kind == interpreter::LineKind::blank) continue;
        const bool begins = head.kind != interpreter::LineKind::block;
        if (open && begins) {
            end = head.place.line;
            break;
        }
        open = head.kind != interpreter::LineKind::over;
    }
    return std::any_of(findings.begin(), findings.end(),
                       [end](const Finding& f) { return f.rule == "family" && f.line < end; });
}

}  // namespace trunnion::check
