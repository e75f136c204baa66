// The list of measurements that may be asked for next, as rows to be predicted and as NC programs.
#pragma once

#include <string>
#include <vector>

#include "emulator/setup.h"
#include "records/readings.h"

namespace trunnion {

/// One ready measurement: what to do in words, positions as the control commands them, and how long
/// it takes. `setup` differs from the given one where the measurement needs another stylus or cup.
struct Measurement {
    std::string name, text;
    Setup setup;
    ReadingTable table;
    double minutes = 0.0;
};

/// All measurements that this machine and its artefacts allow.
std::vector<Measurement> ready_measurements(const Setup& setup, double start_s);

/// The measurement as an NC program: G53 positions; spheres call O8100 (programs/sphere9.nc),
/// passes of the ballbar move at their feed. Machine coordinates in mm and deg.
std::string nc_program(const Measurement& measurement);

}  // namespace trunnion
