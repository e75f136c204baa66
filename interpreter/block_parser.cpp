#include "interpreter/block_parser.h"

#include <algorithm>
#include <cstring>

#include "interpreter/alarms.h"
#include "interpreter/block_reader.h"
#include "interpreter/expression_parser.h"

namespace trunnion {
namespace {

bool is_name_character(char c) {
    return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '_' || c == '.' || c == ' ';
}

/// Letters whose least increment is that of positions; ROUND in them keeps it.
bool takes_increment(char letter) {
    return std::strchr("ABCIJKQRUVWXYZ", letter) != nullptr;
}

class Parser {
  public:
    Parser(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
           Code& out)
        : in_(text, byte, options.dialect.comment_nesting, out),
          expressions_(in_, options, out),
          options_(options),
          out_(out),
          text_(text) {
        block_.byte = byte;
        block_.line = line;
        block_.items.first = static_cast<std::uint32_t>(out.items.size());
        block_.comments.first = static_cast<std::uint32_t>(out.comments.size());
    }

    Block run();

  private:
    bool start();
    bool item(char c);
    void finish();
    void program_number(char c);
    void program_name();
    void called_name();
    std::string_view name();
    void number_word();
    bool skip();
    void comma_word();
    void word(char letter);
    void word_value(Item& item);
    void assignment();
    void statement(Keyword keyword, std::uint16_t column);
    void if_statement(std::uint16_t column);
    void after_then();
    void while_statement(std::uint16_t column);
    std::uint8_t loop_number();
    void jump(std::uint16_t column);
    void print_statement(ItemKind kind, std::uint16_t column);
    void print_value(bool binary);
    void print_text();
    void setvn(std::uint16_t column);
    void semicolon();
    Item& add(ItemKind kind, std::uint16_t column);
    void end_at(const char* p) { block_.end = static_cast<std::uint64_t>(p - text_.data()); }

    BlockReader in_;
    ExpressionParser expressions_;
    const ParseOptions& options_;
    Code& out_;
    std::string_view text_;
    Block block_;
    bool words_ = false, statements_ = false, computed_ = false;
    bool closed_ = false;      ///< a jump or loop statement was read: nothing may follow
    bool macro_call_ = false;  ///< G65, G66: ROUND in an argument gives a whole number
    bool program_ = false;
};

Block Parser::run() {
    if (!start()) return block_;
    for (char c = in_.peek(); c != BlockReader::at_end; c = in_.peek())
        if (!item(c)) break;
    finish();
    return block_;
}

/// False: the line is no block (end of record, folder line).
bool Parser::start() {
    const char c = in_.peek_raw();
    const bool over = in_.begin == in_.end || (in_.p != in_.end && *in_.p == control_z);
    if (!over && c != '%' && c != '&') return true;
    block_.kind = BlockKind::end_of_record;
    const char* p = over ? in_.end : find_line_end(in_.p, in_.end);
    end_at(p == in_.end ? p : past_line_end(p, in_.end));
    return false;
}

/// One item at `c`; false: the block ends here.
bool Parser::item(char c) {
    const std::uint16_t column = in_.column();
    const bool first = !words_ && !statements_;
    if (c == '%') return false;
    if (c == ';') return semicolon(), false;
    if (c == '/') return skip();
    if ((c == 'O' || c == ':') && first) return program_number(c), true;
    if (c == '<' && first && !program_) return program_name(), true;
    if (c == '<' && words_) return called_name(), true;
    if (c == '#') return assignment(), true;
    if (c == ',') return comma_word(), true;
    if (c == 'N' && first && block_.sequence_number < 0) return number_word(), true;
    if (is_digit(c) || c == '.') raise_language_alarm(4, column);
    if (c == '+' || c == '-') raise_language_alarm(6, column);
    if (c == '[' || c == ']' || c == '*') raise_language_alarm(114, column);
    if (!is_letter(c))
        raise_language_alarm(9, column,
                             c == '=' || c == '<' || c == '>' ? "stray character, "
                                                                "a merge marker?"
                                                              : "stray character");
    const Keyword keyword = read_keyword(in_.p, in_.end);
    if (keyword != Keyword::none) return statement(keyword, column), true;
    word(c);
    return true;
}

void Parser::finish() {
    const char* p = in_.p;
    end_at(p != in_.end && is_line_end(*p) ? past_line_end(p, in_.end) : p);
    block_.items.count = static_cast<std::uint32_t>(out_.items.size()) - block_.items.first;
    block_.comments.count =
        static_cast<std::uint32_t>(out_.comments.size()) - block_.comments.first;
    if (computed_) block_.kind = BlockKind::computed;
    if (statements_) block_.kind = BlockKind::statements;
    if (program_) block_.kind = BlockKind::program;
}

Item& Parser::add(ItemKind kind, std::uint16_t column) {
    (kind == ItemKind::word ? words_ : statements_) |= kind != ItemKind::skip;
    if (words_ && statements_) raise_language_alarm(127, column);
    if (closed_ && kind != ItemKind::skip) raise_language_alarm(125, column);
    in_.leading = false;
    Item& item = out_.items.emplace_back();
    item.kind = kind;
    item.column = column;
    return item;
}

void Parser::program_number(char) {
    ++in_.p;
    if (in_.peek() == '<')
        raise_language_alarm(1090, in_.column(), "O<name> is LinuxCNC's, not Fanuc's");
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0) raise_language_alarm(5, column);
    if (n.point) raise_language_alarm(7, column);
    if (n.digits > 8) raise_language_alarm(3, column);
    program_ = true;
    block_.o_number = static_cast<int>(n.value);
    if (is_letter(in_.peek()) && in_.end - in_.p > 1 && is_letter(in_.p[1]) &&
        !(upper(in_.p[0]) == 'G' && upper(in_.p[1]) == 'O'))
        raise_language_alarm(1090, in_.column(),
                             "O words with SUB, WHILE, IF .. are LinuxCNC's, not Fanuc's");
}

/// `<101>`, `<PART-1>` without the brackets; the longest name is 32 characters.
std::string_view Parser::name() {
    const std::uint16_t column = in_.column();
    const char* const first = ++in_.p;
    while (in_.p != in_.end && is_name_character(*in_.p)) ++in_.p;
    const auto size = static_cast<std::size_t>(in_.p - first);
    if (in_.p == in_.end || *in_.p != '>' || size == 0 || size > 32)
        raise_language_alarm(9, column, "neither a program name nor a block (a merge marker?)");
    ++in_.p;
    return {first, size};
}

void Parser::program_name() {
    const std::string_view text = name();
    block_.name = {static_cast<std::uint32_t>(text.data() - in_.begin),
                   static_cast<std::uint32_t>(text.size())};
    program_ = true;
}

/// `M98<NAME>`, `G65<NAME>`: a word whose value is text.
void Parser::called_name() {
    const std::uint16_t column = in_.column();
    const std::string_view text = name();
    Item& item = add(ItemKind::word, column);
    item.letter = '<';
    item.b = {static_cast<std::uint32_t>(out_.text.size()),
              static_cast<std::uint32_t>(text.size())};
    out_.text += text;
    computed_ = true;
}

void Parser::number_word() {
    ++in_.p;
    in_.peek();
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0) raise_language_alarm(5, column);
    if (n.point) raise_language_alarm(7, column);
    if (n.digits > 9) raise_language_alarm(3, column);
    block_.sequence_number = static_cast<int>(n.value);
}

/// `/` and `/1`..`/9`: false when the switch drops the rest of the block.
bool Parser::skip() {
    const std::uint16_t column = in_.column();
    ++in_.p;
    std::uint8_t number = 1;
    if (in_.p != in_.end && is_digit(*in_.p)) number = static_cast<std::uint8_t>(*in_.p++ - '0');
    if (number == 0) raise_language_alarm(4, column);
    if (options_.keep_skips) add(ItemKind::skip, column).number = number;
    if (!options_.skip[number]) return true;
    in_.p = find_line_end(in_.p, in_.end);
    return false;
}

void Parser::comma_word() {
    const std::uint16_t column = in_.column();
    ++in_.p;
    const char c = in_.peek();
    if (c != 'R' && c != 'C' && c != 'A') raise_language_alarm(9, column, "stray comma");
    const char letter = static_cast<char>(c - 'A' + 'a');
    ++in_.p;
    Item& item = add(ItemKind::word, column);
    item.letter = letter;
    word_value(item);
}

void Parser::word(char letter) {
    const std::uint16_t column = in_.column();
    ++in_.p;
    Item& item = add(ItemKind::word, column);
    item.letter = letter;
    word_value(item);
    if (letter == 'G' && (item.value == 65 || item.value == 66 || item.value == 66.1))
        macro_call_ = true;
}

void Parser::word_value(Item& item) {
    char c = in_.peek();
    const bool sign = c == '-' || c == '+';
    item.negative = c == '-';
    if (sign) {
        ++in_.p;
        c = in_.peek();
    }
    expressions_.round_to_increment = takes_increment(upper(item.letter)) && !macro_call_;
    if (c == '#' || c == '[') {
        computed_ = true;
        item.a = c == '#' ? expressions_.variable() : expressions_.bracketed();
        return;
    }
    const std::uint16_t column = in_.column();
    if (c == '+' || c == '-') raise_language_alarm(6, column);
    if (!is_digit(c) && c != '.') raise_language_alarm(5, item.column);
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0) raise_language_alarm(7, column);
    if (n.digits > 15) raise_language_alarm(3, column);
    item.value = item.negative ? -n.value : n.value;
    item.negative = false;
    item.decimal_point = n.point;
    if (in_.peek() == '.') raise_language_alarm(7, in_.column());
}

void Parser::assignment() {
    const std::uint16_t column = in_.column();
    expressions_.round_to_increment = false;
    int number = 0;
    const Span target = expressions_.variable_number(number);
    if (in_.peek() != '=') raise_language_alarm(1133, in_.column());
    ++in_.p;
    in_.leading = false;
    const Span value = expressions_.expression(Precedence::sum);
    Item& item = add(ItemKind::assign, column);
    item.value = number;
    item.a = value;
    item.b = target;
}

void Parser::statement(Keyword keyword, std::uint16_t column) {
    expressions_.round_to_increment = false;
    switch (keyword) {
        case Keyword::if_:
            return if_statement(column);
        case Keyword::while_:
            return while_statement(column);
        case Keyword::go_to:
            return jump(column);
        case Keyword::popen:
            add(ItemKind::popen, column);
            return;
        case Keyword::pclos:
            add(ItemKind::pclos, column);
            return;
        case Keyword::dprnt:
            return print_statement(ItemKind::dprnt, column);
        case Keyword::bprnt:
            return print_statement(ItemKind::bprnt, column);
        case Keyword::setvn:
            return setvn(column);
        case Keyword::then:
            raise_language_alarm(1137, column, "THEN without IF in the same block");
        case Keyword::do_:
        case Keyword::end: {
            if (is_letter(in_.peek()))
                raise_language_alarm(125, column, "ENDIF, ENDWHILE and the like are not Fanuc's");
            const std::uint8_t number = loop_number();
            add(keyword == Keyword::do_ ? ItemKind::do_only : ItemKind::end, column).number =
                number;
            closed_ = true;
            return;
        }
        case Keyword::none:
            break;
    }
}

void Parser::if_statement(std::uint16_t column) {
    if (in_.peek() != '[') raise_language_alarm(1137, in_.column(), "'[' expected");
    const Span condition = expressions_.expression(Precedence::comparison);
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    const Keyword keyword = is_letter(c) ? read_keyword(in_.p, in_.end) : Keyword::none;
    if (keyword != Keyword::go_to && keyword != Keyword::then)
        raise_language_alarm(1137, at, "GOTO or THEN expected");
    const bool then = keyword == Keyword::then;
    add(then ? ItemKind::if_then : ItemKind::if_goto, column).a = condition;
    then ? after_then() : jump(at);
}

void Parser::after_then() {
    const char c = in_.peek();
    const std::uint16_t at = in_.column();
    if (c == '#') return assignment();
    if (c == BlockReader::at_end)
        raise_language_alarm(1137, at, "THEN over several blocks (.. ENDIF) is not Fanuc's");
    raise_language_alarm(
        1137, at, "only an assignment may follow THEN on a Fanuc (GOTO stands without THEN)");
}

void Parser::while_statement(std::uint16_t column) {
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

std::uint8_t Parser::loop_number() {
    in_.peek();
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0 || n.point || n.value < 1 || n.value > 3) raise_language_alarm(126, column);
    return static_cast<std::uint8_t>(n.value);
}

/// GOTO 10, GOTO #1, GOTO [..].
void Parser::jump(std::uint16_t column) {
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

/// DPRNT[text#v[ab]..], BPRNT[text#v[d]..]; blanks do not count, `*` prints one.
void Parser::print_statement(ItemKind kind, std::uint16_t column) {
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

void Parser::print_value(bool binary) {
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

void Parser::print_text() {
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
void Parser::setvn(std::uint16_t column) {
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

/// Listings show the end of block as ';': accepted where nothing follows.
void Parser::semicolon() {
    const std::uint16_t column = in_.column();
    ++in_.p;
    if (in_.peek() != BlockReader::at_end)
        raise_language_alarm(9, column,
                             "';' is not in a Fanuc file (comments stand in round brackets)");
}

}  // namespace

void read_names(std::string_view list, int number, VariableNames& names) {
    for (; !list.empty(); ++number) {
        const std::size_t comma = std::min(list.find(','), list.size());
        if (comma > 0) names[std::string(list.substr(0, comma))] = number;
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
}

Block parse_block(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
                  Code& out) {
    return Parser(text, byte, line, options, out).run();
}

}  // namespace trunnion
