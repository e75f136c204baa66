// Physics written down a second time: an own forward model of a BC table machine (plain sines and
// cosines, exact contact and bar length), against which every effect is held with a law of its own.
// No product code but the door that reads.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>

#include "tests/support/campaign.h"

namespace trunnion {

/// What one reading looks like to physics: mm, rad, s.
struct Seen {
    const records::Reading* row = nullptr;
    Vector3 at = Vector3::Zero();  ///< X Y Z: the words; of a touch, where the axes are
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
inline Vector3 about_y(const Vector3& v, double word) {
    const double c = std::cos(word), s = std::sin(word);
    return {c * v.x() - s * v.z(), v.y(), s * v.x() + c * v.z()};
}
/// A word c turns the work by -c about Z.
inline Vector3 about_z(const Vector3& v, double word) {
    const double c = std::cos(word), s = std::sin(word);
    return {c * v.x() + s * v.y(), -s * v.x() + c * v.y(), v.z()};
}

inline const Vector3 point_b(12, -8, 20), point_c(12, -8, 65), stylus(0, 0, -150), cup(0, 0, -120);
constexpr double bar_mm = 100.0, touching_mm = 0.5 * (25.4 + 6.0);

inline Vector3 artefact(const std::string& name) {
    return name == "S1"   ? Vector3(142, -8, 155)
           : name == "S2" ? Vector3(-48, 102, 205)
                          : Vector3(87, 2, 175);
}

inline Vector3 work_point(const Seen& s, const Wrong& w) {
    Vector3 v = artefact(s.row->feature) + w.work - point_c;
    v = about_z(v, s.c + w.c);
    v += w.plate_tilt.cross(v);
    v += point_c + w.plate - point_b;
    v = about_y(v, s.b + w.b);
    v += w.carrier_tilt.cross(v);
    return v + point_b + w.carrier;
}

/// Law of what is wrong at one reading.
using Law = std::function<Wrong(const Seen&)>;

inline Wrong nothing_wrong(const Seen&) {
    return {};
}

/// From the stylus ball or the cup to the artefact.
inline Vector3 apart(const Seen& s, const Wrong& w) {
    const Vector3 arm = s.row->device == records::Device::ballbar ? cup : stylus;
    return work_point(s, w) - (s.at + arm + w.tool.cross(arm) + w.tip);
}

/// Way from the commanded end to where the balls are in contact: the axes really go there, and the
/// law is that of the place where they are. Halves the way until doubles end.
inline double contact_way_mm(const Seen& s, const Law& law) {
    double free = -6.0, pressed = 6.0;
    const auto touches = [&](double way_mm) {
        Seen there = s;
        there.at += way_mm * s.row->direction_M;
        return apart(there, law(there)).norm() <= touching_mm;
    };
    REQUIRE((!touches(free) && touches(pressed)));
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (free + pressed);
        (touches(middle) ? pressed : free) = middle;
    }
    return pressed;
}

inline double reading(const Seen& s, const Law& law) {
    const Vector3& d = s.row->direction_M;
    if (s.row->device == records::Device::touch) {
        const double way_mm = contact_way_mm(s, law);
        Seen there = s;
        there.at += way_mm * d;
        return way_mm + law(there).reading;
    }
    const Wrong w = law(s);
    const bool bar = s.row->device == records::Device::ballbar;
    return (bar ? apart(s, w).norm() - bar_mm : d.dot(apart(s, w))) + w.reading;
}

inline double sign(double v) {
    return v > 1e-9 ? 1.0 : v < -1e-9 ? -1.0 : 0.0;
}

/// A campaign of every device, and how each of its readings is seen.
struct Physics {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    std::vector<Seen> seen;

    Physics() {
        campaign::add_sphere_map(table, setup, 24, 5);
        add_touches();
        campaign::add_ballbar(table, setup, 180);
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            records::Reading& row = table.rows[i];
            row.load_kg = i % 2 ? 40.0 : 0.0;
            row.temperature_c = 20.0 + 0.02 * static_cast<double>(i % 200);
            row.clamped = i % 3 == 0;
            row.spindle_rad =
                row.device == records::Device::ballbar ? 0.0 : 0.7 * static_cast<double>(i % 5);
        }
        for (std::size_t i = 0; i < table.rows.size(); ++i) seen.push_back(look(i));
    }

    /// Off home, so that no contact falls on a whole increment: there a control that rounds stands
    /// on an edge.
    void add_touches() {
        double time_s = table.rows.back().time_s;
        const double angle = 0.6;
        for (int k = 0; k < 10; ++k) {
            records::Reading row;
            row.test = "touches";
            row.feature = "S1";
            row.mode = PositioningMode::rtcp;
            row.feed_mm_min = 60.0 + 30.0 * k;
            row.commanded[Axis::B] = 0.05 + 0.1 * k;
            row.commanded[Axis::C] = 0.5 * k;
            const double turn = 0.3 + angle * k;
            const Vector3 out(std::cos(turn) * 0.8, std::sin(turn) * 0.8, 0.6);
            for (const double distance : {touching_mm + 8.0, touching_mm - 1.5}) {
                campaign::aim(row, setup, artefact("S1"), stylus - distance * out);
                row.time_s = time_s += 3.0;
                row.device =
                    distance > touching_mm ? records::Device::none : records::Device::touch;
                row.direction_M = -out;
                table.rows.push_back(row);
            }
        }
    }

    double word(std::size_t i, Axis axis) const { return table.rows[i].commanded[axis]; }

    /// Sign of the last move of an axis; + before its first one.
    double approach(std::size_t i, Axis axis) const {
        for (std::size_t k = i; k > 0; --k)
            if (const double s = sign(word(k, axis) - word(k - 1, axis)); s != 0.0) return s;
        return 1.0;
    }

    Seen look(std::size_t i) const {
        Seen s;
        s.row = &table.rows[i];
        s.at = Vector3(word(i, Axis::X), word(i, Axis::Y), word(i, Axis::Z));
        s.b = word(i, Axis::B);
        s.c = word(i, Axis::C);
        s.travel_b = approach(i, Axis::B);
        s.travel_c = approach(i, Axis::C);
        if (s.row->device != records::Device::sphere)
            s.travel = {approach(i, Axis::X), approach(i, Axis::Y), approach(i, Axis::Z)};
        if (s.row->device == records::Device::ballbar) planar(i, s);
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
        for (const int d : {p, q})  // the third axis stands and keeps its side
            s.travel(d) = std::abs(s.velocity(d)) > 0.03 * speed ? sign(s.velocity(d)) : 0;
        s.path = angle * bar_mm;
        // X turns where the bar lies along X; a pass that begins there begins with the turn.
        if (p != 0 && q != 0) return;
        const double phase = p == 0 ? angle : angle - 0.5 * pi;  // 0 at a turning point
        if (phase >= 0.0) s.since_x = bar_mm * (1.0 - std::cos(phase >= pi ? phase - pi : phase));
    }

    /// Largest difference between the product's change and the law's, over the largest change.
    double miss(const std::string& injection, const Law& law,
                const std::function<bool(const Seen&)>& where = {}) const {
        const records::ReadingTable off = emulator::predicted(setup, table, {});
        const setup::Setup with = campaign::with_effect(setup, injection);
        const records::ReadingTable on =
            emulator::predicted(with, table, effects::active_models(with));
        double worst = 0.0, largest = 0.0;
        std::string where_worst;
        for (std::size_t i = 0; i < table.rows.size(); ++i) {
            if (!off.rows[i].value_mm || (where && !where(seen[i]))) continue;
            const double change = *on.rows[i].value_mm - *off.rows[i].value_mm;
            const double expected = reading(seen[i], law) - reading(seen[i], nothing_wrong);
            if (std::abs(change - expected) > worst) {
                worst = std::abs(change - expected);
                where_worst = fmt::format("row {} of {}: changes by {} mm, expected {} mm", i,
                                          seen[i].row->test, change, expected);
            }
            largest = std::max(largest, std::abs(expected));
        }
        REQUIRE(largest > 1e-4);  // a law that says nothing proves nothing
        UNSCOPED_INFO(where_worst);
        return worst / largest;
    }
};

inline bool planar_circle(const Seen& s) {
    return s.row->test.rfind("plane", 0) == 0;
}
inline bool probing(const Seen& s) {
    return s.row->device != records::Device::ballbar;
}
/// Rows at a circle's ends and where an axis turns say little about speed.
inline bool moving(const Seen& s) {
    return planar_circle(s) && s.path > 12.0 && s.path < 2.0 * pi * bar_mm - 12.0;
}
inline bool away_from_turns(const Seen& s) {
    const auto near = [](double v, double travel) { return travel == 0.0 && std::abs(v) > 1e-9; };
    return moving(s) && !near(s.velocity.x(), s.travel.x()) &&
           !near(s.velocity.y(), s.travel.y()) && !near(s.velocity.z(), s.travel.z());
}

inline Wrong tip(const Vector3& shift) {
    Wrong w;
    w.tip = shift;
    return w;
}

}  // namespace trunnion
