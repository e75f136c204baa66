#include "kinematics/errors.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace trunnion::kinematics {
namespace {

constexpr std::string_view directions = "XYZABC";

std::size_t direction_index(const ErrorName& name) {
    return directions.find(name.direction);
}

/// Slope of the cubic at point i: the slope of the parabola through i and its two neighbours, or of
/// the chord at either end.
double knot_slope(const ErrorCurve& curve, std::size_t i) {
    const auto& x = curve.at;
    const auto& y = curve.value;
    const auto chord = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
    if (i == 0) return chord(0);
    if (i + 1 == x.size()) return chord(i - 1);
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    return (chord(i - 1) * right + chord(i) * left) / (left + right);
}

struct ValueAndSlope {
    double value = 0.0;
    double slope = 0.0;
};

ValueAndSlope cubic(const ErrorCurve& curve, std::size_t i, double q) {
    const double h = curve.at[i + 1] - curve.at[i];
    const double t = (q - curve.at[i]) / h;
    const double y0 = curve.value[i], y1 = curve.value[i + 1];
    const double m0 = h * knot_slope(curve, i), m1 = h * knot_slope(curve, i + 1);
    const double a = 2.0 * (y0 - y1) + m0 + m1, b = 3.0 * (y1 - y0) - 2.0 * m0 - m1;
    return {((a * t + b) * t + m0) * t + y0, ((3.0 * a * t + 2.0 * b) * t + m0) / h};
}

/// The value of a position that q meets, else 0.
double at_place(const ErrorCurve& curve, double q) {
    constexpr double meets = 0.01;  // of the distance to the nearest other position
    const auto& x = curve.at;
    const auto above = std::upper_bound(x.begin(), x.end(), q);
    for (auto place = above == x.begin() ? above : above - 1; place != x.end() && place <= above;
         ++place) {
        double apart = HUGE_VAL;
        if (place != x.begin()) apart = *place - *(place - 1);
        if (place + 1 != x.end()) apart = std::min(apart, *(place + 1) - *place);
        if (std::abs(q - *place) <= meets * apart)
            return curve.value[static_cast<std::size_t>(place - x.begin())];
    }
    return 0.0;
}

ValueAndSlope table(const ErrorCurve& curve, double q, double commanded) {
    if (curve.interpolation == ErrorCurve::Interpolation::none)
        return {at_place(curve, commanded), 0.0};
    const auto& x = curve.at;
    if (q <= x.front()) return {curve.value.front(), 0.0};
    if (q >= x.back()) return {curve.value.back(), 0.0};
    const auto above = std::upper_bound(x.begin(), x.end(), q);
    const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
    if (curve.interpolation == ErrorCurve::Interpolation::cubic) return cubic(curve, i, q);
    const double slope = (curve.value[i + 1] - curve.value[i]) / (x[i + 1] - x[i]);
    return {curve.value[i] + slope * (q - x[i]), slope};
}

double wave_number(const ErrorCurve& curve) {
    return curve.period_mm > 0.0 ? 2.0 * pi / curve.period_mm : 1.0;
}

}  // namespace

std::optional<ErrorName> parse_error_name(std::string_view text, const AxisNames& names) {
    if (text.size() < 3 || text[0] != 'E' || directions.find(text[1]) == std::string_view::npos)
        return std::nullopt;
    const bool location = text[2] == '0';
    const auto axis = names.find(text.substr(location ? 3 : 2));
    return axis ? std::optional(ErrorName{text[1], location, *axis}) : std::nullopt;
}

std::string to_string(const ErrorName& name, const AxisNames& names) {
    return std::string{'E', name.direction} + (name.location ? "0" : "") + names[name.axis];
}

std::string_view to_string(ErrorCurve::Interpolation interpolation) {
    switch (interpolation) {
        case ErrorCurve::Interpolation::linear: return "linear";
        case ErrorCurve::Interpolation::cubic: return "cubic";
        case ErrorCurve::Interpolation::none: return "none";
    }
    return "";
}

std::optional<ErrorCurve::Interpolation> parse_interpolation(std::string_view text) {
    using enum ErrorCurve::Interpolation;
    for (const ErrorCurve::Interpolation kind : {linear, cubic, none})
        if (text == to_string(kind)) return kind;
    return std::nullopt;
}

std::optional<SpindleErrorName> parse_spindle_error_name(std::string_view text) {
    const bool location = text.size() == 4 && text[2] == '0';
    if (text.size() != (location ? 4U : 3U) || text[0] != 'E' || text.back() != 'S')
        return std::nullopt;
    const std::size_t direction = directions.find(text[1]);
    if (direction >= 5) return std::nullopt;
    return SpindleErrorName{direction, location};
}

std::string to_string(const SpindleErrorName& name) {
    return std::string{'E', directions[name.direction]} + (name.location ? "0S" : "S");
}

bool ErrorCurve::is_zero() const {
    return constant == 0.0 && slope == 0.0 && harmonics.empty() && at.empty();
}

double ErrorCurve::operator()(double q, double commanded) const {
    double sum = constant + slope * q;
    if (!at.empty()) sum += table(*this, q, commanded).value;
    const double k = harmonics.empty() ? 0.0 : wave_number(*this);
    for (const Harmonic& h : harmonics)
        sum += h.cosine * std::cos(h.order * k * q) + h.sine * std::sin(h.order * k * q);
    return sum;
}

double ErrorCurve::derivative(double q) const {
    double sum = slope;
    if (!at.empty()) sum += table(*this, q, q).slope;
    const double k = harmonics.empty() ? 0.0 : wave_number(*this);
    for (const Harmonic& h : harmonics) {
        const double w = h.order * k;
        sum += w * (h.sine * std::cos(w * q) - h.cosine * std::sin(w * q));
    }
    return sum;
}

double& GeometricErrors::location(const ErrorName& name) {
    return axis[index_of(name.axis)].location[direction_index(name)];
}

double GeometricErrors::location(const ErrorName& name) const {
    return axis[index_of(name.axis)].location[direction_index(name)];
}

ErrorCurve& GeometricErrors::motion(const ErrorName& name) {
    return axis[index_of(name.axis)].motion[direction_index(name)];
}

}  // namespace trunnion::kinematics
