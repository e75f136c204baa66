// Macro statements: assignments, jumps, loops and print statements.
#include "interpreter/alarms.h"
#include "interpreter/print_output.h"
#include "interpreter/runner.h"

namespace trunnion::interpreter {
namespace {

/// A condition is true when it is not 0; a vacant one is false.
bool holds(double condition) {
    return condition != 0.0 && !is_vacant(condition);
}

}  // namespace

void Interpreter::State::statements(const Block& block, Code& code, int index) {
    ++executed;
    Item* item = code.items.data() + block.items.first;
    Item* const last = item + block.items.count;
    for (; item != last; ++item) {
        switch (item->kind) {
            case ItemKind::assign: assign(block, code, *item); break;
            case ItemKind::if_goto:
            case ItemKind::if_then:
                if (!holds(value(code, *item))) return;
                break;
            case ItemKind::if_block:
                if (!holds(value(code, *item))) leave_branch(block, *item, index >= 0);
                return;
            case ItemKind::else_: return leave_branch(block, *item, index >= 0);
            case ItemKind::while_do:
            case ItemKind::do_only: return while_do(block, *item, index);
            case ItemKind::end: return end_loop(*item);
            case ItemKind::go_to: return go_to(block, code, *item, index >= 0);
            case ItemKind::dprnt:
            case ItemKind::bprnt: return print_line(code, item, last);
            case ItemKind::setvn: set_names(code, *item); break;
            default: break;  // ENDIF; POPEN and PCLOS: the port is always open
        }
    }
}

/// The comment of `#3000 = 1(TEXT)`: the first one after the '=', or the first of the block.
std::string Interpreter::State::comment_of(const Block& block, const Code& code) const {
    const Comment* chosen = nullptr;
    for (std::uint32_t i = 0; i < block.comments.count; ++i) {
        const Comment& comment = code.comments[block.comments.first + i];
        if (!chosen || (chosen->leading && !comment.leading)) chosen = &comment;
    }
    return chosen ? std::string(text().substr(chosen->byte, chosen->size)) : std::string();
}

void Interpreter::State::assign(const Block& block, const Code& code, const Item& item) {
    const double v = value(code, item);
    int number = static_cast<int>(item.value);
    if (item.b.count != 0) {
        const Op* target = code.ops.data() + item.b.first;
        number = whole_number(evaluate(target, item.b.count, memory, rules), item.column);
    }
    try {
        if (number >= 1000 && number < 98000)
            memory.set(number, v, comment_of(block, code).c_str());
        else
            memory.set(number, v);
    } catch (Alarm& alarm) {
        if (alarm.where.column == 0) alarm.where.column = item.column;
        throw;
    }
}

int Interpreter::State::new_link(const TextPlace& place) {
    cache.links.push_back({place, -1});
    return static_cast<int>(cache.links.size()) - 1;
}

void Interpreter::State::jump(const TextPlace& place) {
    at = {place.byte, place.line, -1};
    link_from = -1;
}

void Interpreter::State::follow(int link) {
    const JumpTarget& target = cache.links[static_cast<std::size_t>(link)];
    at = {target.place.byte, target.place.line, target.block};
    link_from = target.block < 0 ? BlockCache::of_link(link) : -1;
}

void Interpreter::State::go_to(const Block& block, Code& code, Item& item, bool cached) {
    if (item.link >= 0) return follow(item.link);
    const double target = value(code, item);
    const int number = target < 1e9 ? whole_number(target, item.column) : 0;
    const auto place =
        number > 0 ? files.find_sequence(*frame().section, number, block.byte) : std::nullopt;
    if (!place)
        raise_language_alarm(128, item.column, number > 0 ? "N" + std::to_string(number) : "");
    if (!cached || item.a.count != 0) return jump(*place);
    item.link = new_link(*place);
    follow(item.link);
}

/// From an IF to behind its ELSE or ENDIF, from an ELSE to behind its ENDIF.
void Interpreter::State::leave_branch(const Block& block, Item& item, bool cached) {
    if (item.link >= 0) return follow(item.link);
    const bool to_else = item.kind == ItemKind::if_block;
    const auto behind =
        files.find_branch_end(*frame().section, {block.end, block.line + 1}, to_else);
    if (!behind) raise_language_alarm(1137, item.column, "ENDIF is missing");
    if (!cached) return jump(*behind);
    item.link = new_link(*behind);
    follow(item.link);
}

void Interpreter::State::while_do(const Block& block, Item& item, int index) {
    Place& loop = frame().loops[item.number];
    if (item.link < 0 || index < 0) {
        const auto behind =
            files.find_loop_end(*frame().section, {block.end, block.line + 1}, item.number);
        if (!behind) raise_language_alarm(124, item.column, "END" + std::to_string(item.number));
        frame().behind_loop[item.number] = behind->line;
        if (index < 0) {
            loop = {block.byte, block.line, -1};
            const bool enter = item.kind == ItemKind::do_only || holds(value(scratch, item));
            if (!enter) {
                loop.line = 0;
                jump(*behind);
            }
            return;
        }
        item.link = new_link(*behind);
    }
    loop = {block.byte, block.line, index};
    frame().behind_loop[item.number] = cache.links[static_cast<std::size_t>(item.link)].place.line;
    if (item.kind == ItemKind::do_only || holds(value(cache.code, item))) return;
    loop.line = 0;
    follow(item.link);
}

/// Jumps back to the DO of this END. After a jump into a loop there is no active DO.
void Interpreter::State::end_loop(const Item& item) {
    const Place& loop = frame().loops[item.number];
    if (loop.line == 0 || frame().behind_loop[item.number] != current.line + 1)
        raise_language_alarm(1124, item.column, "DO" + std::to_string(item.number));
    at = loop;
    link_from = -1;
}

void Interpreter::State::print_line(const Code& code, const Item* item, const Item* last) {
    const bool binary = item->kind == ItemKind::bprnt;
    std::string line;
    for (++item; item != last; ++item) {
        if (item->kind == ItemKind::print_text) {
            for (const char c : std::string_view(code.text).substr(item->b.first, item->b.count))
                line += c == '*' ? ' ' : c;
        } else {
            const double v = value(code, *item);
            line += binary ? binary_print(v, item->digits)
                           : decimal_print(v, item->number, item->digits,
                                           options.print_suppresses_blanks);
        }
    }
    line += '\n';
    if (print) print(line);
}

void Interpreter::State::set_names(const Code& code, const Item& item) {
    read_names(std::string_view(code.text).substr(item.b.first, item.b.count),
               static_cast<int>(item.value), names);
}

}  // namespace trunnion::interpreter
