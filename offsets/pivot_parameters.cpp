#include "offsets/pivot_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "offsets/axis_numbers.h"

namespace trunnion::offsets {

namespace {

/// Parameter numbers of one rotary axis. Those of the second axis are higher by five, its limits by
/// two.
struct AxisNumbers {
    int axis, direction, inclination, rotation, hypothetical_angle, upper, lower, hypothetical_bit;
};
constexpr AxisNumbers first_numbers{19681, 19682, 19683, 19684, 19685, 19741, 19742, 0};
constexpr AxisNumbers second_numbers{19686, 19687, 19688, 19689, 19690, 19743, 19744, 1};

[[noreturn]] void incorrect(int number) {
    throw Alarm(5459, fmt::format("MACHINE PARAMETER INCORRECT (No.{})", number));
}

double finite_value(const Parameters& parameters, int number) {
    const double value = parameters.get(number);
    if (!std::isfinite(value)) incorrect(number);
    return value;
}

int whole_value(const Parameters& parameters, int number) {
    const double value = finite_value(parameters, number);
    if (value != std::floor(value) || std::abs(value) > 1e6) incorrect(number);
    return static_cast<int>(value);
}

Vector3 vector_at(const Parameters& parameters, int number) {
    return {finite_value(parameters, number), finite_value(parameters, number + 1),
            finite_value(parameters, number + 2)};
}

/// Unit vector of X, Y, Z for 0, 1, 2, modulo 3.
Vector3 unit(int index) {
    return Vector3::Unit(index % 3);
}

Vector3 decode_line(const Parameters& parameters, const AxisNumbers& numbers) {
    const int direction = whole_value(parameters, numbers.direction);
    if (direction < 1 || direction > 6) incorrect(numbers.direction);
    if (direction <= 3) return unit(direction - 1);
    const double angle = rad_from_deg(finite_value(parameters, numbers.inclination));
    return std::cos(angle) * unit(direction - 4) + std::sin(angle) * unit(direction - 3);
}

/// 19741-19744: two zeros mean no limit.
void decode_limits(const Parameters& parameters, const AxisNumbers& numbers, PivotAxis& axis) {
    const double upper = finite_value(parameters, numbers.upper);
    const double lower = finite_value(parameters, numbers.lower);
    if (upper == 0.0 && lower == 0.0) return;
    if (lower > upper) incorrect(numbers.lower);
    axis.min_rad = rad_from_deg(lower);
    axis.max_rad = rad_from_deg(upper);
}

PivotAxis decode_axis(const Parameters& parameters, const AxisNumbers& numbers,
                      const std::vector<Axis>& order) {
    PivotAxis axis;
    axis.hypothetical = parameters.bit(19696, numbers.hypothetical_bit);
    axis.line = decode_line(parameters, numbers);
    const int rotation = whole_value(parameters, numbers.rotation);
    if (rotation != 0 && rotation != 1) incorrect(numbers.rotation);
    axis.sign = rotation == 0 ? 1.0 : -1.0;
    if (axis.hypothetical) {
        axis.hypothetical_rad = rad_from_deg(finite_value(parameters, numbers.hypothetical_angle));
        return axis;
    }
    const auto letter = axis_of_number(parameters, whole_value(parameters, numbers.axis), order);
    if (!letter || !is_rotary(*letter)) incorrect(numbers.axis);
    axis.axis = *letter;
    decode_limits(parameters, numbers, axis);
    return axis;
}

/// 19697 is the axis; 19698 rotates it about the next letter, 19699 about the one after that
/// (assumed).
Vector3 decode_tool_direction(const Parameters& parameters) {
    const int direction = whole_value(parameters, 19697);
    if (direction < 0 || direction > 3) incorrect(19697);
    const int index = direction == 0 ? 2 : direction - 1;
    const double ra_rad = rad_from_deg(finite_value(parameters, 19698));
    const double rb_rad = rad_from_deg(finite_value(parameters, 19699));
    if (ra_rad == 0.0 && rb_rad == 0.0) return unit(index);
    return rotation_about(unit(index + 2), rb_rad) * rotation_about(unit(index + 1), ra_rad) *
           unit(index);
}

MechanicalUnit decode_unit(const Parameters& parameters) {
    const int unit_type = whole_value(parameters, 19680);
    if (unit_type != 0 && unit_type != 2 && unit_type != 12 && unit_type != 21) incorrect(19680);
    return static_cast<MechanicalUnit>(unit_type);
}

void set_vector(Parameters& parameters, int number, const Vector3& value) {
    for (int i = 0; i < 3; ++i) parameters.set(number + i, value[i]);
}

constexpr double rounding = 1e-12;

struct EncodedLine {
    int direction = 3;
    double inclination_deg = 0.0;
    bool reversed = false;
};

EncodedLine encode_line(const Vector3& direction) {
    for (int i = 0; i < 3; ++i)
        if (1.0 - std::abs(direction[i]) < rounding) return {i + 1, 0.0, direction[i] < 0.0};
    for (int i = 0; i < 3; ++i)
        if (std::abs(direction[(i + 2) % 3]) < rounding)
            return {i + 4, deg_from_rad(std::atan2(direction[(i + 1) % 3], direction[i])), false};
    throw InputError(
        "a rotary axis line lies in no coordinate plane: No.19682 and 19687 cannot "
        "say that");
}

void encode_axis(const PivotAxis& axis, const AxisNumbers& numbers, Parameters& parameters,
                 const std::vector<Axis>& order) {
    const EncodedLine line = encode_line(axis.direction());
    parameters.set(numbers.axis, axis.hypothetical ? 0 : number_of_axis(axis.axis, order));
    parameters.set(numbers.direction, line.direction);
    parameters.set(numbers.inclination, line.inclination_deg);
    parameters.set(numbers.rotation, line.reversed ? 1 : 0);
    parameters.set(numbers.hypothetical_angle, deg_from_rad(axis.hypothetical_rad));
    parameters.set_bit(19696, numbers.hypothetical_bit, axis.hypothetical);
    if (!axis.min_rad || !axis.max_rad) return;
    parameters.set(numbers.upper, deg_from_rad(*axis.max_rad));
    parameters.set(numbers.lower, deg_from_rad(*axis.min_rad));
}

int encode_tool_direction(const Vector3& direction) {
    for (int i = 0; i < 3; ++i)
        if (1.0 - direction[i] < rounding) return i + 1;
    throw InputError("the tool lies along no + linear axis: No.19697 cannot say that");
}

}  // namespace

std::optional<PivotParameters> decode_pivot(const Parameters& parameters,
                                            const std::vector<Axis>& axis_order) {
    PivotParameters pivot;
    pivot.unit = decode_unit(parameters);
    if (pivot.unit == MechanicalUnit::none) return std::nullopt;
    pivot.first = decode_axis(parameters, first_numbers, axis_order);
    pivot.second = decode_axis(parameters, second_numbers, axis_order);
    const bool both_real = !pivot.first.hypothetical && !pivot.second.hypothetical;
    if (both_real && pivot.first.axis == pivot.second.axis) incorrect(second_numbers.axis);
    if (pivot.first.hypothetical && pivot.second.hypothetical) incorrect(19696);
    pivot.table_point_mm = vector_at(parameters, 19700);
    pivot.table_offset_mm = vector_at(parameters, 19703);
    pivot.tool_offset_mm = vector_at(parameters, 19709);
    pivot.tool_second_offset_mm = vector_at(parameters, 19712);
    pivot.tool_direction = decode_tool_direction(parameters);
    pivot.holder_offset_mm = finite_value(parameters, 19666);
    pivot.frame_follows_work = parameters.bit(19696, 5);
    pivot.parallel = parallel_axes(parameters, axis_order);
    return pivot;
}

void encode_pivot(const PivotParameters& pivot, Parameters& parameters,
                  const std::vector<Axis>& axis_order) {
    parameters.set(19680, static_cast<int>(pivot.unit));
    if (pivot.unit == MechanicalUnit::none) return;
    encode_axis(pivot.first, first_numbers, parameters, axis_order);
    encode_axis(pivot.second, second_numbers, parameters, axis_order);
    parameters.set(19697, encode_tool_direction(pivot.tool_direction));
    set_vector(parameters, 19700, pivot.table_point_mm);
    set_vector(parameters, 19703, pivot.table_offset_mm);
    set_vector(parameters, 19709, pivot.tool_offset_mm);
    set_vector(parameters, 19712, pivot.tool_second_offset_mm);
    parameters.set(19666, pivot.holder_offset_mm);
    parameters.set_bit(19696, 5, pivot.frame_follows_work);
}

}  // namespace trunnion::offsets
