// Programs for a lathe or a Haas, recognised by codes with a different meaning there.
#include <fmt/format.h>

#include "check/section.h"

namespace trunnion::check {

namespace {

/// A block with this code and all of these letters belongs to that family.
struct Mark {
    const char* family;
    char letter;
    int code10;
    const char* with;  ///< letters of the block
    const char* text;
    bool with_other_words = false;  ///< our controls have the code, with other words
};
constexpr Mark marks[] = {
    {"lathe", 'G', 710, "PQ", "G71 P Q", true},
    {"lathe", 'G', 720, "PQ", "G72 P Q"},
    {"lathe", 'G', 700, "PQ", "G70 P Q", true},
    {"lathe", 'G', 500, "S", "G50 S", true},
    {"lathe", 'G', 710, "UR", "G71 U R", true},
    {"Haas", 'M', 970, "P", "M97 P"},
    {"Haas", 'G', 1870, "", "G187"},
    {"Haas", 'G', 1540, "P", "G154 P"},
    {"Haas", 'G', 1030, "P", "G103 P"},
    {"Haas", 'G', 1500, "P", "G150 P", true},
    {"Haas", 'M', 1300, "", "M130"},
};

/// This control has the code, by its dialect or by its builder's profile.
bool is_own(const Mark& mark, const CheckOptions& options) {
    if (mark.letter == 'M') return options.builders_m && options.builders_m(mark.code10 / 10);
    return !mark.with_other_words && options.knows_g && options.knows_g(mark.code10);
}

bool has_letters(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                 const char* letters) {
    for (; *letters; ++letters) {
        bool found = false;
        for (const interpreter::Item& item : program.items(block))
            found = found || (item.kind == interpreter::ItemKind::word && item.letter == *letters);
        if (!found) return false;
    }
    return true;
}

const Mark* find_mark(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                      const CheckOptions& options) {
    if (block.kind == interpreter::BlockKind::statements) return nullptr;
    for (const Mark& mark : marks) {
        if (options.calls_program && options.calls_program(mark.letter, mark.code10)) continue;
        if (is_own(mark, options)) continue;
        if (has_code(program, block, mark.letter, mark.code10) &&
            has_letters(program, block, mark.with))
            return &mark;
    }
    return nullptr;
}

}  // namespace

bool check_family(const std::vector<CheckSection>& sections, const CheckOptions& options,
                  Findings& findings) {
    for (const CheckSection& section : sections)
        for (const interpreter::Block* block : section.blocks) {
            const Mark* mark = find_mark(*section.program, *block, options);
            if (!mark) continue;
            findings.add("family", Severity::error, {*block, 1},
                         fmt::format("this is a program for a {} ({}): it is not checked further",
                                     mark->family, mark->text),
                         "Run it on its own control; this one is a Fanuc or Hurco mill.");
            return true;
        }
    return false;
}

}  // namespace trunnion::check
