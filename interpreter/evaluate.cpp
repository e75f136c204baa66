#include "interpreter/evaluate.h"

#include <cmath>

#include "base/units.h"
#include "interpreter/alarms.h"
#include "interpreter/block_parser.h"

namespace trunnion::interpreter {
namespace {

constexpr double largest = 1e47;  ///< +-10^47: range of a macro variable (assumed)

inline double zero_if_vacant(double x) {
    return is_vacant(x) ? 0.0 : x;
}

inline double in_range(double x, const Op& op) {
    if (!(std::fabs(x) <= largest)) raise_language_alarm(111, op.column);
    return x;
}

/// sin of degrees, exact at multiples of 90.
double sine_deg(double angle_deg) {
    const double quarters = angle_deg / 90.0;
    if (std::fabs(quarters) < 1e9 && quarters == std::trunc(quarters)) {
        constexpr double exact[] = {0.0, 1.0, 0.0, -1.0};
        return exact[static_cast<long>(quarters) & 3];
    }
    return std::sin(rad_from_deg(angle_deg));
}
double cosine_deg(double angle_deg) {
    const double quarters = angle_deg / 90.0;
    if (std::fabs(quarters) < 1e9 && quarters == std::trunc(quarters)) {
        constexpr double exact[] = {1.0, 0.0, -1.0, 0.0};
        return exact[static_cast<long>(quarters) & 3];
    }
    return std::cos(rad_from_deg(angle_deg));
}
double tangent_deg(double angle_deg, const Op& op) {
    const double cosine = cosine_deg(angle_deg);
    if (cosine == 0.0) raise_language_alarm(119, op.column);
    return sine_deg(angle_deg) == 0.0 ? 0.0 : std::tan(rad_from_deg(angle_deg));
}

double arc_function(double x, const Op& op, const EvaluationRules& rules) {
    if (!(std::fabs(x) <= 1.0)) raise_language_alarm(119, op.column);
    if (op.code == OpCode::acos) return deg_from_rad(std::acos(x));
    const double angle_deg = deg_from_rad(std::asin(x));
    return angle_deg < 0.0 && !rules.signed_angles ? angle_deg + 360.0 : angle_deg;
}

double arc_tangent(double y, double x, const Op& op, const EvaluationRules& rules) {
    if (x == 0.0 && y == 0.0) raise_language_alarm(119, op.column);
    const double angle_deg = deg_from_rad(std::atan2(y + 0.0, x));
    return angle_deg < 0.0 && !rules.signed_angles ? angle_deg + 360.0 : angle_deg;
}

/// 32 bits, two's complement, operands rounded.
std::int32_t bits(double x, const Op& op) {
    const double rounded = std::round(x);
    if (!(rounded >= -2147483648.0 && rounded <= 4294967295.0))
        raise_language_alarm(110, op.column);
    return static_cast<std::int32_t>(
        static_cast<std::uint32_t>(static_cast<std::int64_t>(rounded)));
}

double binary_of_bcd(double x, const Op& op) {
    auto code = static_cast<std::uint32_t>(bits(x, op));
    double value = 0.0;
    for (double weight = 1.0; code != 0; code >>= 4, weight *= 10.0) {
        if ((code & 15u) > 9u) raise_language_alarm(119, op.column);
        value += weight * (code & 15u);
    }
    return value;
}
double bcd_of_binary(double x, const Op& op) {
    const double rounded = std::round(x);
    if (!(rounded >= 0.0 && rounded <= 99999999.0)) raise_language_alarm(119, op.column);
    auto rest = static_cast<std::uint32_t>(rounded);
    std::uint32_t code = 0;
    for (int shift = 0; rest != 0; shift += 4, rest /= 10) code |= (rest % 10u) << shift;
    return code;
}

double unary(const Op& op, double x, const EvaluationRules& rules) {
    switch (op.code) {
        case OpCode::negate: return -x;
        case OpCode::sin: return sine_deg(x);
        case OpCode::cos: return cosine_deg(x);
        case OpCode::tan: return tangent_deg(x, op);
        case OpCode::asin:
        case OpCode::acos: return arc_function(x, op, rules);
        case OpCode::atan: return deg_from_rad(std::atan(x));
        case OpCode::sqrt:
            if (x < 0.0) raise_language_alarm(119, op.column);
            return std::sqrt(x);
        case OpCode::abs: return std::fabs(x);
        case OpCode::bin: return binary_of_bcd(x, op);
        case OpCode::bcd: return bcd_of_binary(x, op);
        case OpCode::round: return std::round(x);
        case OpCode::round_increment:
            return std::round(x * rules.increments_per_unit) / rules.increments_per_unit;
        case OpCode::fix: return std::trunc(x);
        case OpCode::fup: return x < 0.0 ? std::floor(x) : std::ceil(x);
        case OpCode::ln:
            if (!(x > 0.0)) raise_language_alarm(119, op.column);
            return std::log(x);
        case OpCode::exp: return in_range(std::exp(x), op);
        case OpCode::adp: return in_range(x * rules.increments_per_unit, op);
        default: return x;
    }
}

double power(double base, double exponent, const Op& op) {
    if (base == 0.0 && exponent < 0.0) raise_language_alarm(112, op.column);
    const double result = std::pow(base, exponent);
    if (std::isnan(result)) raise_language_alarm(119, op.column);
    return in_range(result, op);
}

/// Comparison with Fanuc's rule for vacant: EQ and NE distinguish vacant from 0; the other
/// operators treat it as 0.
bool compare(OpCode code, double a, double b) {
    if (code == OpCode::equal) return a == b || (is_vacant(a) && is_vacant(b));
    if (code == OpCode::not_equal) return !(a == b || (is_vacant(a) && is_vacant(b)));
    a = zero_if_vacant(a);
    b = zero_if_vacant(b);
    if (code == OpCode::greater) return a > b;
    if (code == OpCode::greater_equal) return a >= b;
    return code == OpCode::less ? a < b : a <= b;
}

double divide(double a, double b, const Op& op) {
    if (b == 0.0) raise_language_alarm(112, op.column);
    return in_range(a / b, op);
}

/// Operators that are too rare for the loop below.
double binary(const Op& op, double a, double b, const EvaluationRules& rules) {
    switch (op.code) {
        case OpCode::modulo:
            if (b == 0.0) raise_language_alarm(112, op.column);
            return std::fmod(a, b);
        case OpCode::bit_and: return bits(a, op) & bits(b, op);
        case OpCode::bit_or: return bits(a, op) | bits(b, op);
        case OpCode::bit_xor: return bits(a, op) ^ bits(b, op);
        case OpCode::atan2: return arc_tangent(a, b, op, rules);
        default: return power(a, b, op);
    }
}

double read_variable(const Op& op, int number, const Memory& memory) {
    try {
        return memory.get(number);
    } catch (Alarm& alarm) {
        if (alarm.where.column == 0) alarm.where.column = op.column;
        throw;
    }
}

double read_parameter(const Op& op, const double* operands, const Memory& memory) {
    const auto whole = [&](int i) { return whole_number(operands[i], op.column); };
    switch (op.code) {
        case OpCode::prm: return memory.system.parameter(whole(0), -1, -1);
        case OpCode::prm_bit: return memory.system.parameter(whole(0), whole(1), -1);
        case OpCode::prm_axis: return memory.system.parameter(whole(0), -1, whole(1));
        default: return memory.system.parameter(whole(0), whole(1), whole(2));
    }
}

/// #1 .. #33 of the level that runs.
inline double local(const Memory& memory, int number) {
    return (*memory.locals)[static_cast<std::size_t>(number)];
}

/// Operands of PRM after the parameter number: bit and axis.
int qualifiers(OpCode code) {
    return code == OpCode::prm ? 0 : code == OpCode::prm_bit_axis ? 2 : 1;
}

}  // namespace

int whole_number(double value, int column) {
    if (is_vacant(value)) return 0;
    if (!(std::fabs(value) < 1e9)) raise_language_alarm(110, column);
    const int whole = static_cast<int>(value);
    return whole == value ? whole : static_cast<int>(std::lround(value));
}

double evaluate(const Op* code, std::uint32_t count, const Memory& memory,
                const EvaluationRules& rules) {
    double stack[expression_stack + 1];
    double* top = stack;  // one past the last operand
    for (const Op *op = code, *end = code + count; op != end; ++op) {
        switch (op->code) {
            case OpCode::constant: *top++ = op->value; break;
            case OpCode::vacant: *top++ = vacant; break;
            case OpCode::local: *top++ = local(memory, op->number); break;
            case OpCode::common: *top++ = memory.common[op->slot]; break;
            case OpCode::system: *top++ = read_variable(*op, op->number, memory); break;
            case OpCode::indirect:
                top[-1] = read_variable(*op, whole_number(top[-1], op->column), memory);
                break;
            case OpCode::add:
                --top;
                top[-1] = in_range(zero_if_vacant(top[-1]) + zero_if_vacant(*top), *op);
                break;
            case OpCode::subtract:
                --top;
                top[-1] = in_range(zero_if_vacant(top[-1]) - zero_if_vacant(*top), *op);
                break;
            case OpCode::multiply:
                --top;
                top[-1] = in_range(zero_if_vacant(top[-1]) * zero_if_vacant(*top), *op);
                break;
            case OpCode::divide:
                --top;
                top[-1] = divide(zero_if_vacant(top[-1]), zero_if_vacant(*top), *op);
                break;
            case OpCode::modulo:
            case OpCode::bit_and:
            case OpCode::bit_or:
            case OpCode::bit_xor:
            case OpCode::atan2:
            case OpCode::pow:
                --top;
                top[-1] = binary(*op, zero_if_vacant(top[-1]), zero_if_vacant(*top), rules);
                break;
            case OpCode::equal:
            case OpCode::not_equal:
            case OpCode::greater:
            case OpCode::greater_equal:
            case OpCode::less:
            case OpCode::less_equal:
                --top;
                top[-1] = compare(op->code, top[-1], *top) ? 1.0 : 0.0;
                break;
            case OpCode::prm:
            case OpCode::prm_bit:
            case OpCode::prm_axis:
            case OpCode::prm_bit_axis:
                top -= qualifiers(op->code);
                top[-1] = read_parameter(*op, top - 1, memory);
                break;
            default: top[-1] = unary(*op, zero_if_vacant(top[-1]), rules); break;
        }
    }
    return stack[0];
}

}  // namespace trunnion::interpreter
