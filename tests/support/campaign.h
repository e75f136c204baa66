// A small measuring campaign on a table machine, for tests: positions as the control commands them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/units.h"
#include "effects/settings.h"
#include "emulator/replay.h"

namespace trunnion::campaign {

inline setup::Setup bc_setup() {
    static const std::string text = R"(schema = "trunnion.setup/1"
[machine]
name = "test machine"
chain = "w C B b X Y Z t"
[machine.axis.B]
direction = [0, -1, 0]
point_mm = [12.0, -8.0, 20.0]
limits_deg = [-120, 120]
[machine.axis.C]
direction = [0, 0, -1]
point_mm = [12.0, -8.0, 65.0]
[machine.axis.X]
direction = [1, 0, 0]
[machine.axis.Y]
direction = [0, 1, 0]
[machine.axis.Z]
direction = [0, 0, 1]
[control]
dialect = "fanuc"
[probe]
tip_mm = [0, 0, -150.0]
ball_diameter_mm = 6.0
[ballbar]
cup_mm = [0, 0, -120.0]
length_mm = 100.0
free = ["cup", "length"]
[model]
modelled = ["location"]
noise_um = { sphere = 0.8, touch = 0.8, ballbar = 0.3 }
[[artefact]]
name = "S1"
kind = "sphere"
center_mm = [142.0, -8.0, 155.0]
diameter_mm = 25.4
free = ["center"]
[[artefact]]
name = "S2"
kind = "sphere"
center_mm = [-48.0, 102.0, 205.0]
diameter_mm = 25.4
free = ["center"]
[[artefact]]
name = "P1"
kind = "center_pivot"
center_mm = [87.0, 2.0, 175.0]
diameter_mm = 25.4
free = ["center"]
)";
    std::vector<std::string> notes;
    return setup::parse_setup(text, "test.toml", notes);
}

/// The same with A (about X) carrying C.
inline setup::Setup ac_setup() {
    std::string text = setup::format_setup(bc_setup());
    const auto swap = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
            text.replace(at, from.size(), to), at += to.size();
    };
    swap("w C B b", "w C A b");
    swap("machine.axis.B", "machine.axis.A");
    swap("[0, -1, 0]", "[-1, 0, 0]");
    const auto stores = text.find("[control.parameters]");  // they are derived anew
    if (stores != std::string::npos) text.erase(stores, text.find("\n[", stores) - stores);
    std::vector<std::string> notes;
    return setup::parse_setup(text, "test_ac.toml", notes);
}

/// The rotary axis that carries the other.
inline Axis tilting(const setup::Setup& setup) {
    return setup.machine.chain.find(Axis::B) ? Axis::B : Axis::A;
}

inline records::ReadingTable empty_table(const setup::Setup& setup) {
    records::ReadingTable table;
    table.path = "test.csv";
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        table.axes.push_back(axis.axis);
    return table;
}

/// Linear positions that put the tip on a point of the table at the row's rotary positions.
inline void aim(records::Reading& row, const setup::Setup& setup, const Vector3& target_W,
                const Vector3& tip_S) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) row.commanded[axis] = 0.0;
    const Vector3 at = setup.machine.poses(row.commanded).pose_MW * target_W - tip_S;
    row.commanded[Axis::X] = at.x();
    row.commanded[Axis::Y] = at.y();
    row.commanded[Axis::Z] = at.z();
}

/// `poses` found spheres, three components each, with an approach row before each.
inline void add_sphere_map(records::ReadingTable& table, const setup::Setup& setup, int poses,
                           std::uint64_t seed) {
    SeededNoise random(seed);
    double time_s = table.rows.empty() ? 0.0 : table.rows.back().time_s;
    constexpr PositioningMode modes[] = {PositioningMode::dpp, PositioningMode::rtdfo,
                                         PositioningMode::rtcp, PositioningMode::tw};
    for (int p = 0; p < poses; ++p) {
        records::Reading row;
        row.test = "map";
        row.feature = p % 2 ? "S1" : "S2";
        row.mode = modes[static_cast<std::size_t>(random.uniform() * 4.0)];
        const setup::Artefact& sphere = *setup.find_artefact(row.feature);
        const double b = rad_from_deg(-90.0 + 180.0 * random.uniform());
        const double c = 2.0 * pi * random.uniform();
        for (const double back : {random.uniform() < 0.5 ? -0.1 : 0.1, 0.0}) {
            row.commanded[tilting(setup)] = b + back;
            row.commanded[Axis::C] = c - back;
            aim(row, setup, sphere.center_W_mm, setup.probe->tip_S_mm);
            row.time_s = time_s += 10.0;
            row.temperature_c = 20.0 + time_s / 5000.0;
            row.device = back == 0.0 ? records::Device::sphere : records::Device::none;
            row.direction_M = Vector3::UnitX();
            table.rows.push_back(row);
        }
        for (const Vector3& d : {Vector3(Vector3::UnitY()), Vector3(Vector3::UnitZ())}) {
            row.direction_M = d;
            table.rows.push_back(row);
        }
    }
}

/// A full circle about the centre pivot in a plane (0 XY, 1 YZ, 2 ZX), both senses at two feeds,
/// and rotary tests: the cup rides with the table's pivot, bar radial or axial.
inline void add_ballbar(records::ReadingTable& table, const setup::Setup& setup, int samples = 72) {
    const setup::Artefact& pivot = *setup.find_artefact("P1");
    const double radius_mm = setup.ballbar->length_mm;
    double time_s = table.rows.empty() ? 0.0 : table.rows.back().time_s + 60.0;
    const auto pass = [&](const std::string& name, double feed, int sense, auto place) {
        const double step_s = 2.0 * pi * radius_mm / samples / (feed / 60.0);
        for (int k = 0; k <= samples; ++k) {
            records::Reading row;
            row.test = name;
            row.device = records::Device::ballbar;
            row.feature = "P1";
            row.feed_mm_min = feed;
            row.time_s = time_s += step_s;
            place(row, sense * 2.0 * pi * k / samples);
            table.rows.push_back(row);
        }
        time_s += 60.0;
    };
    for (int plane = 0; plane < 3; ++plane)
        for (const double feed : {1000.0, 4000.0})
            for (const int sense : {1, -1})
                pass("plane" + std::to_string(plane) + (sense > 0 ? "_ccw_" : "_cw_") +
                         std::to_string(static_cast<int>(feed)),
                     feed, sense, [&](records::Reading& row, double angle) {
                         Vector3 bar = Vector3::Zero();
                         bar(plane) = radius_mm * std::cos(angle);
                         bar((plane + 1) % 3) = radius_mm * std::sin(angle);
                         aim(row, setup, pivot.center_W_mm + bar, setup.ballbar->cup_S_mm);
                     });
    for (const Axis axis : {tilting(setup), Axis::C})
        for (int d = 0; d < 3; ++d)
            for (const int sense : {1, -1})
                pass(std::string(1, letter_of(axis)) + "_bar_" + "xyz"[d] +
                         (sense > 0 ? "_up" : "_down"),
                     1000.0, sense, [&](records::Reading& row, double angle) {
                         row.mode = PositioningMode::rtcp;
                         row.commanded[axis] = axis != Axis::C ? 0.25 * angle : angle;
                         aim(row, setup, pivot.center_W_mm, setup.ballbar->cup_S_mm);
                         row.commanded[d == 0 ? Axis::X : d == 1 ? Axis::Y : Axis::Z] += radius_mm;
                     });
}

/// Values as a machine with `truth` reads them, with independent noise of the setup's size.
inline records::ReadingTable measured(const setup::Setup& truth, const records::ReadingTable& table,
                                      std::uint64_t seed, double noise_scale = 1.0) {
    records::ReadingTable result = emulator::predicted(truth, table, effects::active_models(truth));
    SeededNoise random(seed);
    for (records::Reading& row : result.rows) {
        if (row.device == records::Device::none) continue;
        const double sigma_um = row.device == records::Device::ballbar ? 0.3 : 0.8;
        *row.value_mm += noise_scale * 1e-3 * sigma_um * random.normal();
    }
    return result;
}

/// A machine that is not quite where the setup has it: location errors and set-up offsets.
inline setup::Setup real_machine(const setup::Setup& setup) {
    setup::Setup truth = setup;
    const auto set = [&](std::string name, double value) {
        if (tilting(setup) == Axis::A && name[3] == 'B')  // across and about: X -> Y, A -> B
            name = {'E', name[1] == 'X' ? 'Y' : name[1] == 'A' ? 'B' : name[1], '0', 'A'};
        truth.machine.errors.location(*kinematics::parse_error_name(name)) = value;
    };
    set("EX0B", 0.012);
    set("EZ0B", -0.008);
    set("EA0B", 3e-5);
    set("EC0B", -2e-5);
    set("EX0C", 0.006);
    set("EY0C", -0.011);
    set("EA0C", 4e-5);
    set("EB0C", -3e-5);
    truth.artefacts[0].center_W_mm += Vector3(0.02, -0.01, 0.015);
    truth.artefacts[2].center_W_mm += Vector3(-0.015, 0.02, 0.01);
    truth.ballbar->cup_S_mm += Vector3(0.01, -0.005, 0.012);
    truth.ballbar->length_mm += 0.004;
    return truth;
}

inline setup::Setup with_effect(setup::Setup setup, const std::string& injection) {
    setup.effects.push_back(effects::parse_injection(injection, effects::make_catalogue(setup)));
    return setup;
}

}  // namespace trunnion::campaign
