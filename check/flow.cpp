// Jumps, loops, calls and unreachable blocks.
#include <fmt/format.h>

#include <algorithm>

#include "check/section.h"
#include "interpreter/line_scan.h"
#include "interpreter/word_rules.h"

namespace trunnion::check {

namespace {

void check_jump(const CheckSection& section, const interpreter::Block& block,
                const interpreter::Item& item, Findings& findings) {
    const auto target = interpreter::constant_value(*section.program, item);
    if (!target) return;
    const int number = whole_of(*target);
    const auto found = section.numbered.find(number);
    if (found == section.numbered.end())
        findings.add("jump-target", Severity::error, {block, item.column},
                     fmt::format("GOTO {} but the program has no N{}", number, number),
                     "Give the target block its N number, or correct the GOTO.");
    else if (found->second.size() > 1)
        findings.add(
            "duplicate-target", Severity::warning, {block, item.column},
            fmt::format("GOTO {} and N{} stands {} times (lines {} and {})", number, number,
                        found->second.size(), found->second[0]->line, found->second[1]->line),
            "Give each jump target a number of its own.");
}

struct OpenLoop {
    int number;
    const interpreter::Block* block;
    int column;
};

void close_loop(std::vector<OpenLoop>& loops, const interpreter::Block& block,
                const interpreter::Item& item, Findings& findings) {
    if (!loops.empty() && loops.back().number == item.number) {
        loops.pop_back();
        return;
    }
    const std::string text =
        loops.empty() ? fmt::format("END{} without DO{}", item.number, item.number)
                      : fmt::format("END{} closes the DO{} of line {}: loops cross", item.number,
                                    loops.back().number, loops.back().block->line);
    findings.add("loop", Severity::error, {block, item.column}, text,
                 "Every DO needs its END with the same number, nested loops inside.");
    for (std::size_t k = loops.size(); k-- > 0;)
        if (loops[k].number == item.number) {
            loops.resize(k);
            return;
        }
}

/// The loops around a block, outermost first: their DO blocks.
using Nest = std::vector<const interpreter::Block*>;

/// A constant GOTO into a loop that does not contain the GOTO: its END has no active DO.
void check_entries(const CheckSection& section,
                   const std::map<const interpreter::Block*, Nest>& nests, Findings& findings) {
    for (const auto& [block, nest] : nests)
        for (const interpreter::Item& item : section.program->items(*block)) {
            if (item.kind != interpreter::ItemKind::go_to) continue;
            const auto value = interpreter::constant_value(*section.program, item);
            const auto found = section.numbered.find(value ? whole_of(*value) : -1);
            if (found == section.numbered.end() || found->second.size() != 1) continue;
            const auto target = nests.find(found->second[0]);
            if (target == nests.end()) continue;
            const Nest& inside = target->second;
            const bool entered = inside.size() > nest.size() ||
                                 !std::equal(inside.begin(), inside.end(), nest.begin());
            if (entered)
                findings.add("loop", Severity::error, {*block, item.column},
                             fmt::format("GOTO {} jumps into the loop of line {}", found->first,
                                         inside.back()->line),
                             "Jump to the DO, or to a block outside the loop.");
        }
}

/// IF .. THEN, ELSE and ENDIF in blocks of their own.
void check_branches(const CheckSection& section, Findings& findings) {
    std::vector<BlockPlace> open;
    const char* const remedy = "Every IF .. THEN without an assignment needs its ENDIF.";
    for (const interpreter::Block* block : section.blocks)
        for (const interpreter::Item& item : section.program->items(*block)) {
            const BlockPlace place{*block, item.column};
            const bool ends = item.kind == interpreter::ItemKind::end_if;
            if (item.kind == interpreter::ItemKind::if_block) open.push_back(place);
            if (!ends && item.kind != interpreter::ItemKind::else_) continue;
            if (open.empty())
                findings.add("branch", Severity::error, place,
                             ends ? "ENDIF without IF .. THEN" : "ELSE without IF .. THEN", remedy);
            else if (ends)
                open.pop_back();
        }
    for (const BlockPlace& place : open)
        findings.add("branch", Severity::error, place, "IF .. THEN without ENDIF", remedy);
}

void check_statements(const CheckSection& section, Findings& findings) {
    std::vector<OpenLoop> loops;
    std::map<const interpreter::Block*, Nest> nests;  // of blocks that jump or are jump targets
    for (const interpreter::Block* block : section.blocks) {
        bool jumps = section.targets.contains(block->sequence_number);
        for (const interpreter::Item& item : section.program->items(*block))
            jumps = jumps || item.kind == interpreter::ItemKind::go_to;
        if (jumps)
            for (const OpenLoop& loop : loops) nests[block].push_back(loop.block);
        if (jumps && loops.empty()) nests[block];
        for (const interpreter::Item& item : section.program->items(*block)) {
            if (item.kind == interpreter::ItemKind::go_to)
                check_jump(section, *block, item, findings);
            if (item.kind == interpreter::ItemKind::while_do ||
                item.kind == interpreter::ItemKind::do_only)
                loops.push_back({item.number, block, item.column});
            if (item.kind == interpreter::ItemKind::end) close_loop(loops, *block, item, findings);
        }
    }
    check_entries(section, nests, findings);
    for (const OpenLoop& loop : loops)
        findings.add("loop", Severity::error, {*loop.block, loop.column},
                     fmt::format("DO{} without END{}", loop.number, loop.number),
                     "Every DO needs its END with the same number, nested loops inside.");
}

bool is_entered(const CheckSection& section, const interpreter::Block& block) {
    if (block.sequence_number >= 0 &&
        (section.computed_jump || section.targets.contains(block.sequence_number)))
        return true;
    for (const interpreter::Item& item : section.program->items(block))
        if (item.kind == interpreter::ItemKind::end || item.kind == interpreter::ItemKind::else_ ||
            item.kind == interpreter::ItemKind::end_if)
            return true;
    return false;
}

void check_reach(const CheckSection& section, Findings& findings) {
    bool reached = true, told = false;
    for (const interpreter::Block* block : section.blocks) {
        if (is_entered(section, *block)) reached = true;
        // A block with a sequence number may be the target of a caller's M99 P or M98 Q.
        const bool numbered = block->sequence_number >= 0 && section.subprogram;
        if (!reached && !told && !numbered && block->items.count > 0 &&
            block->kind != interpreter::BlockKind::program) {
            findings.add("unreachable", Severity::warning, {*block, 1},
                         "never reached: the block before leaves, and nothing jumps here",
                         "Remove it, or give it the N number of a jump.");
            told = true;
        }
        if (numbered) reached = true;
        if (leaves(*section.program, *block)) {
            reached = false;
            told = false;
        }
    }
}

/// The programs of the file.
struct OwnPrograms {
    const std::set<int>& numbers;
    const std::set<std::string, std::less<>>& names;
};

/// `<O8001>` is O8001 as well.
bool is_found(const std::string& name, const OwnPrograms& own, const CheckOptions& options) {
    const auto number = interpreter::number_of_name(name);
    if (number && (own.numbers.contains(*number) ||
                   (options.finds_program && options.finds_program(*number))))
        return true;
    return own.names.contains(name) || (options.finds_named && options.finds_named(name));
}

void check_named_call(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                      const OwnPrograms& own, const CheckOptions& options, Findings& findings) {
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word || item.letter != '<') continue;
        const std::string name = program.code.text.substr(item.b.first, item.b.count);
        if (is_found(name, own, options)) continue;
        findings.add("subprogram-missing", Severity::error, {block, item.column},
                     fmt::format("program <{}> is called and nowhere to be found", name),
                     "Put it into the folder of this program, or name its folder with --programs.");
    }
}

}  // namespace

bool leaves(const interpreter::ParsedProgram& program, const interpreter::Block& block) {
    bool jump = false;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind == interpreter::ItemKind::skip || item.kind == interpreter::ItemKind::if_goto)
            return false;
        jump = jump || item.kind == interpreter::ItemKind::go_to;
    }
    return jump || has_code(program, block, 'M', 300) || has_code(program, block, 'M', 20) ||
           has_code(program, block, 'M', 990);
}

std::optional<int> called_program(const interpreter::ParsedProgram& program,
                                  const interpreter::Block& block, int& column) {
    const bool m98 = has_code(program, block, 'M', 980) || has_code(program, block, 'M', 1980);
    const bool macro = has_code(program, block, 'G', 650) || has_code(program, block, 'G', 660) ||
                       has_code(program, block, 'G', 661);
    if (!m98 && !macro) return std::nullopt;
    for (const interpreter::Item& item : program.items(block)) {
        if (item.kind != interpreter::ItemKind::word || item.letter != 'P') continue;
        const auto value = interpreter::constant_value(program, item);
        if (!value || !interpreter::is_whole(*value)) return std::nullopt;
        column = item.column;
        return whole_of(std::round(*value));
    }
    return std::nullopt;
}

void check_flow(const CheckSection& section, Findings& findings) {
    check_statements(section, findings);
    check_branches(section, findings);
    check_reach(section, findings);
}

void check_calls(const interpreter::ParsedProgram& program,
                 const std::vector<CheckSection>& sections, const CheckOptions& options,
                 Findings& findings) {
    if (!options.finds_program) return;
    std::set<int> own;
    std::set<std::string, std::less<>> own_names;
    for (const CheckSection& section : sections)
        for (const interpreter::Block* block : section.blocks) {
            if (block->kind != interpreter::BlockKind::program) continue;
            own.insert(block->o_number);
            own_names.emplace(program.name(*block));
            if (const auto number = interpreter::number_of_name(program.name(*block)))
                own.insert(*number);
        }
    const auto known = [&](int number) {
        return own.contains(number) || options.finds_program(number);
    };
    for (const CheckSection& section : sections) {
        if (section.foreign) continue;
        for (const interpreter::Block* block : section.blocks) {
            check_named_call(program, *block, {own, own_names}, options, findings);
            int column = 1;
            const auto number = called_program(program, *block, column);
            if (!number) continue;
            const bool outside = has_code(program, *block, 'M', 1980);
            if (outside ? options.finds_program(*number) : known(*number)) continue;
            // M98 P100005 may mean ten times O0005 (depends on the control generation).
            const bool m98 = has_code(program, *block, 'M', 980);
            if (m98 && *number > 9999 && known(*number % 10000)) continue;
            findings.add(
                "subprogram-missing", {*block, column},
                {"program * is called and nowhere to be found",
                 "programs * are called and nowhere to be found", "O", *number},
                "Put it into the folder of this program, or name its folder with --programs.");
        }
    }
}

}  // namespace trunnion::check
