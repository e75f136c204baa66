// The list of possible next measurements, as rows for prediction and as NC programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/finite.h"
#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::diagnosis {

/// One ready measurement: description, the rows that its program reads, the program (O8900, calls
/// O8100; none where the present readings are repeated) and its duration.
struct Measurement {
    std::string name, text, program;
    records::ReadingTable table;
    double minutes = 0.0;
    std::optional<setup::Setup> setup = {};  ///< of its rows, if it is not the present one
    bool other_instrument = false;           ///< its rows do not have the gain of the present one
};

/// A measurement that is suggested, to tell two effects apart.
struct NextMeasurement {
    std::string first, second, text, program;
    Finite log_bayes_factor = 0.0;  ///< predicted
    Finite minutes = 0.0;
    Finite probability = 0.0;  ///< predicted: that it excludes the rival
    bool settles = false;      ///< ... which is then expected (rules::settles)
};

/// All measurements possible with this machine and its artefacts. `start_s`: start time on the
/// clock of the present readings.
std::vector<Measurement> ready_measurements(const setup::Setup& setup, double start_s);

}  // namespace trunnion::diagnosis
