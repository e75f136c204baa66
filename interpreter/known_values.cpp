#include "interpreter/known_values.h"

#include <algorithm>
#include <vector>

#include "interpreter/alarms.h"

namespace trunnion::interpreter {
namespace {

std::size_t operands_of(OpCode code) {
    switch (code) {
        case OpCode::constant:
        case OpCode::vacant:
        case OpCode::local:
        case OpCode::common:
        case OpCode::system: return 0;
        case OpCode::add:
        case OpCode::subtract:
        case OpCode::multiply:
        case OpCode::divide:
        case OpCode::modulo:
        case OpCode::bit_and:
        case OpCode::bit_or:
        case OpCode::bit_xor:
        case OpCode::equal:
        case OpCode::not_equal:
        case OpCode::greater:
        case OpCode::greater_equal:
        case OpCode::less:
        case OpCode::less_equal:
        case OpCode::atan2:
        case OpCode::pow:
        case OpCode::prm_bit:
        case OpCode::prm_axis: return 2;
        case OpCode::prm_bit_axis: return 3;
        default: return 1;
    }
}

bool reads_parameter(OpCode code) {
    return code == OpCode::prm || code == OpCode::prm_bit || code == OpCode::prm_axis ||
           code == OpCode::prm_bit_axis;
}

bool needs_rules(OpCode code) {
    return code == OpCode::asin || code == OpCode::atan2 || code == OpCode::round_increment ||
           code == OpCode::adp;
}

}  // namespace

/// One operand of the expression: its steps begin at `first` and end where the next one begins.
struct KnownValues::Part {
    std::uint32_t first = 0;
    bool known = false;
};

KnownValues::KnownValues(bool has_98000, SystemAlarm system_alarm)
    : system_alarm_(std::move(system_alarm)), memory_(system_, has_98000) {
    locals_.fill(vacant);
    memory_.locals = &locals_;
}

double KnownValues::evaluated(std::span<const Op> code) const {
    return evaluate(code.data(), static_cast<std::uint32_t>(code.size()), memory_,
                    rules.value_or(EvaluationRules{}));
}

bool KnownValues::owns(int number) const {
    return number < 1000 || common_slot(number, memory_.has_98000) >= 0;
}

/// Of a variable whose number is computed.
bool KnownValues::knows(int number, int column) const {
    if (number == 0) return true;
    if (!owns(number)) {
        const int alarm = system_alarm_ ? system_alarm_(number) : 0;
        if (alarm != 0) raise_language_alarm(alarm, column);
        return false;
    }
    const bool exists =
        (number > 0 && number <= local_count) || common_slot(number, memory_.has_98000) >= 0;
    if (!exists) raise_language_alarm(115, column);
    return known_.contains(number);
}

/// x/0 and x MOD 0 are alarms for every x.
void KnownValues::refuse_zero_divisor(std::span<const Op> divisor, const Op& op) const {
    std::vector<Op> code(1);
    code[0].code = OpCode::constant;
    code.insert(code.end(), divisor.begin(), divisor.end());
    code.push_back(op);
    evaluated(code);
}

/// The operands and the step at `at` as one part. Known operands of an unknown result are
/// evaluated for their alarms.
KnownValues::Part KnownValues::joined(std::span<const Op> code, std::span<const Part> operands,
                                      std::uint32_t at) const {
    const Op& op = code[at];
    const std::uint32_t first = operands.empty() ? at : operands.front().first;
    const auto whole = code.subspan(first, at + 1 - first);
    const bool all = std::all_of(operands.begin(), operands.end(),
                                 [](const Part& operand) { return operand.known; });
    if (op.code == OpCode::system) return {first, false};
    if (op.code == OpCode::local || op.code == OpCode::common)
        return {first, known_.contains(op.number)};
    if (all && op.code == OpCode::indirect) {
        const double number = evaluated(whole.first(whole.size() - 1));
        return {first, knows(whole_number(number, op.column), op.column)};
    }
    if (all && !reads_parameter(op.code)) {
        if (!needs_rules(op.code) || rules) return {first, true};
        evaluated(whole);  // for its alarms
        return {first, false};
    }
    for (std::size_t i = 0; i < operands.size(); ++i) {
        if (!operands[i].known) continue;
        const std::uint32_t end = i + 1 < operands.size() ? operands[i + 1].first : at;
        const double v = evaluated(code.subspan(operands[i].first, end - operands[i].first));
        if (reads_parameter(op.code)) whole_number(v, op.column);
    }
    const bool divides = op.code == OpCode::divide || op.code == OpCode::modulo;
    if (divides && operands[1].known)
        refuse_zero_divisor(code.subspan(operands[1].first, at - operands[1].first), op);
    return {first, false};
}

std::optional<double> KnownValues::value(std::span<const Op> code) const {
    std::vector<Part> parts;
    for (std::uint32_t at = 0; at < code.size(); ++at) {
        const std::size_t count = operands_of(code[at].code);
        const Part part = joined(code, std::span(parts).last(count), at);
        parts.resize(parts.size() - count);
        parts.push_back(part);
    }
    if (!parts.front().known) return std::nullopt;
    return evaluated(code);
}

std::optional<int> KnownValues::target(std::span<const Op> code, int column) const {
    const auto number = value(code);
    if (!number) return std::nullopt;
    return whole_number(*number, column);
}

void KnownValues::set(int number, std::optional<double> value) {
    if (number != 0) knows(number, 0);  // 115 for a number that no variable has
    memory_.set(number, value.value_or(vacant));
    if (value)
        known_.insert(number);
    else
        known_.erase(number);
}

}  // namespace trunnion::interpreter
