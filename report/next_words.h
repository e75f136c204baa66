// What to measure next, one entry for each measurement.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

struct PlannedMeasurement {
    std::string text, program;
};
/// Pairs that one measurement tells apart share an entry: "to tell A from B, C; D from E: touch
/// ..".
std::vector<PlannedMeasurement> planned_measurements(const diagnosis::Diagnosis& d);

}  // namespace trunnion::report
