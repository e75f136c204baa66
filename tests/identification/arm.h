// A six-axis arm of Denavit-Hartenberg numbers as a setup, and its readings by a tracker.
#pragma once

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/units.h"
#include "effects/settings.h"
#include "identification/identify.h"

namespace trunnion::arm {

/// d, a (mm) and alpha (deg) of each joint, nominal; the last d reaches the target.
struct DenavitHartenberg {
    std::array<double, 6> d_mm, a_mm, alpha_deg;
};

/// A UR5 with a reflector 31 mm beyond its flange.
constexpr DenavitHartenberg ur5{{89.159, 0, 0, 109.15, 94.65, 82.3 + 31.0},
                                {0, -425, -392.25, 0, 0, 0},
                                {90, 0, 0, 90, -90, 0}};

/// Frames 0 (the base) to 6 (the target) at these joint angles, by the textbook's matrices.
inline std::array<Eigen::Matrix4d, 7> frames(const DenavitHartenberg& dh,
                                             const std::array<double, 6>& q_deg) {
    std::array<Eigen::Matrix4d, 7> all;
    all[0].setIdentity();
    for (std::size_t i = 0; i < 6; ++i) {
        const double c = std::cos(rad_from_deg(q_deg[i])), s = std::sin(rad_from_deg(q_deg[i]));
        const double ca = std::cos(rad_from_deg(dh.alpha_deg[i])),
                     sa = std::sin(rad_from_deg(dh.alpha_deg[i]));
        Eigen::Matrix4d next;
        next << c, -s * ca, s * sa, dh.a_mm[i] * c,  //
            s, c * ca, -c * sa, dh.a_mm[i] * s,      //
            0, sa, ca, dh.d_mm[i],                   //
            0, 0, 0, 1;
        all[i + 1] = all[i] * next;
    }
    return all;
}

inline Vector3 target_mm(const DenavitHartenberg& dh, const std::array<double, 6>& q_deg) {
    return frames(dh, q_deg)[6].topRightCorner<3, 1>();
}

/// The arm at home, each joint's line in M (its base frame); a tracker whose pose is free reads a
/// target whose place on the flange is free.
inline std::string setup_text(const DenavitHartenberg& dh, double noise_um,
                              const std::string& instrument_free = "[\"pose\"]") {
    const auto home = frames(dh, {});
    const auto vector = [](const Vector3& v) {
        return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
    };
    std::string text = "[machine]\nname = \"arm\"\nchain = \"w b J1 J2 J3 J4 J5 J6 t\"\n";
    for (std::size_t i = 0; i < 6; ++i)
        text += fmt::format("[machine.axis.J{}]\ndirection = {}\npoint_mm = {}\n", i + 1,
                            vector(home[i].block<3, 1>(0, 2)), vector(home[i].block<3, 1>(0, 3)));
    const Vector3 tool = home[6].block<3, 1>(0, 3) - home[5].block<3, 1>(0, 3);
    return text + fmt::format(
                      "[[instrument]]\nname = \"tracker\"\nfree = {}\n"
                      "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = {}\n"
                      "free = [\"tool\"]\n[model]\nmodelled = [\"location\"]\n"
                      "noise_um = {{ point = {} }}\n",
                      instrument_free, vector(tool), noise_um);
}

inline setup::Setup setup(const DenavitHartenberg& dh, double noise_um,
                          const std::string& instrument_free = "[\"pose\"]") {
    std::vector<std::string> notes;
    return setup::parse_setup(setup_text(dh, noise_um, instrument_free), "arm.toml", notes);
}

struct Pose {
    std::array<double, 6> joints_deg{};
    Vector3 measured_mm = Vector3::Zero();
};

/// The poses of one CSV file of P. Jacobi's data set.
inline std::vector<Pose> published(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(path + " cannot be read");
    std::string line;
    std::getline(file, line);
    std::vector<Pose> poses;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::vector<double> v;
        for (std::string cell; std::getline(cells, cell, ',');) v.push_back(std::stod(cell));
        Pose pose;
        pose.measured_mm = Vector3(v.at(1), v[2], v[3]) - Vector3(v.at(4), v[5], v[6]);
        std::copy_n(v.begin() + 7, 6, pose.joints_deg.begin());
        poses.push_back(pose);
    }
    return poses;
}

/// Three `point` rows a pose: value = dir . (measured - forward kinematics of the nominal arm).
inline records::ReadingTable table(const setup::Setup& setup, const DenavitHartenberg& dh,
                                   const std::vector<Pose>& poses) {
    std::string text =
        "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,j1_deg,j2_deg,j3_deg,"
        "j4_deg,j5_deg,j6_deg,dir_x,dir_y,dir_z,value_mm\n";
    int index = 0;
    for (std::size_t k = 0; k < poses.size(); ++k)
        for (int d = 0; d < 3; ++d) {
            text += fmt::format("{},{},grid,point,R1", index++, 10.0 * static_cast<double>(k));
            for (const double q : poses[k].joints_deg) text += fmt::format(",{}", q);
            const Vector3 off = poses[k].measured_mm - target_mm(dh, poses[k].joints_deg);
            text += fmt::format(",{},{},{},{}\n", int(d == 0), int(d == 1), int(d == 2), off(d));
        }
    std::vector<std::string> notes;
    return records::parse_readings(text, "arm.csv", notes, setup.machine.chain.names());
}

/// Kinematic parameters of any arm: two positions and two tilts a joint, and its zero offset.
inline std::vector<std::string> kinematic_effects() {
    std::vector<std::string> effects{"location"};
    for (int i = 1; i <= 6; ++i) effects.push_back(fmt::format("J{}.zero", i));
    return effects;
}

/// Distances between measured points and those that a fitted setup predicts.
inline std::vector<double> misses_mm(const setup::Setup& fitted,
                                     const records::ReadingTable& table) {
    const records::ReadingTable read =
        emulator::predicted(fitted, table, effects::active_models(fitted));
    std::vector<double> misses;
    for (std::size_t i = 0; i + 2 < table.rows.size(); i += 3) {
        Vector3 off;
        for (std::size_t d = 0; d < 3; ++d)
            off(int(d)) = *table.rows[i + d].value_mm - *read.rows[i + d].value_mm;
        misses.push_back(off.norm());
    }
    return misses;
}

inline double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

}  // namespace trunnion::arm
