// Every effect against physics written down here: an own forward model of a BC table machine (plain
// sines and cosines, exact contact and bar length), an own law for each effect, no product code but
// the door that reads.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>
#include <set>

#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// What one reading looks like to physics: mm, rad, s.
struct Seen {
    const Reading* row = nullptr;
    Vector3 at = Vector3::Zero();  ///< X Y Z words
    double b = 0.0, c = 0.0;
    Vector3 travel = Vector3::Zero(), velocity = Vector3::Zero(), acceleration = Vector3::Zero();
    double travel_b = 0.0, travel_c = 0.0, velocity_b = 0.0, velocity_c = 0.0;
    double since_x = 1e9;  ///< way of X since it turned
    double path = 0.0;     ///< since the pass began
};

/// What may be wrong.
struct Wrong {
    Vector3 tip = Vector3::Zero();      ///< shift of the tip in M
    Vector3 tool = Vector3::Zero();     ///< small turn of the tool about the gauge point
    Vector3 carrier = Vector3::Zero();  ///< shift of the B axis (with all it carries), in M
    Vector3 carrier_tilt = Vector3::Zero();
    Vector3 plate = Vector3::Zero();  ///< shift of the C axis, in the frame that turns with B
    Vector3 plate_tilt = Vector3::Zero();
    Vector3 work = Vector3::Zero();  ///< shift of the artefact on the table
    double b = 0.0, c = 0.0, reading = 0.0;
};

/// A word b turns the work by -b about Y.
Vector3 about_y(const Vector3& v, double word) {
    const double c = std::cos(word), s = std::sin(word);
    return {c * v.x() - s * v.z(), v.y(), s * v.x() + c * v.z()};
}
/// A word c turns the work by -c about Z.
Vector3 about_z(const Vector3& v, double word) {
    const double c = std::cos(word), s = std::sin(word);
    return {c * v.x() + s * v.y(), -s * v.x() + c * v.y(), v.z()};
}

const Vector3 point_b(12, -8, 20), point_c(12, -8, 65), stylus(0, 0, -150), cup(0, 0, -120);
constexpr double bar_mm = 100.0, reach_mm = 0.5 * (25.4 + 6.0);

Vector3 artefact(const std::string& name) {
    return name == "S1"   ? Vector3(142, -8, 155)
           : name == "S2" ? Vector3(-48, 102, 205)
                          : Vector3(87, 2, 175);
}

Vector3 work_point(const Seen& s, const Wrong& w) {
    Vector3 v = artefact(s.row->feature) + w.work - point_c;
    v = about_z(v, s.c + w.c);
    v += w.plate_tilt.cross(v);
    v += point_c + w.plate - point_b;
    v = about_y(v, s.b + w.b);
    v += w.carrier_tilt.cross(v);
    return v + point_b + w.carrier;
}

double reading(const Seen& s, const Wrong& w) {
    const bool bar = s.row->device == Device::ballbar;
    const Vector3 arm = bar ? cup : stylus;
    const Vector3 tip = s.at + arm + w.tool.cross(arm) + w.tip;
    const Vector3 apart = work_point(s, w) - tip;
    if (bar) return apart.norm() - bar_mm + w.reading;
    const Vector3& d = s.row->direction_M;
    if (s.row->device == Device::sphere) return d.dot(apart) + w.reading;
    const double along = d.dot(apart);
    return along - std::sqrt(along * along - apart.squaredNorm() + reach_mm * reach_mm) + w.reading;
}

double sign(double v) {
    return v > 1e-9 ? 1.0 : v < -1e-9 ? -1.0 : 0.0;
}

/// A campaign of every device, and how each of its readings is seen.
struct Physics {
    Setup setup = campaign::bc_setup();
    ReadingTable table = campaign::empty_table(setup);
    std::vector<Seen> seen;

    Physics() {
        campaign::add_sphere_map(table, setup, 24, 5);
        add_touches();
        campaign::add_ballbar(table, setup, 180);
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            Reading& row = table.rows[i];
            row.load_kg = i % 2 ? 40.0 : 0.0;
            row.temperature_c = 20.0 + 0.02 * static_cast<double>(i % 200);
            row.clamped = i % 3 == 0;
            row.spindle_rad =
                row.device == Device::ballbar ? 0.0 : 0.7 * static_cast<double>(i % 5);
        }
        for (std::size_t i = 0; i < table.rows.size(); ++i) seen.push_back(look(i));
    }

    void add_touches() {
        double time_s = table.rows.back().time_s;
        const double angle = 0.6;
        for (int k = 0; k < 10; ++k) {
            Reading row;
            row.test = "touches";
            row.feature = "S1";
            row.mode = PositioningMode::rtcp;
            row.feed_mm_min = 60.0 + 30.0 * k;
            row.commanded[Axis::B] = 0.1 * k;
            row.commanded[Axis::C] = 0.5 * k;
            const Vector3 out(std::cos(angle * k) * 0.8, std::sin(angle * k) * 0.8, 0.6);
            for (const double distance : {reach_mm + 8.0, reach_mm - 1.5}) {
                campaign::aim(row, setup, artefact("S1"), stylus - distance * out);
                row.time_s = time_s += 3.0;
                row.device = distance > reach_mm ? Device::none : Device::touch;
                row.direction_M = -out;
                table.rows.push_back(row);
            }
        }
    }

    double word(std::size_t i, Axis axis) const { return table.rows[i].commanded[axis]; }

    /// Sign of the last move of an axis in the test, or of the first one to come.
    double approach(std::size_t i, Axis axis) const {
        const auto same = [&](std::size_t k) { return table.rows[k].test == table.rows[i].test; };
        for (std::size_t k = i; k > 0 && same(k - 1); --k)
            if (const double s = sign(word(k, axis) - word(k - 1, axis)); s != 0.0) return s;
        for (std::size_t k = i + 1; k < table.rows.size() && same(k); ++k)
            if (const double s = sign(word(k, axis) - word(k - 1, axis)); s != 0.0) return s;
        return 0.0;
    }

    Seen look(std::size_t i) const {
        Seen s;
        s.row = &table.rows[i];
        s.at = Vector3(word(i, Axis::X), word(i, Axis::Y), word(i, Axis::Z));
        s.b = word(i, Axis::B);
        s.c = word(i, Axis::C);
        if (s.row->device != Device::ballbar) {
            s.travel_b = approach(i, Axis::B);
            s.travel_c = approach(i, Axis::C);
            if (s.row->device == Device::touch)
                s.travel = {approach(i, Axis::X), approach(i, Axis::Y), approach(i, Axis::Z)};
            return s;
        }
        planar(i, s);
        return s;
    }

    /// Circle in the plane of axes p and p + 1 about the pivot, from angle 0, sense +-1.
    void planar(std::size_t i, Seen& s) const {
        if (s.row->test.rfind("plane", 0) != 0) return;
        const int p = s.row->test[5] - '0', q = (p + 1) % 3;
        const double sense = s.row->test.find("_ccw") != std::string::npos ? 1.0 : -1.0;
        const Vector3 bar = (s.at + cup - artefact("P1")) / bar_mm;
        const double speed = s.row->feed_mm_min / 60.0;
        double angle = sense * std::atan2(bar(q), bar(p));
        if (angle < -1e-9) angle += 2.0 * pi;
        std::size_t first = i;
        while (first > 0 && table.rows[first - 1].test == s.row->test) --first;
        if (i - first > 100 && angle < 1e-6) angle = 2.0 * pi;
        s.velocity(p) = -bar(q) * sense * speed;
        s.velocity(q) = bar(p) * sense * speed;
        s.acceleration = -bar * speed * speed / bar_mm;
        for (int d = 0; d < 3; ++d)
            s.travel(d) = std::abs(s.velocity(d)) > 0.03 * speed ? sign(s.velocity(d)) : 0;
        s.path = angle * bar_mm;
        // X turns where the bar lies along X; a pass that begins there begins with the turn.
        if (p != 0 && q != 0) return;
        const double phase = p == 0 ? angle : angle - 0.5 * pi;  // 0 at a turning point
        if (phase >= 0.0) s.since_x = bar_mm * (1.0 - std::cos(phase >= pi ? phase - pi : phase));
    }

    /// Largest difference between the product's change and the law's, over the largest change.
    double miss(const std::string& injection, const std::function<Wrong(const Seen&)>& law,
                const std::function<bool(const Seen&)>& where = {}) const {
        const ReadingTable off = predicted(setup, table, {});
        const Setup with = campaign::with_effect(setup, injection);
        const ReadingTable on = predicted(with, table, active_models(with));
        double worst = 0.0, largest = 0.0;
        std::string where_worst;
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            if (!off.rows[i].value_mm || (where && !where(seen[i]))) continue;
            const double change = *on.rows[i].value_mm - *off.rows[i].value_mm;
            const double expected = reading(seen[i], law(seen[i])) - reading(seen[i], {});
            if (std::abs(change - expected) > worst) {
                worst = std::abs(change - expected);
                where_worst = fmt::format("row {} of {}: changes by {} mm, expected {} mm", i,
                                          seen[i].row->test, change, expected);
            }
            largest = std::max(largest, std::abs(expected));
        }
        UNSCOPED_INFO(where_worst);
        REQUIRE(largest > 1e-4);  // a law that says nothing proves nothing
        return worst / largest;
    }
};

bool planar_circle(const Seen& s) {
    return s.row->test.rfind("plane", 0) == 0;
}
bool probing(const Seen& s) {
    return s.row->device != Device::ballbar;
}
/// Rows at a circle's ends and where an axis turns say little about speed.
bool moving(const Seen& s) {
    return planar_circle(s) && s.path > 12.0 && s.path < 2.0 * pi * bar_mm - 12.0;
}
bool away_from_turns(const Seen& s) {
    const auto near = [](double v, double travel) { return travel == 0.0 && std::abs(v) > 1e-9; };
    return moving(s) && !near(s.velocity.x(), s.travel.x()) &&
           !near(s.velocity.y(), s.travel.y()) && !near(s.velocity.z(), s.travel.z());
}

Wrong tip(const Vector3& shift) {
    Wrong w;
    w.tip = shift;
    return w;
}

}  // namespace

TEST_CASE("the own forward model and the emulator read the same without effects", "[effects]") {
    const Physics physics;
    const ReadingTable read = predicted(physics.setup, physics.table, {});
    for (std::size_t i = 0; i < read.rows.size(); ++i)
        if (read.rows[i].value_mm)
            REQUIRE(*read.rows[i].value_mm == Approx(reading(physics.seen[i], {})).margin(1e-9));
}

TEST_CASE("rotary axes: zero, positioning, ripple, backlash turn the work about the axis",
          "[effects]") {
    const Physics physics;
    const auto angle = [](char axis, const std::function<double(double q)>& law) {
        return [=](const Seen& s) {
            Wrong w;
            (axis == 'B' ? w.b : w.c) = law(axis == 'B' ? s.b : s.c);
            return w;
        };
    };
    for (const char axis : {'B', 'C'}) {
        const std::string name(1, axis);
        INFO(name);
        CHECK(physics.miss(name + ".zero=50urad", angle(axis, [](double) { return 50e-6; })) <
              1e-6);
        CHECK(physics.miss(name + ".positioning: cos1_rad=3e-5, sin2_rad=-2e-5",
                           angle(axis, [](double q) {
                               return 3e-5 * std::cos(q) - 2e-5 * std::sin(2.0 * q);
                           })) < 1e-6);
        CHECK(physics.miss(name + ".cyclic: cos_rad=2e-5, sin_rad=1e-5, periods_per_turn=72",
                           angle(axis, [](double q) {
                               return 2e-5 * std::cos(72 * q) + 1e-5 * std::sin(72 * q);
                           })) < 1e-6);
        CHECK(physics.miss(
                  name + ".backlash=12arcsec",
                  [&](const Seen& s) {
                      Wrong w;
                      const double half = 0.5 * 12.0 / 3600.0 * pi / 180.0;
                      w.b = axis == 'B' ? half * s.travel_b : 0.0;
                      w.c = axis == 'C' ? half * s.travel_c : 0.0;
                      return w;
                  },
                  probing) < 1e-6);
    }
    CHECK(physics.miss("B.positioning: slope_rad_per_rad=2e-5",
                       angle('B', [](double q) { return 2e-5 * q; })) < 1e-6);
}

TEST_CASE("rotary axes: radial, axial and tilt motion, and location errors", "[effects]") {
    const Physics physics;
    const auto wave = [](double q) { return 3e-3 * std::cos(2.0 * q) + 1e-3 * std::sin(q); };
    CHECK(physics.miss("B.radial: EXB_cos2_mm=0.003, EXB_sin1_mm=0.001, EZB_cos1_mm=0.002",
                       [&](const Seen& s) {
                           Wrong w;
                           w.carrier = {wave(s.b), 0.0, 2e-3 * std::cos(s.b)};
                           return w;
                       }) < 1e-6);
    CHECK(physics.miss("C.radial: EXC_cos2_mm=0.003, EXC_sin1_mm=0.001, EYC_cos1_mm=0.002",
                       [&](const Seen& s) {
                           Wrong w;
                           w.plate = {wave(s.c), 2e-3 * std::cos(s.c), 0.0};
                           return w;
                       }) < 1e-6);
    CHECK(physics.miss("B.axial: EYB_cos2_mm=0.003, EYB_sin1_mm=0.001", [&](const Seen& s) {
        Wrong w;
        w.carrier.y() = wave(s.b);
        return w;
    }) < 1e-6);
    CHECK(physics.miss("C.axial: EZC_cos2_mm=0.003, EZC_sin1_mm=0.001", [&](const Seen& s) {
        Wrong w;
        w.plate.z() = wave(s.c);
        return w;
    }) < 1e-6);
    CHECK(physics.miss("B.tilt: EAB_cos2_rad=3e-5, ECB_sin1_rad=2e-5", [](const Seen& s) {
        Wrong w;
        w.carrier_tilt = {3e-5 * std::cos(2.0 * s.b), 0.0, 2e-5 * std::sin(s.b)};
        return w;
    }) < 1e-4);
    CHECK(physics.miss("C.tilt: EAC_cos2_rad=3e-5, EBC_sin1_rad=2e-5", [](const Seen& s) {
        Wrong w;
        w.plate_tilt = {3e-5 * std::cos(2.0 * s.c), 2e-5 * std::sin(s.c), 0.0};
        return w;
    }) < 1e-4);
    CHECK(physics.miss("location: EX0B_mm=10um, EC0B_rad=20urad, EY0C_mm=-8um, EA0C_rad=30urad",
                       [](const Seen&) {
                           Wrong w;
                           w.carrier = {10e-3, 0.0, 0.0};
                           w.carrier_tilt = {0.0, 0.0, 20e-6};
                           w.plate = {0.0, -8e-3, 0.0};
                           w.plate_tilt = {30e-6, 0.0, 0.0};
                           return w;
                       }) < 1e-4);
}

TEST_CASE("linear axes: scale, straightness, angles, ripple, squareness move the tip",
          "[effects]") {
    const Physics physics;
    for (int d = 0; d < 3; ++d) {
        const std::string name(1, "XYZ"[d]);
        INFO(name);
        const Vector3 along = Vector3::Unit(d), side = Vector3::Unit((d + 1) % 3);
        const std::string lateral(1, "XYZ"[(d + 1) % 3]);
        CHECK(physics.miss(
                  name + ".scale: scale_ppm=20, bow2_mm=0.001, bow3_mm=0.0005", [&](const Seen& s) {
                      const double u = s.at(d) / 200.0;
                      return tip((20e-6 * s.at(d) + 1e-3 * u * u + 5e-4 * u * u * u) * along);
                  }) < 1e-6);
        CHECK(physics.miss(name + ".straightness: E" + lateral + name + "_p1_mm=0.004, E" +
                               lateral + name + "_p2_mm=0.005, E" + lateral + name + "_p4_mm=0.001",
                           [&](const Seen& s) {
                               const double u = s.at(d) / 200.0;
                               return tip((4e-3 * u + 5e-3 * u * u + 1e-3 * std::pow(u, 4)) * side);
                           }) < 1e-6);
        CHECK(physics.miss(name + ".angular: EA" + name + "_p1_rad=3e-5, EB" + name +
                               "_p2_rad=2e-5, EC" + name + "_p1_rad=1e-5",
                           [&](const Seen& s) {
                               const double u = s.at(d) / 200.0;
                               Wrong w;
                               w.tool = {3e-5 * u, 2e-5 * u * u, 1e-5 * u};
                               return w;
                           }) < 1e-4);
        CHECK(physics.miss(name + ".cyclic: cos_mm=2um, sin_mm=1um, period_mm=12",
                           [&](const Seen& s) {
                               const double a = 2.0 * pi * s.at(d) / 12.0;
                               return tip((2e-3 * std::cos(a) + 1e-3 * std::sin(a)) * along);
                           }) < 1e-6);
    }
    const double lean = 40e-6;
    CHECK(physics.miss("XY.squareness=40urad", [&](const Seen& s) {
        return tip({-lean * s.at.y(), 0.0, 0.0});  // Y turned about Z leans to -X
    }) < 1e-6);
    CHECK(physics.miss("YZ.squareness=40urad", [&](const Seen& s) {
        return tip({0.0, -lean * s.at.z(), 0.0});  // Z turned about X leans to -Y
    }) < 1e-6);
    CHECK(physics.miss("ZX.squareness=40urad", [&](const Seen& s) {
        return tip({lean * s.at.z(), 0.0, 0.0});  // Z turned about Y leans to +X
    }) < 1e-6);
}

TEST_CASE("drives: backlash, lateral play, reversal, lag", "[effects]") {
    const Physics physics;
    for (int d = 0; d < 3; ++d) {
        const std::string name(1, "XYZ"[d]);
        INFO(name);
        const Vector3 along = Vector3::Unit(d), side = Vector3::Unit((d + 1) % 3);
        const auto half = [&](const Seen& s) { return tip(3e-3 * s.travel(d) * along); };
        CHECK(physics.miss(name + ".backlash=6um", half, probing) < 1e-5);
        CHECK(physics.miss(name + ".backlash=6um", half, away_from_turns) < 1e-5);
        CHECK(physics.miss(
                  name + ".lateral_play: play_" + "xyz"[(d + 1) % 3] + std::string("_mm=4um"),
                  [&](const Seen& s) { return tip(2e-3 * s.travel(d) * side); },
                  away_from_turns) < 1e-5);
    }
    CHECK(physics.miss(
              "X.reversal_spike: height_mm=6um, decay_mm=3, law=1",
              [](const Seen& s) {
                  const double h = s.since_x > 1e6 ? 0.0 : 6e-3 * std::exp(-s.since_x / 3.0);
                  return tip({-h * s.travel.x(), 0.0, 0.0});
              },
              [](const Seen& s) {
                  return away_from_turns(s) && s.row->test.rfind("plane0", 0) == 0;
              }) < 0.02);
    CHECK(physics.miss(
              "servo.mismatch: tau_x_s=0.5ms, tau_y_s=-0.2ms, tau_z_s=0.1ms",
              [](const Seen& s) {
                  return tip(-Vector3(0.5e-3, -0.2e-3, 0.1e-3).cwiseProduct(s.velocity));
              },
              moving) < 1e-3);
    CHECK(physics.miss(
              "servo.contour: lag2_s2=1e-4",
              [](const Seen& s) { return tip(1e-4 * s.acceleration); }, moving) < 2e-3);
    CHECK(physics.miss(
              "control.chord: fraction=1, block_mm=20",
              [](const Seen& s) {
                  const double on = std::fmod(s.path, 20.0);
                  const Vector3 in = s.acceleration.normalized();
                  return tip(on * (20.0 - on) / (2.0 * bar_mm) * in);
              },
              moving) < 0.02);
}

TEST_CASE("time, temperature, load, clamps", "[effects]") {
    const Physics physics;
    CHECK(physics.miss("thermal.drift: d_mm=[0.01, -0.005, 0.02], tau_s=600", [](const Seen& s) {
        return tip((1.0 - std::exp(-s.row->time_s / 600.0)) * Vector3(0.01, -0.005, 0.02));
    }) < 1e-6);
    CHECK(physics.miss("thermal.expansion: growth_x_per_k=8e-6, growth_z_per_k=-5e-6",
                       [](const Seen& s) {
                           const double k = s.row->temperature_c - 20.0;
                           return tip(k * Vector3(8e-6 * s.at.x(), 0.0, -5e-6 * s.at.z()));
                       }) < 1e-6);
    CHECK(physics.miss("gravity.sag: twist_rad=30urad, sag_mm=4um", [](const Seen& s) {
        const double weight = 1.0 + s.row->load_kg / 100.0;
        Wrong w;
        w.b = 30e-6 * weight * std::sin(s.b);
        w.carrier.z() = -4e-3 * (weight * std::cos(s.b) * std::cos(s.b) - 1.0);
        return w;
    }) < 1e-3);
    CHECK(physics.miss("clamp.shift: shift_b_mm=[0.004, 0, -0.003], turn_c_rad=20urad",
                       [](const Seen& s) {
                           Wrong w;
                           if (s.row->clamped) w.carrier = {0.004, 0.0, -0.003}, w.c = 20e-6;
                           return w;
                       }) < 1e-3);
}

TEST_CASE("probe, bar and artefacts", "[effects]") {
    Physics physics;
    const auto touching = [](const Seen& s) { return s.row->device == Device::touch; };
    CHECK(physics.miss(
              "probe.radius: radius_mm=3um, delay_s=2ms",
              [](const Seen& s) {
                  Wrong w;
                  w.reading = -3e-3 + 2e-3 * s.row->feed_mm_min / 60.0;
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss(
              "probe.pretravel: cos3_mm=3um, sin2_mm=1um",
              [](const Seen& s) {
                  const Vector3& d = s.row->direction_M;
                  const double phi = std::atan2(d.y(), d.x()) - s.row->spindle_rad;
                  Wrong w;
                  w.reading = std::hypot(d.x(), d.y()) *
                              (3e-3 * std::cos(3 * phi) + 1e-3 * std::sin(2 * phi));
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss(
              "probe.runout: dx_mm=5um, dy_mm=-3um",
              [](const Seen& s) {
                  const double c = std::cos(s.row->spindle_rad);
                  const double n = std::sin(s.row->spindle_rad);
                  return tip({5e-3 * c + 3e-3 * n, 5e-3 * n - 3e-3 * c, 0.0});
              },
              probing) < 1e-6);
    CHECK(physics.miss(
              "tool.length=15um",
              [](const Seen&) {
                  return tip({0, 0, -15e-3});
              },
              probing) < 1e-6);
    CHECK(physics.miss(
              "ballbar.length=3um",
              [](const Seen&) {
                  Wrong w;
                  w.reading = 3e-3;
                  return w;
              },
              [](const Seen& s) { return s.row->device == Device::ballbar; }) < 1e-6);
    CHECK(physics.miss(
              "artefact.form: q1_mm=1um, q3_mm=0.5um, artefact=0",
              [](const Seen& s) {
                  // Outward normal where the stylus comes from, seen from the table.
                  const Vector3 n = about_z(about_y(-s.row->direction_M, -s.b), -s.c);
                  Wrong w;
                  w.reading =
                      -(1e-3 * (n.x() * n.x() - n.y() * n.y()) + 0.5e-3 * 2.0 * n.x() * n.z());
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss("artefact.moved: shift_mm=[0.01, 0, -0.005], artefact=1, time_s=250",
                       [](const Seen& s) {
                           Wrong w;
                           if (s.row->feature == "S2" && s.row->time_s >= 250.0)
                               w.work = {0.01, 0.0, -0.005};
                           return w;
                       }) < 1e-6);
    physics.setup.artefacts[1].free_center = false;
    CHECK(physics.miss("artefact.position: shift_S2_mm=[0.02, 0.01, 0]", [](const Seen& s) {
        Wrong w;
        if (s.row->feature == "S2") w.work = {0.02, 0.01, 0.0};
        return w;
    }) < 1e-6);
}

TEST_CASE("belief: wrong stores and rounded words", "[effects]") {
    const Physics physics;
    const auto turned = [](const Seen& s, const Vector3& v) {
        return about_y(about_z(v, s.c), s.b);
    };
    CHECK(physics.miss("pivot.g54: dg_mm=[10um, -20um, 30um]", [&](const Seen& s) {
        const Vector3 dg(0.01, -0.02, 0.03);
        const bool uses =
            s.row->mode == PositioningMode::dpp || s.row->mode == PositioningMode::rtdfo;
        return tip(uses ? Vector3(dg - turned(s, dg)) : Vector3(Vector3::Zero()));
    }) < 1e-6);
    CHECK(physics.miss(
              "pivot.p1970x: dp_mm=[10um, 20um, -10um], dd_mm=[20um, 0, 10um]", [&](const Seen& s) {
                  const Vector3 dp(0.01, 0.02, -0.01), dd(0.02, 0.0, 0.01), sum = dp + dd;
                  const bool uses =
                      s.row->mode == PositioningMode::rtcp || s.row->mode == PositioningMode::tw;
                  const Vector3 e = turned(s, sum) - sum - (about_y(dd, s.b) - dd);
                  return tip(uses ? Vector3(-e) : Vector3(Vector3::Zero()));
              }) < 1e-6);
    CHECK(physics.miss(
              "control.rounding: fraction=1, increment_deg=0.01, increment_mm=0.01",
              [](const Seen& s) {
                  const auto off = [](double v, double step) {
                      return std::round(v / step) * step - v;
                  };
                  const double degree = pi / 180.0;
                  Wrong w = tip({off(s.at.x(), 0.01), off(s.at.y(), 0.01), off(s.at.z(), 0.01)});
                  w.b = off(s.b, 0.01 * degree);
                  w.c = off(s.c, 0.01 * degree);
                  return w;
              }) < 1e-4);
}

TEST_CASE("twice the parameter is twice the change, for every parameter of the catalogue",
          "[effects]") {
    const Physics physics;
    const Catalogue catalogue = make_catalogue(physics.setup);
    const Replay replay(physics.setup, physics.table);
    const std::vector<double> off = replay.predict({});
    for (const Effect& effect : catalogue)
        for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
            if (effect.parameters[j].is_key()) continue;
            INFO(effect.name << ' ' << effect.parameters[j].name);
            std::vector<double> values = effect.zeros();
            CHECK(replay.predict({make_model(effect, values)}) == off);  // off is off
            values[j] = effect.parameters[j].typical;
            const auto once = replay.predict({make_model(effect, values)});
            values[j] *= 2.0;
            const auto twice = replay.predict({make_model(effect, values)});
            double worst = 0.0, largest = 0.0;
            for (std::size_t i = 0; i < off.size(); ++i) {
                worst = std::max(worst, std::abs(twice[i] - off[i] - 2.0 * (once[i] - off[i])));
                largest = std::max(largest, std::abs(twice[i] - off[i]));
            }
            CHECK(worst <= 2e-3 * largest);
        }
}

TEST_CASE("time constants, pitches and decays at their limits", "[effects]") {
    const Physics physics;
    const auto drift = [&](double tau_s) {
        return physics.miss(
            "thermal.drift: d_mm=[0, 0, 0.02], tau_s=" + std::to_string(tau_s),
            [](const Seen&) {
                return tip({0, 0, 0.02});
            },
            [](const Seen& s) { return s.row->time_s > 100.0; });
    };
    CHECK(drift(1.0) < 1e-6);  // long over: the whole shift
    CHECK(drift(1e9) > 0.99);  // not begun: nothing
    // A ripple whose pitch is the distance between two positions is the same at both.
    const Effect ripple = linear_cyclic(*physics.setup.machine.chain.find(Axis::X));
    const auto shift = [&](const Effect& effect, const std::vector<double>& values, Axis axis,
                           double q) {
        AxisSample sample;
        sample.position[axis] = q;
        Perturbation out;
        effect.add(sample, {}, values, out);
        return out.axis[axis];
    };
    CHECK(shift(ripple, {2e-3, 1e-3, 12.0}, Axis::X, 5.0) ==
          Approx(shift(ripple, {2e-3, 1e-3, 12.0}, Axis::X, 5.0 - 24.0)));
    const Effect teeth = rotary_cyclic(*physics.setup.machine.chain.find(Axis::C));
    CHECK(shift(teeth, {2e-5, 1e-5, 90.0}, Axis::C, 0.1) ==
          Approx(shift(teeth, {2e-5, 1e-5, 90.0}, Axis::C, 0.1 + 2.0 * pi / 90.0)));
    // A spike has lost all but 1/e of its height one decay length after the turn.
    const Effect spike = linear_reversal_spike(*physics.setup.machine.chain.find(Axis::Y));
    const auto after = [&](double way_mm, double run_up = 1.0, bool unknown = false) {
        AxisSample sample;
        sample.run_up_unknown[index_of(Axis::Y)] = unknown;
        sample.travel[index_of(Axis::Y)] = 1;
        sample.since_reversal[index_of(Axis::Y)] = way_mm;
        Contact contact;
        contact.device = Device::ballbar;
        Perturbation out;
        spike.add(sample, contact, std::vector<double>{0.006, 2.0, 1.0, run_up}, out);
        return out.axis[Axis::Y];
    };
    CHECK(after(0.0) == Approx(-0.006));
    CHECK(after(2.0) == Approx(-0.006 * std::exp(-1.0)));
    CHECK(after(no_reversal_seen * 2.0) == 0.0);
    // A circle begun at the quadrant: reached through it (a run-up arc), or not.
    CHECK(after(2.0, 1.0, true) == after(2.0));
    CHECK(after(2.0, 0.0, true) == 0.0);
    CHECK(after(2.0, 0.0, false) == after(2.0));
    // With the angle since the quadrant, on a circle of any size: 0.02 rad is 2 mm on 100 mm.
    for (const double angle : {0.01, 0.02, 0.5, 2.0, 3.0})
        for (const double speed : {3.0, 50.0}) {
            AxisSample sample;
            sample.travel[index_of(Axis::Y)] = -1;
            sample.velocity[Axis::X] = speed * std::cos(angle);
            sample.velocity[Axis::Y] = -speed * std::sin(angle);
            Contact contact;
            contact.device = Device::ballbar;
            contact.acceleration[Axis::Y] = -std::cos(angle);
            Perturbation out;
            spike.add(sample, contact, std::vector<double>{0.006, 2.0, 0.0, 1.0}, out);
            CHECK(out.axis[Axis::Y] == Approx(0.006 * std::exp(-angle / 0.02)).margin(1e-15));
        }
    // Rounding never moves an axis by more than half the increment.
    const Effect rounding = control_rounding(physics.setup.machine.chain);
    for (double q = -1.0; q < 1.0; q += 0.0137)
        CHECK(std::abs(shift(rounding, {1.0, 0.0, 0.02}, Axis::X, q)) <= 0.01 + 1e-12);
}

}  // namespace trunnion
