// How programs end, and in which letters they are written.
#include "check/section.h"
#include "interpreter/line_scan.h"

namespace trunnion::check {

namespace {

/// True when the block may end the program, leave it, or call a program that does.
bool may_end(const CheckSection& section, const interpreter::Block& block,
             const CheckOptions& options) {
    const auto items = section.program->items(block);
    return std::any_of(items.begin(), items.end(), [&](const interpreter::Item& item) {
        if (item.kind != interpreter::ItemKind::word || item.letter != 'M') return false;
        const auto value = interpreter::constant_value(*section.program, item);
        if (!value) return true;
        const int code = code10_of(*value);
        return code == 20 || code == 300 || code == 990 ||
               (options.calls_program && options.calls_program('M', code));
    });
}

bool jumps(const CheckSection& section, const interpreter::Block& block) {
    const auto items = section.program->items(block);
    return !items.empty() && items.front().kind == interpreter::ItemKind::go_to;
}

/// A text that runs out: a Fanuc stops with alarm 5010. The last line of a Hurco is E; what it does
/// without one is not known.
void check_open_end(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    if (options.dialect.family != interpreter::DialectFamily::fanuc) return;
    const interpreter::Block* last = nullptr;
    for (const interpreter::Block* block : section.blocks) {
        if (block->items.count > 0) last = block;
        if (may_end(section, *block, options)) return;
    }
    int column = 1;
    if (!last || jumps(section, *last) || called_program(*section.program, *last, column)) return;
    findings.add(
        "program-end", Severity::warning, {*last, 1},
        "no M02, M30 or M99: a Fanuc stops behind this block with alarm 5010 END OF RECORD",
        "End a main program with M30, a subprogram with M99.");
}

bool is_called(const interpreter::ParsedProgram& program, int number) {
    return std::any_of(program.blocks.begin(), program.blocks.end(),
                       [&](const interpreter::Block& block) {
                           int column = 1;
                           return called_program(program, block, column) == number;
                       });
}

void note_start_again(const CheckSection& section, Findings& findings) {
    if (!section.may_start) return;
    for (const interpreter::Block* block : section.blocks)
        if (has_code(*section.program, *block, 'M', 990) &&
            !word_value(*section.program, *block, 'P'))
            return findings.add(
                "program-end", Severity::note, {*block, 1},
                "M99: as a main program this starts again without end; a run stops after the "
                "first pass",
                "End a main program with M30.");
}

void note_small_letters(const interpreter::ParsedProgram& program, Findings& findings) {
    const auto place = interpreter::first_small_letter(program.source.text);
    if (place)
        findings.add({"lower-case", Severity::note, program.source.name, place->line, place->column,
                      "small letters are read as capitals; a control may not take them",
                      "Write capitals outside of comments."});
}

}  // namespace

bool may_start(const CheckSection& section) {
    const int number = section.blocks.front()->o_number;
    return number < 8000 && !is_called(*section.program, number);
}

void check_ends(const interpreter::ParsedProgram& program,
                const std::vector<CheckSection>& sections, const CheckOptions& options,
                Findings& findings) {
    for (const CheckSection& section : sections)
        if (!section.foreign && !section.blocks.empty()) check_open_end(section, options, findings);
    if (sections.empty() || sections.front().foreign) return;
    note_start_again(sections.front(), findings);
    note_small_letters(program, findings);
}

}  // namespace trunnion::check
