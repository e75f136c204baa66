// Machines whose tool carries a retroreflector, and laser tests on them: runs up and down.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::laser_lines {

/// A stage of three axes with its target at the tool's origin. `more`: keys after [model].
inline setup::Setup stage(const std::string& more = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"stage\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n" +
            more,
        "stage.toml", notes);
}

/// A mill with its target `arm_mm` below the spindle.
inline setup::Setup mill(const std::string& chain, double arm_mm, double noise_um) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"" + chain +
            "\"\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
            "tool_mm = [0, 0, " +
            std::to_string(-arm_mm) +
            "]\n[model]\nmodelled = []\nnoise_um = { linear = " + std::to_string(noise_um) + " }\n",
        "mill.toml", notes);
}

inline records::ReadingTable empty_table() {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before.fill(1);
    return table;
}

struct Line {
    std::string test;
    Axis along = Axis::X;
    double from_mm = 0.0, step_mm = 20.0;
    int places = 16;
    Vector3 direction_M = Vector3::UnitX();  ///< component that is read
    double z_mm = 0.0;                       ///< where Z rests
};

/// Adds three runs up and down over the places of a line, ten seconds apart, without values.
inline void add_runs(records::ReadingTable& table, const Line& line) {
    for (int pass = 0; pass < 6; ++pass)
        for (int k = 0; k < line.places; ++k) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * row.index;
            row.commanded[Axis::Z] = line.z_mm;
            row.commanded[line.along] =
                line.from_mm + line.step_mm * (pass % 2 ? line.places - 1 - k : k);
            row.test = line.test;
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = line.direction_M;
            table.rows.push_back(row);
        }
}

}  // namespace trunnion::laser_lines
