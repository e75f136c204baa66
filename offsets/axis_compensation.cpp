#include "offsets/axis_compensation.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "offsets/axis_numbers.h"
#include "offsets/whole_parameter.h"

namespace trunnion::offsets {

namespace {

constexpr int first_pitch_number = 10000;
constexpr int most_points = 1536;  ///< 10000 to 11535
constexpr int backlash_number = 1851;

/// 1820: 2 CMR, or 100 + 1 / CMR; absent: CMR 1.
double command_multiplier(double parameter) {
    if (parameter > 100.0) return 1.0 / (parameter - 100.0);
    return parameter > 0.0 ? parameter / 2.0 : 1.0;
}

/// Of 1851 and the pitch data, mm or rad.
double detection_unit(const Parameters& parameters, Axis axis, int number) {
    const auto bits = bits_of_parameter(value_of_axis(parameters, 1013, number).value_or(0.0));
    const double least = bits & 2U ? 1e-4 : 1e-3;
    const double unit = is_rotary(axis)           ? rad_from_deg(1.0)
                        : parameters.bit(1001, 0) ? mm_from_inch(0.1)
                                                  : 1.0;
    return least * unit / command_multiplier(value_of_axis(parameters, 1820, number).value_or(0.0));
}

/// Numbers of the points of one axis: those of the reference position and of both ends.
struct PitchPoints {
    int reference = 0, first = 0, last = 0;
};

std::optional<PitchPoints> points_of(const Parameters& parameters, int number) {
    const auto point = [&](int parameter) {
        return whole_parameter(value_of_axis(parameters, parameter, number).value_or(0.0));
    };
    const PitchPoints points{point(3620), point(3621), point(3622)};
    const bool right = 0 <= points.first && points.first <= points.reference + 1 &&
                       points.reference <= points.last && points.last < most_points &&
                       points.first < points.last;
    return right ? std::optional(points) : std::nullopt;
}

/// The datum of a point is the step that ends there, so the table begins one point earlier; of a
/// rotary axis only where the points leave a part of the turn.
void fill_pitch(const Parameters& parameters, int number, double unit, AxisCompensation& out) {
    const auto points = points_of(parameters, number);
    const double per_unit = is_rotary(out.axis) ? rad_from_deg(1.0) : 1.0;
    const double interval = per_unit * value_of_axis(parameters, 3624, number).value_or(0.0);
    if (!points || !(interval > 0.0)) return;
    const double factor =
        unit * std::max(1.0, value_of_axis(parameters, 3623, number).value_or(0.0));
    const double origin = per_unit * value_of_axis(parameters, 1240, number).value_or(0.0);
    if (is_rotary(out.axis)) {
        const double degrees = value_of_axis(parameters, 3625, number).value_or(0.0);
        out.turn = rad_from_deg(degrees > 0.0 ? degrees : 360.0);
    }
    const bool whole =
        out.turn > 0.0 && (points->last - points->first) * interval > out.turn - 1e-9;
    const auto step = [&](int point) {
        return factor * parameters.get(first_pitch_number + point);
    };
    double sum = 0.0;
    for (int point = points->reference; point >= points->first; --point) sum -= step(point);
    for (int point = points->first - 1; point <= points->last; ++point) {
        if (point >= points->first) sum += step(point);
        if (point < points->first && whole) continue;
        out.at.push_back(origin + (point - points->reference) * interval);
        out.value.push_back(sum);
    }
    if (std::all_of(out.value.begin(), out.value.end(), [](double v) { return v == 0.0; }))
        out.at.clear(), out.value.clear();
}

}  // namespace

double AxisCompensation::pitch(double position) const {
    if (at.empty()) return 0.0;
    double q = position;
    if (turn > 0.0) q -= turn * std::floor((q - at.front()) / turn);
    if (q <= at.front()) return value.front();
    if (q >= at.back()) return value.back();
    const auto above =
        static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), q) - at.begin());
    const double part = (q - at[above - 1]) / (at[above] - at[above - 1]);
    return value[above - 1] + part * (value[above] - value[above - 1]);
}

std::vector<AxisCompensation> decode_compensation(const Parameters& parameters,
                                                  const std::vector<Axis>& order) {
    std::vector<AxisCompensation> all;
    for (const Axis axis : order) {
        const int number = number_of_named_axis(parameters, axis, order);
        AxisCompensation one{axis, 0.0, {}, {}, 0.0};
        const double unit = detection_unit(parameters, axis, number);
        one.backlash = unit * value_of_axis(parameters, backlash_number, number).value_or(0.0);
        fill_pitch(parameters, number, unit, one);
        if (one.backlash != 0.0 || !one.at.empty()) all.push_back(std::move(one));
    }
    return all;
}

}  // namespace trunnion::offsets
