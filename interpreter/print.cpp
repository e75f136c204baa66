#include "interpreter/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "interpreter/keywords.h"
#include "interpreter/lexical.h"

namespace trunnion::interpreter {
namespace {

/// Text of a part of an expression, with the data that decide about brackets.
struct Part {
    std::string text;
    Precedence precedence = Precedence::none;  ///< none: a value, a function, a bracket
    bool negated = false;
    bool open_call = false;  ///< ends in ATAN[..] or PRM[..]: a following `/[` would belong to it
    int depth = 0;           ///< nested grouping brackets, as counted by the parser
};

std::string bracketed(const std::string& text) {
    return "[" + text + "]";
}

Part grouped(const Part& part) {
    return {bracketed(part.text), Precedence::none, false, false, part.depth + 1};
}

std::string print_operator(OpCode code) {
    const std::string word = spelling(code);
    return is_letter(word[0]) ? " " + word + " " : word;
}

Part binary_part(OpCode code, const Part& left, const Part& right) {
    const Precedence p = precedence(code);
    const auto looser = [&](const Part& part) {
        return part.precedence != Precedence::none && part.precedence < p;
    };
    const bool equal_right = right.precedence != Precedence::none && right.precedence == p;
    const Part r = looser(right) || equal_right ? grouped(right) : right;
    const bool swallowed = code == OpCode::divide && left.open_call && r.text[0] == '[';
    const Part l = looser(left) || swallowed ? grouped(left) : left;
    return {l.text + print_operator(code) + r.text, p, false, r.open_call,
            std::max(l.depth, r.depth)};
}

Part negated_part(const Part& part) {
    const bool bracket = part.precedence != Precedence::none || part.negated;
    const Part p = bracket ? grouped(part) : part;
    return {"-" + p.text, Precedence::none, true, p.open_call, p.depth};
}

class ExpressionPrinter {
  public:
    Part print(std::span<const Op> ops) {
        for (const Op& op : ops) step(op);
        return std::move(parts_.back());
    }

  private:
    Part pop() {
        Part part = std::move(parts_.back());
        parts_.pop_back();
        return part;
    }
    void push(std::string text, bool open_call = false, int depth = 0) {
        parts_.push_back({std::move(text), Precedence::none, false, open_call, depth});
    }
    void step(const Op& op);
    void call(const Op& op);

    std::vector<Part> parts_;
};

void ExpressionPrinter::step(const Op& op) {
    switch (op.code) {
        case OpCode::constant:
            return push(print_number(op.value, op.value != std::floor(op.value)));
        case OpCode::vacant: return push("#0");
        case OpCode::local:
        case OpCode::common:
        case OpCode::system: return push(fmt::format("#{}", op.number));
        case OpCode::indirect: {
            const Part number = grouped(pop());
            return push("#" + number.text, false, number.depth);
        }
        case OpCode::negate: return parts_.push_back(negated_part(pop()));
        default: break;
    }
    if (precedence(op.code) == Precedence::none) return call(op);
    const Part right = pop();
    const Part left = pop();
    parts_.push_back(binary_part(op.code, left, right));
}

/// Operands of a call, joined as its code requires.
void ExpressionPrinter::call(const Op& op) {
    const Part last = pop();
    const bool two = op.code == OpCode::atan2 || op.code == OpCode::pow ||
                     op.code == OpCode::prm_axis || op.code == OpCode::prm_bit;
    if (op.code == OpCode::prm_bit_axis) {
        const Part bit = pop(), number = pop();
        return push("PRM" + bracketed(number.text + "," + bit.text) + "/" + bracketed(last.text),
                    false, std::max({number.depth, bit.depth, last.depth}));
    }
    if (!two) {
        const bool open = op.code == OpCode::atan || op.code == OpCode::prm;
        return push(spelling(op.code) + bracketed(last.text), open, last.depth);
    }
    const Part first = pop();
    const int depth = std::max(first.depth, last.depth);
    const std::string word = op.code == OpCode::atan2 ? "ATAN"
                             : op.code == OpCode::pow ? "POW"
                                                      : "PRM";
    if (op.code == OpCode::pow || op.code == OpCode::prm_bit)
        return push(word + bracketed(first.text + "," + last.text), op.code == OpCode::prm_bit,
                    depth);
    push(word + bracketed(first.text) + "/" + bracketed(last.text), false, depth);
}

bool is_variable(std::span<const Op> ops) {
    const OpCode last = ops.back().code;
    return last == OpCode::indirect || (ops.size() == 1 && last != OpCode::constant);
}

class BlockPrinter {
  public:
    BlockPrinter(const ParsedProgram& program, const Block& block)
        : program_(program), block_(block) {}
    std::string print();

  private:
    void head();
    void comments(bool leading);
    void item(const Item& item);
    void word(const Item& item);
    void assignment(const Item& item);
    void gap() {
        if (!out_.empty() && out_.back() != ' ' && !after_skip_) out_ += ' ';
        after_skip_ = false;
    }
    Part part(Span span) const { return ExpressionPrinter().print(program_.expression(span)); }
    std::string condition(const Item& item) const;
    /// `#1` or `[..]`
    std::string value(Span span) const {
        const std::string text = part(span).text;
        return is_variable(program_.expression(span)) ? text : bracketed(text);
    }
    std::string characters(const Item& item) const {
        return program_.code.text.substr(item.b.first, item.b.count);
    }

    const ParsedProgram& program_;
    const Block& block_;
    std::string out_;
    bool after_skip_ = false;
    bool binary_ = false;  ///< inside BPRNT
};

std::string BlockPrinter::print() {
    if (block_.kind == BlockKind::end_of_record) {
        const std::string_view text = program_.text(block_);
        return std::string(text.substr(0, text.find(control_z)));
    }
    head();
    comments(true);
    bool printing = false;  // inside DPRNT[..]
    for (const Item& i : program_.items(block_)) {
        const bool part = i.kind == ItemKind::print_text || i.kind == ItemKind::print_value;
        if (printing && !part) out_ += ']';
        printing = part || i.kind == ItemKind::dprnt || i.kind == ItemKind::bprnt;
        item(i);
    }
    if (printing) out_ += ']';
    comments(false);
    return out_;
}

void BlockPrinter::head() {
    if (block_.name.count > 0) out_ += fmt::format("<{}>", program_.name(block_));
    if (block_.o_number >= 0) out_ += fmt::format("O{:04}", block_.o_number);
    if (block_.sequence_number < 0) return;
    gap();
    out_ += fmt::format("N{}", block_.sequence_number);
}

void BlockPrinter::comments(bool leading) {
    for (const Comment& comment : program_.comments(block_)) {
        if (comment.leading != leading) continue;
        gap();
        out_ += fmt::format("({})", program_.text(comment));
    }
}

void BlockPrinter::word(const Item& item) {
    if (item.letter == '<') {
        out_ += "<" + characters(item) + ">";
        return;
    }
    if (item.letter >= 'a') out_ += ',';
    out_ += upper(item.letter);
    if (item.a.count == 0) {
        out_ += print_number(item.value, item.decimal_point);
        return;
    }
    if (item.negative) out_ += '-';
    out_ += value(item.a);
}

void BlockPrinter::assignment(const Item& item) {
    out_ += '#';
    if (item.b.count == 0)
        out_ += fmt::format("{}", static_cast<int>(item.value));
    else
        out_ += bracketed(part(item.b).text);
    const Part right = part(item.a);
    out_ += '=';
    out_ += right.precedence == Precedence::comparison ? bracketed(right.text) : right.text;
}

/// `[a EQ b]`; where another bracket would exceed the nesting limit, `[..] AND [..]` is printed
/// without it.
std::string BlockPrinter::condition(const Item& item) const {
    const Part text = part(item.a);
    return text.text[0] == '[' && text.depth >= bracket_levels ? text.text : bracketed(text.text);
}

void BlockPrinter::item(const Item& item) {
    switch (item.kind) {
        case ItemKind::print_text: out_ += characters(item); return;
        case ItemKind::print_value: {
            out_ += part(item.a).text + (binary_ ? fmt::format("[{}]", item.digits)
                                                 : fmt::format("[{}{}]", item.number, item.digits));
            return;
        }
        default: gap(); break;
    }
    switch (item.kind) {
        case ItemKind::word: return word(item);
        case ItemKind::skip:
            out_ += item.number == 1 ? "/" : fmt::format("/{}", item.number);
            after_skip_ = true;
            return;
        case ItemKind::assign: return assignment(item);
        case ItemKind::if_goto: out_ += "IF" + condition(item); return;
        case ItemKind::if_then: out_ += "IF" + condition(item) + " THEN"; return;
        case ItemKind::if_block: out_ += "IF" + condition(item) + " THEN"; return;
        case ItemKind::else_: out_ += "ELSE"; return;
        case ItemKind::end_if: out_ += "ENDIF"; return;
        case ItemKind::while_do:
            out_ += fmt::format("WHILE{} DO{}", condition(item), item.number);
            return;
        case ItemKind::do_only: out_ += fmt::format("DO{}", item.number); return;
        case ItemKind::end: out_ += fmt::format("END{}", item.number); return;
        case ItemKind::go_to:
            out_ += "GOTO" + (item.a.count == 0 ? print_number(item.value, false) : value(item.a));
            return;
        case ItemKind::popen: out_ += "POPEN"; return;
        case ItemKind::pclos: out_ += "PCLOS"; return;
        case ItemKind::dprnt: out_ += "DPRNT["; return;
        case ItemKind::bprnt:
            out_ += "BPRNT[";
            binary_ = true;
            return;
        case ItemKind::setvn:
            out_ += fmt::format("SETVN{}[{}]", static_cast<int>(item.value), characters(item));
            return;
        default: return;
    }
}

}  // namespace

std::string print_number(double value, bool decimal_point) {
    std::array<char, 400> digits;
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                            std::chars_format::fixed);
    std::string text(digits.data(), end);
    if (decimal_point && text.find('.') == std::string::npos) text += '.';
    const std::size_t zero = text.find("0.");
    if (text.size() > 16 && zero == (text[0] == '-' ? 1u : 0u)) text.erase(zero, 1);
    return text;
}

std::string print_block(const ParsedProgram& program, const Block& block) {
    return BlockPrinter(program, block).print();
}

std::string print_program(const ParsedProgram& program) {
    std::string out;
    for (const Block& block : program.blocks) out += print_block(program, block) + "\n";
    return out;
}

}  // namespace trunnion::interpreter
