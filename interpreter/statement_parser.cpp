// Macro statements: assignments, IF, WHILE, GOTO, print statements, SETVN.
#include "interpreter/alarms.h"
#include "interpreter/block_parser_class.h"

namespace trunnion::interpreter {

void BlockParser::assignment() {
    const std::uint16_t column = in_.column();
    expressions_.round_to_increment = false;
    int number = 0;
    const Span target = expressions_.variable_number(number);
    in_.expect('=', 1133);
    in_.leading = false;
    const Span value = expressions_.expression(Precedence::sum);
    refuse_comparison();
    Item& item = add(ItemKind::assign, column);
    item.value = number;
    item.a = value;
    item.b = target;
}

/// #1=#2LE#3: in brackets the comparison is 1 or 0 (docs/control.md).
void BlockParser::refuse_comparison() {
    if (!is_letter(in_.peek())) return;
    const char* p = in_.p;
    OpCode code;
    if (read_operator(p, in_.end, code) == Precedence::comparison)
        raise_language_alarm(114, in_.column(), "a comparison outside of IF and WHILE");
}

void BlockParser::statement(Keyword keyword, std::uint16_t column) {
    expressions_.round_to_increment = false;
    switch (keyword) {
        case Keyword::if_: return if_statement(column);
        case Keyword::while_: return while_statement(column);
        case Keyword::go_to: return jump(column);
        case Keyword::popen: add(ItemKind::popen, column); return;
        case Keyword::pclos: add(ItemKind::pclos, column); return;
        case Keyword::dprnt: return print_statement(ItemKind::dprnt, column);
        case Keyword::bprnt: return print_statement(ItemKind::bprnt, column);
        case Keyword::setvn: return setvn(column);
        case Keyword::then: raise_language_alarm(1137, column, "THEN without IF in the same block");
        case Keyword::else_:
            if (!options_.dialect.has_if_blocks) raise_language_alarm(125, column);
            add(ItemKind::else_, column);
            closed_ = true;
            return;
        case Keyword::do_:
        case Keyword::end: {
            if (keyword == Keyword::end && end_if(column)) return;
            if (is_letter(in_.peek()))
                raise_language_alarm(125, column, "ENDWHILE and the like are not Fanuc's");
            const std::uint8_t number = loop_number();
            add(keyword == Keyword::do_ ? ItemKind::do_only : ItemKind::end, column).number =
                number;
            closed_ = true;
            return;
        }
        case Keyword::none: break;
    }
}

/// ENDIF, behind its END; false when it is another word.
bool BlockParser::end_if(std::uint16_t column) {
    if (!options_.dialect.has_if_blocks || upper(in_.peek()) != 'I') return false;
    if (in_.p + 1 == in_.end || upper(in_.p[1]) != 'F') return false;
    in_.p += 2;
    add(ItemKind::end_if, column);
    closed_ = true;
    return true;
}

void BlockParser::if_statement(std::uint16_t column) {
    if (in_.peek() != '[') raise_language_alarm(1137, in_.column(), "'[' expected");
    const Span condition = expressions_.expression(Precedence::comparison);
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    const Keyword keyword = is_letter(c) ? read_keyword(in_.p, in_.end) : Keyword::none;
    if (keyword != Keyword::go_to && keyword != Keyword::then)
        raise_language_alarm(1137, at, "GOTO or THEN expected");
    const bool then = keyword == Keyword::then;
    if (then && in_.peek() == BlockReader::at_end && options_.dialect.has_if_blocks) {
        add(ItemKind::if_block, column).a = condition;
        closed_ = true;
        return;
    }
    add(then ? ItemKind::if_then : ItemKind::if_goto, column).a = condition;
    then ? after_then() : jump(at);
}

void BlockParser::after_then() {
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    if (c == '#') return assignment();
    if (c == BlockReader::at_end)
        raise_language_alarm(1137, at, "this control has no THEN over several blocks (.. ENDIF)");
    raise_language_alarm(
        1137, at, "only an assignment may follow THEN on a Fanuc (GOTO stands without THEN)");
}

void BlockParser::while_statement(std::uint16_t column) {
    if (in_.peek() != '[') raise_language_alarm(1138, in_.column(), "'[' expected");
    const Span condition = expressions_.expression(Precedence::comparison);
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    if (!is_letter(c) || read_keyword(in_.p, in_.end) != Keyword::do_)
        raise_language_alarm(1138, at, "DO expected");
    const std::uint8_t number = loop_number();
    Item& item = add(ItemKind::while_do, column);
    item.a = condition;
    item.number = number;
    closed_ = true;
}

std::uint8_t BlockParser::loop_number() {
    in_.peek();
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0 || n.point || n.value < 1 || n.value > 3) raise_language_alarm(126, column);
    return static_cast<std::uint8_t>(n.value);
}

/// GOTO 10, GOTO #1, GOTO [..].
void BlockParser::jump(std::uint16_t column) {
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    Span target;
    Number n;
    if (c == '#') {
        target = expressions_.variable();
    } else if (c == '[') {
        target = expressions_.bracketed();
    } else {
        n = read_number(in_.p, in_.end);
        if (n.digits == 0) raise_language_alarm(128, at, "GOTO without a number");
        if (n.point) raise_language_alarm(7, at);
    }
    Item& item = add(ItemKind::go_to, column);
    item.a = target;
    item.value = n.value;
    closed_ = true;
}

/// DPRNT[text#v[ab]..], BPRNT[text#v[d]..]; blanks are ignored, `*` prints a blank.
void BlockParser::print_statement(ItemKind kind, std::uint16_t column) {
    add(kind, column);
    if (in_.peek_raw() != '[') raise_language_alarm(1143, in_.column());
    ++in_.p;
    for (char c = in_.peek_raw(); c != ']'; c = in_.peek_raw()) {
        if (c == BlockReader::at_end) raise_language_alarm(1143, in_.column(), "']' is missing");
        c == '#' ? print_value(kind == ItemKind::bprnt) : print_text();
    }
    ++in_.p;
    closed_ = true;
}

void BlockParser::print_value(bool binary) {
    const std::uint16_t column = in_.column();
    const Span value = expressions_.variable();
    std::uint8_t digits[2] = {0, 0};
    if (in_.peek_raw() != '[') raise_language_alarm(1143, in_.column(), "[ab] expected");
    ++in_.p;
    for (int i = binary ? 1 : 0; i < 2; ++i) {
        if (!is_digit(in_.peek_raw())) raise_language_alarm(1143, in_.column(), "digit expected");
        digits[i] = static_cast<std::uint8_t>(*in_.p++ - '0');
    }
    if (in_.peek_raw() != ']') raise_language_alarm(1143, in_.column(), "']' expected");
    ++in_.p;
    Item& item = add(ItemKind::print_value, column);
    item.a = value;
    item.number = digits[0];
    item.digits = digits[1];
}

void BlockParser::print_text() {
    Item& item = add(ItemKind::print_text, in_.column());
    item.b.first = static_cast<std::uint32_t>(out_.text.size());
    for (char c = in_.peek_raw(); c != '#' && c != ']' && c != BlockReader::at_end;
         c = in_.peek_raw()) {
        out_.text += c;
        ++in_.p;
    }
    item.b.count = static_cast<std::uint32_t>(out_.text.size()) - item.b.first;
}

/// SETVN 100[NAME,NAME]
void BlockParser::setvn(std::uint16_t column) {
    in_.peek();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0 || n.digits > 9 || n.point || in_.peek() != '[')
        raise_language_alarm(1139, in_.column());
    ++in_.p;
    Item& item = add(ItemKind::setvn, column);
    item.value = n.value;
    item.b.first = static_cast<std::uint32_t>(out_.text.size());
    for (char c = in_.peek_raw(); c != ']'; c = in_.peek_raw()) {
        if (c == BlockReader::at_end) raise_language_alarm(1139, in_.column(), "']' is missing");
        out_.text += upper(c);
        ++in_.p;
    }
    ++in_.p;
    item.b.count = static_cast<std::uint32_t>(out_.text.size()) - item.b.first;
    closed_ = true;
}

}  // namespace trunnion::interpreter
