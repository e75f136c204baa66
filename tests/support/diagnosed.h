// A diagnosis without a plan, what it claims, and what a setup leaves of readings.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"

namespace trunnion {

inline diagnosis::Diagnosis diagnosed(const setup::Setup& setup,
                                      const records::ReadingTable& table) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return diagnosis::diagnose(setup, table, options);
}

inline bool claims(const diagnosis::Diagnosis& d, const std::string& effect) {
    return std::any_of(d.causes.begin(), d.causes.end(),
                       [&](const diagnosis::Cause& c) { return c.effect == effect; });
}

/// Standard deviation of readings beside the prediction of a setup, mm or rad; their zero is free.
inline double left_beside(const setup::Setup& setup, const records::ReadingTable& table) {
    const emulator::Replay replay(setup, table);
    const std::vector<double> predicted = replay.predict(effects::active_models(setup));
    double sum = 0.0, square = 0.0;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        const double left = *table.rows[replay.table_row(i)].value_mm - predicted[i];
        sum += left;
        square += left * left;
    }
    const auto n = static_cast<double>(predicted.size());
    return std::sqrt(square / n - sum * sum / n / n);
}

}  // namespace trunnion
