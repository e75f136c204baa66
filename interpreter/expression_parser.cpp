#include "interpreter/expression_parser.h"

#include "interpreter/alarms.h"
#include "interpreter/memory.h"

namespace trunnion::interpreter {
namespace {

constexpr std::size_t most_ops = 65536;  ///< per block, so that a line of any length ends

std::uint32_t size_of(const Code& code) {
    return static_cast<std::uint32_t>(code.ops.size());
}
Span since(const Code& code, std::uint32_t first) {
    return {first, size_of(code) - first};
}

}  // namespace

Span ExpressionParser::expression(Precedence lowest) {
    const std::uint32_t first = size_of(out_);
    stack_ = 0;
    binary(lowest);
    return since(out_, first);
}

Span ExpressionParser::variable() {
    const std::uint32_t first = size_of(out_);
    stack_ = 0;
    load(in_.column());
    return since(out_, first);
}

Span ExpressionParser::bracketed() {
    const std::uint32_t first = size_of(out_);
    stack_ = 0;
    bracket();
    return since(out_, first);
}

Span ExpressionParser::variable_number(int& number) {
    const std::uint32_t first = size_of(out_);
    stack_ = 0;
    reference(number);
    return since(out_, first);
}

void ExpressionParser::emit(OpCode code, std::uint16_t column, int operands) {
    stack_ += 1 - operands;
    if (stack_ > expression_stack) raise_language_alarm(118, column);
    if (out_.ops.size() - first_op_ >= most_ops)
        raise_language_alarm(1090, column, "too long an expression");
    Op op;
    op.code = code;
    op.column = column;
    out_.ops.push_back(op);
}

/// Left-associative operators of `level`; operators of higher precedence are parsed first.
void ExpressionParser::binary(Precedence level) {
    const auto tighter = static_cast<Precedence>(static_cast<int>(level) + 1);
    const auto operand = [&] { level == Precedence::product ? unary() : binary(tighter); };
    operand();
    while (in_.peek() != BlockReader::at_end) {
        const char* const before = in_.p;
        const std::uint16_t column = in_.column();
        OpCode op;
        if (read_operator(in_.p, in_.end, op) != level) {
            in_.p = before;
            return;
        }
        operand();
        emit(op, column, 2);
    }
}

void ExpressionParser::unary() {
    const char c = in_.peek();
    const std::uint16_t column = in_.column();
    if (c == '-' || c == '+') ++in_.p;
    primary();
    if (c == '-') emit(OpCode::negate, column, 1);
}

void ExpressionParser::primary() {
    const char c = in_.peek();
    const std::uint16_t column = in_.column();
    if (c == '#') return load(column);
    if (c == '[') return bracket();
    if (is_digit(c) || c == '.') return number();
    if (c == '+' || c == '-') raise_language_alarm(6, column);
    OpCode code;
    if (!is_letter(c) || !read_function(in_.p, in_.end, code)) raise_language_alarm(114, column);
    function(code, column);
}

void ExpressionParser::number() {
    const std::uint16_t column = in_.column();
    const Number n = read_number(in_.p, in_.end);
    if (n.digits == 0) raise_language_alarm(7, column);
    if (n.digits > 15) raise_language_alarm(3, column);
    if (in_.peek() == '.') raise_language_alarm(7, in_.column(), in_.blank_inside_number());
    emit(OpCode::constant, column, 0);
    out_.ops.back().value = n.value;
}

/// A grouping `[..]`, nested at most five levels. Function brackets do not count (assumed), but
/// have their own limit.
void ExpressionParser::bracket() {
    if (++brackets_ > bracket_levels) raise_language_alarm(118, in_.column());
    open();
    close();
    --brackets_;
}

/// '[' and its content up to ',' or ']'.
void ExpressionParser::open() {
    in_.expect('[', 1131);
    if (++depth_ > function_levels) raise_language_alarm(118, in_.column() - 1);
    binary(Precedence::comparison);
}

void ExpressionParser::close() {
    in_.expect(']', 1132);
    --depth_;
}

void ExpressionParser::function(OpCode code, std::uint16_t column) {
    if (code == OpCode::atan) return atan(column);
    if (code == OpCode::prm) return prm(column);
    if (code == OpCode::pow) {
        open();
        in_.expect(',', 1134);
        binary(Precedence::comparison);
        close();
        return emit(code, column, 2);
    }
    open();
    close();
    if (code == OpCode::round && round_to_increment) code = OpCode::round_increment;
    emit(code, column, 1);
}

/// The second bracket of FUNCTION[a]/[b]; nothing is consumed if no bracket follows the slash.
bool ExpressionParser::slash_bracket() {
    const char* const before = in_.p;
    if (in_.peek() == '/') {
        ++in_.p;
        if (in_.peek() == '[') {
            open();
            close();
            return true;
        }
    }
    in_.p = before;
    return false;
}

/// ATAN[a], ATAN[a]/[b] (not a division) and ATAN[a,b].
void ExpressionParser::atan(std::uint16_t column) {
    open();
    const bool comma = in_.peek() == ',';
    if (comma) {
        ++in_.p;
        binary(Precedence::comparison);
    }
    close();
    if (comma) return emit(OpCode::atan2, column, 2);
    if (slash_bracket()) return emit(OpCode::atan2, column, 2);
    emit(OpCode::atan, column, 1);
}

/// PRM[n], PRM[n,bit], PRM[n]/[axis], PRM[n,bit]/[axis].
void ExpressionParser::prm(std::uint16_t column) {
    open();
    const bool bit = in_.peek() == ',';
    if (bit) {
        ++in_.p;
        binary(Precedence::comparison);
    }
    close();
    if (slash_bracket())
        return emit(bit ? OpCode::prm_bit_axis : OpCode::prm_axis, column, bit ? 3 : 2);
    emit(bit ? OpCode::prm_bit : OpCode::prm, column, bit ? 2 : 1);
}

void ExpressionParser::load(std::uint16_t column) {
    int number = 0;
    if (!reference(number)) return emit(OpCode::indirect, column, 1);
    const int slot = common_slot(number, options_.dialect.has_98000);
    OpCode code = OpCode::system;
    if (number == 0) code = OpCode::vacant;
    if (number >= 1 && number <= local_count) code = OpCode::local;
    if (slot >= 0) code = OpCode::common;
    emit(code, column, 0);
    out_.ops.back().number = number;
    if (slot >= 0) out_.ops.back().slot = static_cast<std::uint32_t>(slot);
}

/// '#' and the variable's name: true with a constant `number`, false with code for it.
bool ExpressionParser::reference(int& number) {
    in_.expect('#', 114);
    const char c = in_.peek();
    const std::uint16_t column = in_.column();
    if (c == '<')
        raise_language_alarm(114, column, "named parameters #<name> are LinuxCNC's, not Fanuc's");
    if (c == '[') {
        number = named_variable();
        if (number >= 0) return true;
        bracket();
        return false;
    }
    if (!is_digit(c)) raise_language_alarm(114, column, "variable number expected behind #");
    const Number n = read_number(in_.p, in_.end);
    if (n.point) raise_language_alarm(7, column);
    if (n.digits > 9) raise_language_alarm(115, column);
    number = static_cast<int>(n.value);
    return true;
}

/// `[#NAME]` with a name given by SETVN; -1 (nothing consumed) for any other form.
int ExpressionParser::named_variable() {
    const char* const before = in_.p;
    const std::size_t comments = out_.comments.size();
    ++in_.p;
    if (in_.peek() == '#') {
        ++in_.p;
        if (is_letter(in_.peek())) {
            const std::uint16_t column = in_.column();
            std::string name;
            while (in_.p != in_.end && (is_letter(*in_.p) || is_digit(*in_.p) || *in_.p == '_'))
                name += upper(*in_.p++);
            in_.expect(']', 1132);
            if (!options_.names) return 0;
            const auto it = options_.names->find(name);
            if (it == options_.names->end()) raise_language_alarm(1096, column, name);
            return it->second;
        }
    }
    in_.p = before;
    out_.comments.resize(comments);
    return -1;
}

}  // namespace trunnion::interpreter
