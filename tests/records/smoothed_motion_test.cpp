// The commanded motion behind the time constant of a drive, beside closed forms.
#include "records/smoothed_motion.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "base/units.h"
#include "records/samples.h"

namespace trunnion {
namespace {

/// Rows of X at these times.
template <typename PositionAt>
std::vector<records::Reading> rows_at(const std::vector<double>& times_s, const PositionAt& at) {
    std::vector<records::Reading> rows;
    for (const double t : times_s) {
        records::Reading row;
        row.time_s = t;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "X";
        row.commanded[Axis::X] = at(t);
        rows.push_back(row);
    }
    return rows;
}

std::vector<Vector3> smoothed(const std::vector<records::Reading>& rows, double seconds) {
    std::vector<std::size_t> pass(rows.size());
    for (std::size_t k = 0; k < pass.size(); ++k) pass[k] = k;
    return records::smoothed_motion(records::commanded_path(rows, pass, Axis::X, {}), seconds);
}

std::vector<double> times(std::size_t count, double step_s, double wobble) {
    std::vector<double> list;
    for (std::size_t k = 0; k < count; ++k) {
        const auto step = static_cast<double>(k);
        list.push_back(step_s * (step + wobble * std::sin(2.4 * step)));
    }
    list.front() = 0.0;
    return list;
}

}  // namespace

TEST_CASE("a drive that starts from rest follows an even acceleration by the closed form",
          "[records]") {
    constexpr double acceleration = 800.0;
    const double seconds = GENERATE(0.002, 0.01, 0.05);
    const std::vector<double> list = times(60, 0.01, 0.3);
    const auto rows = rows_at(list, [](double t) { return 0.5 * acceleration * t * t; });
    const auto motion = smoothed(rows, seconds);
    REQUIRE(motion.size() == list.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
        INFO(seconds << " s, row " << k);
        const double u = list[k] / seconds, fade = std::exp(-u);
        // Its lag T, T^2 and T^3 is that of the closed form, T times the velocity behind T.
        const Vector3& m = motion[k];
        const double lag = seconds * (m(0) - seconds * m(1) + seconds * seconds * m(2));
        CHECK(lag ==
              Approx(seconds * acceleration * (list[k] - seconds * (1.0 - fade))).margin(1e-9));
        CHECK(m(1) - 2.0 * seconds * m(2) ==
              Approx(acceleration * (1.0 - fade * (1.0 + u))).margin(1e-9));
        CHECK(m(2) == Approx(acceleration * fade * u * u / 2.0 / seconds).margin(1e-6));
    }
}

TEST_CASE("a motion that went on before the log has its steady response from the first row on",
          "[records]") {
    constexpr double w = 4.0, size_mm = 30.0, seconds = 0.02, phase = 0.8;
    const std::vector<double> list = times(300, 0.005, 0.2);
    const auto rows = rows_at(list, [&](double t) { return size_mm * std::sin(w * t + phase); });
    const auto motion = smoothed(rows, seconds);
    const std::complex<double> s(0.0, w), once = s / (1.0 + s * seconds);
    for (std::size_t k = 0; k < list.size(); ++k) {
        INFO("row " << k);
        const std::complex<double> turn = std::polar(size_mm, w * list[k] + phase);
        // Slow motion: its own derivatives, up to the fourth order.
        CHECK(motion[k](0) == Approx((s * turn).imag()).margin(0.2));
        CHECK(motion[k](1) == Approx((s * s * turn).imag()).margin(10.0));
        // Differences of the first rows tell a jerk less well: T^3 of this is 3 nm.
        const double margin = list[k] < 5.0 * seconds ? 400.0 : 50.0;
        CHECK(motion[k](2) == Approx((once * once * once * turn).imag()).margin(margin));
    }
}

TEST_CASE("told speeds stand in for differences of positions", "[records]") {
    // Two rows, half a turn apart: only their speeds tell the curve between them.
    auto rows = rows_at({0.0, 0.1, 0.2}, [](double) { return 0.0; });
    for (records::Reading& row : rows) row.velocity_mm_s = 50.0;
    const auto motion = smoothed(rows, 0.001);
    CHECK(motion[2](0) == Approx(50.0).epsilon(0.1));
}

TEST_CASE(
    "without a time constant samples have no smoothed motion, at the ends of a log speeds are "
    "one-sided",
    "[records]") {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.rows = rows_at({0.0, 0.1, 0.2, 0.3, 0.4, 0.5}, [](double t) { return 40.0 * t * t; });
    for (const AxisSample& sample : records::samples_of(table)) {
        CHECK(sample.smooth_velocity[Axis::X] == 0.0);
        CHECK(sample.smooth_jerk[Axis::X] == 0.0);
    }
    TimeConstants constants{};
    constants[index_of(Axis::X)] = 0.05;
    const auto samples = records::samples_of(table, constants);
    CHECK(samples[0].velocity[Axis::X] == Approx(4.0));
    CHECK(samples[5].velocity[Axis::X] == Approx(36.0));
    const double behind = samples[5].velocity[Axis::X] + samples[5].smooth_velocity[Axis::X];
    CHECK(behind == Approx(40.0).epsilon(0.01));
}

TEST_CASE("the motion of servo logs is that of their samples", "[records]") {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::Y};
    const std::vector<double> list = times(40, 0.01, 0.3);
    for (const char* session : {"one", "two"})
        for (const char* test : {"a", "b"})
            for (const double t : list)
                for (const Axis axis : {Axis::X, Axis::Y}) {
                    records::Reading row;
                    row.session = session;
                    row.test = test;
                    row.time_s = t;
                    row.device = records::Device::axis;
                    row.feature = axis == Axis::X ? "X" : "Y";
                    row.commanded[Axis::X] = 30.0 * std::sin(20.0 * t);
                    row.commanded[Axis::Y] = 50.0 * t * t;
                    if (t == list[5]) row.velocity_mm_s = 7.0;
                    table.rows.push_back(row);
                }
    table.rows[9].device = records::Device::none;
    TimeConstants constants{};
    constants[1] = 0.004;  // of Y
    const std::vector<AxisSample> samples = records::samples_of(table, constants);
    const std::vector<records::LoggedMotion> motion = records::logged_motion(table, constants);
    REQUIRE(motion.size() == table.rows.size());
    for (std::size_t k = 0; k < motion.size(); ++k) {
        INFO("row " << k);
        CHECK(motion[k].motion.has_value() == (table.rows[k].device == records::Device::axis));
        if (!motion[k].motion) continue;
        const Axis axis = table.rows[k].feature == "X" ? Axis::X : Axis::Y;
        const AxisSample& s = samples[k];
        const Vector3 own(s.velocity[axis], s.acceleration[axis], s.jerk[axis]);
        const Vector3 more(s.smooth_velocity[axis], s.smooth_acceleration[axis],
                           s.smooth_jerk[axis]);
        CHECK(*motion[k].motion == own);
        CHECK(motion[k].smoothed.has_value() == (axis == Axis::Y));
        if (motion[k].smoothed)
            CHECK((*motion[k].smoothed - own - more).norm() <= 1e-12 * (1.0 + own.norm()));
    }
}

}  // namespace trunnion
