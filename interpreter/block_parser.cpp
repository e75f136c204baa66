#include "interpreter/block_parser.h"

#include <algorithm>
#include <cstring>

#include "interpreter/alarms.h"
#include "interpreter/block_parser_class.h"

namespace trunnion::interpreter {
namespace {

bool is_name_character(char c) {
    return is_letter(c) || is_digit(c) || c == '+' || c == '-' || c == '_' || c == '.' || c == ' ';
}

constexpr std::size_t most_items = 4096;  ///< per block, so that a line of any length ends

/// Letters with the least increment of positions; ROUND in them keeps it.
bool takes_increment(char letter) {
    return std::strchr("ABCIJKQRUVWXYZ", letter) != nullptr;
}

}  // namespace

Block BlockParser::run() {
    if (!start()) return block_;
    for (char c = in_.peek(); c != BlockReader::at_end; c = in_.peek())
        if (!item(c)) break;
    finish();
    return block_;
}

/// `E` alone in a line is the last line of a Hurco program.
bool BlockParser::is_hurco_end(char c) const {
    if (c != 'E' || options_.dialect.family != DialectFamily::hurco) return false;
    const char* const rest = skip_blanks(in_.p + 1, in_.end);
    return rest == in_.end || is_line_end(*rest) || *rest == control_z;
}

/// False when the line is not a block (end of record, folder line).
bool BlockParser::start() {
    const char c = in_.peek_raw();
    const bool over = in_.begin == in_.end || (in_.p != in_.end && *in_.p == control_z);
    if (!over && c != '%' && c != '&' && !is_hurco_end(c)) return true;
    block_.kind = BlockKind::end_of_record;
    const char* p = over ? in_.end : find_line_end(in_.p, in_.end);
    end_at(p == in_.end ? p : past_line_end(p, in_.end));
    return false;
}

/// Parses one item at `c`; false when the block ends here.
bool BlockParser::item(char c) {
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
    if (is_digit(c) || c == '.') raise_language_alarm(4, column, in_.blank_inside_number());
    if (c == '+' || c == '-') raise_language_alarm(6, column);
    if (c == '[' || c == ']' || c == '*') raise_language_alarm(114, column);
    if (!is_letter(c)) {
        const bool utf16 = c == '\xFF' || c == '\xFE';  // bytes of no other text
        raise_language_alarm(9, column,
                             utf16 ? "stray character: save a text in UTF-16 as plain text"
                             : c == '=' || c == '<' || c == '>' ? "stray character, "
                                                                  "a merge marker?"
                                                                : "stray character");
    }
    const Keyword keyword = read_keyword(in_.p, in_.end);
    if (keyword != Keyword::none) return statement(keyword, column), true;
    word(c);
    return true;
}

void BlockParser::finish() {
    const char* p = in_.p;
    end_at(p != in_.end && is_line_end(*p) ? past_line_end(p, in_.end) : p);
    block_.items.count = static_cast<std::uint32_t>(out_.items.size()) - block_.items.first;
    block_.comments.count =
        static_cast<std::uint32_t>(out_.comments.size()) - block_.comments.first;
    if (computed_) block_.kind = BlockKind::computed;
    if (statements_) block_.kind = BlockKind::statements;
    if (program_) block_.kind = BlockKind::program;
}

Item& BlockParser::add(ItemKind kind, std::uint16_t column) {
    (kind == ItemKind::word ? words_ : statements_) |= kind != ItemKind::skip;
    if (words_ && statements_) raise_language_alarm(127, column);
    if (closed_ && kind != ItemKind::skip) raise_language_alarm(125, column);
    in_.leading = false;
    if (out_.items.size() - block_.items.first >= most_items)
        raise_language_alarm(1090, column, "too many words in a block");
    Item& item = out_.items.emplace_back();
    item.kind = kind;
    item.column = column;
    return item;
}

void BlockParser::program_number(char) {
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
std::string_view BlockParser::name() {
    const std::uint16_t column = in_.column();
    const char* const first = ++in_.p;
    while (in_.p != in_.end && is_name_character(*in_.p)) ++in_.p;
    const auto size = static_cast<std::size_t>(in_.p - first);
    if (in_.p == in_.end || *in_.p != '>' || size == 0 || size > 32)
        raise_language_alarm(9, column, "neither a program name nor a block (a merge marker?)");
    ++in_.p;
    return {first, size};
}

void BlockParser::program_name() {
    const std::string_view text = name();
    block_.name = {static_cast<std::uint32_t>(text.data() - in_.begin),
                   static_cast<std::uint32_t>(text.size())};
    program_ = true;
}

/// `M98<NAME>`, `G65<NAME>`: a word whose value is text.
void BlockParser::called_name() {
    const std::uint16_t column = in_.column();
    const std::string_view text = name();
    Item& item = add(ItemKind::word, column);
    item.letter = '<';
    item.b = {static_cast<std::uint32_t>(out_.text.size()),
              static_cast<std::uint32_t>(text.size())};
    out_.text += text;
    computed_ = true;
}

void BlockParser::number_word() {
    ++in_.p;
    in_.peek();
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0) raise_language_alarm(5, column);
    if (n.point) raise_language_alarm(7, column);
    if (n.digits > 9) raise_language_alarm(3, column);
    block_.sequence_number = static_cast<int>(n.value);
}

/// `/` and `/1`..`/9`: false when the skip switch drops the rest of the block.
bool BlockParser::skip() {
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

void BlockParser::comma_word() {
    const std::uint16_t column = in_.column();
    ++in_.p;
    const char c = in_.peek();
    if (c == 'A') raise_language_alarm(9, column, "direct drawing dimensions are not emulated");
    if (c != 'R' && c != 'C') raise_language_alarm(9, column, "stray comma");
    const char letter = static_cast<char>(c - 'A' + 'a');
    ++in_.p;
    Item& item = add(ItemKind::word, column);
    item.letter = letter;
    word_value(item);
}

void BlockParser::word(char letter) {
    const std::uint16_t column = in_.column();
    ++in_.p;
    Item& item = add(ItemKind::word, column);
    item.letter = letter;
    word_value(item);
    if (letter == 'G' && (item.value == 65 || item.value == 66 || item.value == 66.1))
        macro_call_ = true;
}

void BlockParser::word_value(Item& item) {
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
    if (in_.peek() == '.') raise_language_alarm(7, in_.column(), in_.blank_inside_number());
}

/// Listings show the end of block as ';': accepted at the end of a line.
void BlockParser::semicolon() {
    const std::uint16_t column = in_.column();
    ++in_.p;
    if (in_.peek() != BlockReader::at_end)
        raise_language_alarm(9, column,
                             "';' is not in a Fanuc file (comments stand in round brackets)");
}

void read_names(std::string_view list, int number, VariableNames& names) {
    for (; !list.empty(); ++number) {
        const std::size_t comma = std::min(list.find(','), list.size());
        if (comma > 0) names[std::string(list.substr(0, comma))] = number;
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
}

Block parse_block(std::string_view text, std::uint64_t byte, int line, const ParseOptions& options,
                  Code& out) {
    return BlockParser(text, byte, line, options, out).run();
}

}  // namespace trunnion::interpreter
