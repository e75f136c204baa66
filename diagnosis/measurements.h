// The list of measurements that may be asked for next, as rows to be predicted and as NC programs.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::diagnosis {

/// One ready measurement: what to do in words, the rows that its program reads, the program
/// (O8900, calls O8100) and how long it takes.
struct Measurement {
    std::string name, text, program;
    records::ReadingTable table;
    double minutes = 0.0;
};

/// All measurements that this machine and its artefacts allow. `start_s`: when they would begin, on
/// the clock of the readings so far.
std::vector<Measurement> ready_measurements(const setup::Setup& setup, double start_s);

}  // namespace trunnion::diagnosis
