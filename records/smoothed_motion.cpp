#include "records/smoothed_motion.h"

#include <array>
#include <cmath>

namespace trunnion::records {
namespace {

/// A signal in one stretch between rows, t from its begin: a parabola, and a parabola times
/// exp(-t / T).
struct Signal {
    std::array<double, 3> power{}, fading{};

    double at(double t, double time_constant_s) const {
        return power[0] + t * (power[1] + t * power[2]) +
               std::exp(-t / time_constant_s) * (fading[0] + t * (fading[1] + t * fading[2]));
    }
};

/// The input behind a low-pass of first order that starts at `start`: y' = (input - y) / T. Its
/// input fades at most linearly.
Signal low_passed(const Signal& input, double start, double time_constant_s) {
    const double T = time_constant_s;
    const auto& [p, f] = input;
    Signal out;
    out.power = {p[0] - T * p[1] + 2.0 * T * T * p[2], p[1] - 2.0 * T * p[2], p[2]};
    out.fading = {start - out.power[0], f[0] / T, f[1] / (2.0 * T)};
    return out;
}

/// (a - b) / T
Signal difference(const Signal& a, const Signal& b, double time_constant_s) {
    Signal out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.power[k] = (a.power[k] - b.power[k]) / time_constant_s;
        out.fading[k] = (a.fading[k] - b.fading[k]) / time_constant_s;
    }
    return out;
}

/// Velocity of the cubic from row k to the next one.
Signal velocity_after(const CommandedPath& path, std::size_t k) {
    const double h = path.time_s[k + 1] - path.time_s[k];
    const double slope = (path.position[k + 1] - path.position[k]) / h;
    const double v = path.velocity[k], w = path.velocity[k + 1];
    Signal velocity;
    velocity.power = {v, (6.0 * slope - 4.0 * v - 2.0 * w) / h,
                      3.0 * (v + w - 2.0 * slope) / (h * h)};
    return velocity;
}

/// Velocity at time k of the parabola through it and its neighbours; at the ends of the path it
/// goes on to the end.
double velocity_at(const CommandedPath& path, std::size_t k) {
    const std::size_t n = path.time_s.size(), mid = k == 0 ? 1 : k + 1 == n ? n - 2 : k;
    const auto slope = [&](std::size_t i) {
        return (path.position[i + 1] - path.position[i]) / (path.time_s[i + 1] - path.time_s[i]);
    };
    if (n < 3) return slope(0);
    const double before = slope(mid - 1), after = slope(mid);
    const double half_s = 0.5 * (path.time_s[mid + 1] - path.time_s[mid - 1]);
    const double middle_s = 0.5 * (path.time_s[mid] + path.time_s[mid - 1]);
    return before + (after - before) * (path.time_s[k] - middle_s) / half_s;
}

bool tells_velocity(const Reading& row, Axis axis, const AxisNames& names) {
    return row.device == Device::axis && row.velocity_mm_s && names.find(row.feature) == axis;
}

/// s F + T s^2 F^2 + T^2 s^3 F^3, s^2 F^2 + 2 T s^3 F^3 and s^3 F^3 with F = 1 / (1 + s T): they
/// differ from s, s^2 and s^3 by the fourth order only.
Vector3 as_series(double once, double twice, double thrice, double time_constant_s) {
    const double T = time_constant_s;
    return {once + T * twice + T * T * thrice, twice + 2.0 * T * thrice, thrice};
}

/// Velocity, acceleration and jerk at the first row with which the motion went on before it, from
/// rows half a time constant apart, so that their rounding is small; 0 where the axis starts from
/// rest: it moves no faster than its acceleration makes it within a row and a half. Their cubic
/// counts where it has the speed of the first rows; else there is the corner of a move among them.
Vector3 first_motion(const CommandedPath& path, double time_constant_s) {
    constexpr double within_rows = 1.5, smooth = 0.02;
    const std::size_t n = path.time_s.size();
    if (n < 4) return {path.velocity.front(), 0.0, 0.0};
    std::size_t step = 1;
    while (3 * (step + 1) < n && path.time_s[step + 1] - path.time_s[0] <= 0.5 * time_constant_s)
        ++step;
    std::array<double, 4> t{};
    std::array<double, 3> slope{};
    for (std::size_t k = 0; k < 4; ++k) t[k] = path.time_s[k * step] - path.time_s[0];
    for (std::size_t k = 0; k < 3; ++k)
        slope[k] = (path.position[(k + 1) * step] - path.position[k * step]) / (t[k + 1] - t[k]);
    // Newton's form of the cubic through the four, differentiated at its first point.
    const double second = (slope[1] - slope[0]) / t[2];
    const double third = ((slope[2] - slope[1]) / (t[3] - t[1]) - second) / t[3];
    const Vector3 cubic(slope[0] - second * t[1] + third * t[1] * t[2],
                        2.0 * second - 2.0 * third * (t[1] + t[2]), 6.0 * third);
    if (path.goes_on) return cubic;
    const double row_s = path.time_s[1] - path.time_s[0];
    const double velocity = path.velocity.front(), acceleration = 2.0 * second;
    if (std::abs(velocity) <= within_rows * row_s * std::abs(acceleration)) return Vector3::Zero();
    if (std::abs(cubic(0) - velocity) < smooth * std::abs(velocity)) return cubic;
    return {velocity, acceleration, 0.0};
}

}  // namespace

CommandedPath commanded_path(std::span<const Reading> rows, const std::vector<std::size_t>& pass,
                             Axis axis, const AxisNames& names) {
    CommandedPath path;
    std::vector<std::optional<double>> told;
    for (const std::size_t i : pass) {
        if (path.time_s.empty() || rows[i].time_s > path.time_s.back()) {
            path.time_s.push_back(rows[i].time_s);
            path.position.push_back(rows[i].commanded[axis]);
            told.emplace_back();
        }
        if (tells_velocity(rows[i], axis, names)) told.back() = rows[i].velocity_mm_s;
        path.at.push_back(path.time_s.size() - 1);
        path.goes_on = path.goes_on || rows[i].device == Device::ballbar;
    }
    for (std::size_t k = 0; k < told.size(); ++k)
        path.velocity.push_back(told[k] ? *told[k] : told.size() > 1 ? velocity_at(path, k) : 0.0);
    return path;
}

std::vector<Vector3> smoothed_motion(const CommandedPath& path, double time_constant_s) {
    const double T = time_constant_s;
    std::vector<Vector3> list;
    if (path.time_s.empty()) return list;
    // What the three low-passes hold: velocity once, acceleration twice and three times smoothed.
    const Vector3 first = first_motion(path, T);
    double velocity = first(0) - T * first(1) + T * T * first(2);
    double acceleration = first(1) - 2.0 * T * first(2), again = first(1) - 3.0 * T * first(2);
    list.push_back(as_series(velocity, acceleration, (acceleration - again) / T, T));
    for (std::size_t k = 0; k + 1 < path.time_s.size(); ++k) {
        const double h = path.time_s[k + 1] - path.time_s[k];
        const Signal input = velocity_after(path, k), v = low_passed(input, velocity, T);
        const Signal a2 = low_passed(difference(input, v, T), acceleration, T);
        const Signal a3 = low_passed(a2, again, T);
        velocity = v.at(h, T);
        acceleration = a2.at(h, T);
        again = a3.at(h, T);
        list.push_back(as_series(velocity, acceleration, (acceleration - again) / T, T));
    }
    return list;
}

}  // namespace trunnion::records
