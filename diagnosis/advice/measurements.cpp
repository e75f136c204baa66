#include "diagnosis/advice/measurements.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/advice/measurement_plan.h"

namespace trunnion::diagnosis {
namespace {

/// Angles distributed over both rotary axes without a regular grid.
std::vector<std::vector<double>> spread_angles(const MeasurementPlan& plan, int count) {
    const auto [low, high] = plan.range_deg(0);
    std::vector<std::vector<double>> list;
    for (int k = 0; k < count; ++k)
        list.push_back({low + (high - low) * std::fmod(0.618 * k, 1.0), std::fmod(137.5 * k, 360)});
    return list;
}

/// Adds this number of reachable poses, with alternating sides of approach.
void spread(MeasurementPlan& plan, int poses, double approach_deg = 6.0) {
    int found = 0, tried = 0;
    for (const auto& angles : spread_angles(plan, 4 * poses)) {
        if (found == poses) return;
        const double side = found % 2 ? approach_deg : -approach_deg;
        if (plan.sphere(static_cast<std::size_t>(tried++), angles, side)) ++found;
    }
}

/// The same poses approached from one side, then from the other.
void both_ways(MeasurementPlan& plan) {
    int found = 0, tried = 0;
    for (const auto& angles : spread_angles(plan, 24)) {
        const auto which = static_cast<std::size_t>(tried++);
        if (found < 6 && plan.sphere(which, angles, 6.0)) {
            plan.sphere(which, angles, -6.0);
            ++found;
        }
    }
}

using Fill = void (*)(MeasurementPlan&);

struct Ready {
    const char *name, *text;
    bool bar;
    Fill fill;
};

constexpr Ready ready_list[] = {
    {"both_ways", "find spheres at 6 poses, each approached by both rotary axes from both sides",
     false, both_ways},
    {"many_angles", "find one sphere at 20 irregular angles of the second rotary axis", false,
     [](MeasurementPlan& p) {
         for (int k = 0; k < 20; ++k)
             p.sphere(0, {0.0, std::fmod(101.3 * k, 360.0)}, k % 2 ? 6.0 : -6.0);
     }},
    {"many_tilts", "find one sphere at 16 irregular angles of the first rotary axis", false,
     [](MeasurementPlan& p) {
         const auto [low, high] = p.range_deg(0);
         for (int k = 0; k < 16; ++k)
             p.sphere(0, {low + (high - low) * std::fmod(0.382 * k, 1.0), 0.0}, k % 2 ? 6.0 : -6.0);
     }},
    {"long_stylus", "find spheres at 12 poses with a stylus 60 mm longer", false,
     [](MeasurementPlan& p) {
         p.extension(60.0);
         spread(p, 12);
     }},
    {"reference_sphere", "return to one sphere every 10 minutes for an hour", false,
     [](MeasurementPlan& p) {
         for (int k = 0; k < 7; ++k) {
             p.sphere(0, {0.0, 0.0}, 6.0);
             p.wait(560.0);
         }
     }},
    {"two_modes", "find a sphere at 8 poses by way of G54 and at the same 8 by way of G43.4", false,
     [](MeasurementPlan& p) {
         for (const PositioningMode mode : {PositioningMode::dpp, PositioningMode::rtcp})
             p.sphere_by_store(mode, spread_angles(p, 8), 6.0);
     }},
    {"spindle_turned", "find spheres at 6 poses with the spindle at 0 and at 180 degrees", false,
     [](MeasurementPlan& p) {
         for (const double degrees : {0.0, 180.0}) {
             p.spindle(degrees);
             spread(p, 6);
         }
     }},
    {"eight_azimuths",
     "touch a sphere at its pole, from 4 directions at 45 degrees and from 8 at its equator, at 4 "
     "table angles",
     false,
     [](MeasurementPlan& p) {
         for (const double c : {0.0, 50.0, 130.0, 260.0})
             p.azimuth_touches({0.0, c}, {{90.0, 1}, {45.0, 4}, {0.0, 8}});
     }},
    {"added_load", "find spheres at 8 poses empty and at 8 with 80 kg on the table", false,
     [](MeasurementPlan& p) {
         for (const double kilograms : {0.0, 80.0}) {
             p.load(kilograms);
             spread(p, 8);
         }
     }},
    {"clamped", "find spheres at 6 poses with the clamps open and closed", false,
     [](MeasurementPlan& p) {
         for (const bool closed : {false, true}) {
             p.clamps(closed);
             spread(p, 6);
         }
     }},
    {"warm", "find spheres at 10 poses after warming the machine by 4 K", false,
     [](MeasurementPlan& p) {
         p.temperature(24.0);
         spread(p, 10);
     }},
    {"ballbar_planes", "ballbar circles in XY, YZ, ZX, both senses, at 1000 and at 4000 mm/min",
     true,
     [](MeasurementPlan& p) {
         for (int plane = 0; plane < 3; ++plane)
             for (const double feed : {1000.0, 4000.0})
                 for (const bool clockwise : {false, true}) p.circle(plane, feed, clockwise);
     }},
    {"long_cup", "ballbar circles in XY, YZ, ZX, both senses, with the tool cup 60 mm lower", true,
     [](MeasurementPlan& p) {
         p.extension(60.0);
         for (int plane = 0; plane < 3; ++plane)
             for (const bool clockwise : {false, true}) p.circle(plane, 1000.0, clockwise);
     }},
    {"ballbar_turns",
     "ballbar circles in XY and ZX, then with each rotary axis turning, bar along X, Y and Z, "
     "out and back",
     true, [](MeasurementPlan& p) {
         for (const int plane : {0, 2})
             p.circle(plane, 1000.0, false);  // determines cup and
                                              // length
         for (std::size_t k = 0; k < p.rotary_count(); ++k)
             for (int direction = 0; direction < 3; ++direction)
                 for (const bool up : {true, false}) p.turn(k, up, direction);
     }}};

}  // namespace

namespace {

/// True when a tip can be positioned by X, Y and Z words, as the NC programs do.
bool takes_words(const kinematics::Chain& chain) {
    const auto axes = chain.axes();
    return chain.find(Axis::X) && chain.find(Axis::Y) && chain.find(Axis::Z) &&
           std::all_of(axes.begin(), axes.end(), kinematics::is_letter);
}

}  // namespace

std::vector<Measurement> ready_measurements(const setup::Setup& setup, double start_s) {
    std::vector<Measurement> list;
    if (!takes_words(setup.machine.chain)) return list;
    for (const Ready& ready : ready_list) {
        MeasurementPlan plan(setup, ready.name, ready.text, start_s);
        if (plan.rotary_count() != 2 || !(ready.bar ? plan.has_bar() : plan.has_sphere())) continue;
        plan.define_sides();
        ready.fill(plan);
        Measurement measurement = plan.done();
        const auto& rows = measurement.table.rows;
        if (std::any_of(rows.begin(), rows.end(),
                        [](auto& r) { return r.device != records::Device::none; }))
            list.push_back(std::move(measurement));
    }
    return list;
}

}  // namespace trunnion::diagnosis
