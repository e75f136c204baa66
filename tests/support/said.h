// What a diagnosis says: causes with their rivals in one line for the messages of tests, and the
// probability of one of them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion {

inline std::string said(const diagnosis::Diagnosis& d) {
    std::string text = to_string(d.verdict);
    for (const diagnosis::Cause& c : d.causes)
        text += fmt::format(", {}{} {:.0f} % p {:.2f} [{}]", c.effect,
                            c.since.empty() ? "" : " since " + c.since, 100.0 * c.share,
                            c.probability, fmt::join(c.rivals, " "));
    return text;
}

/// Of the form of an effect that is most probable; 0 if none is a cause.
inline double probability_of(const diagnosis::Diagnosis& d, const std::string& effect) {
    double most = 0.0;
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == effect) most = std::max(most, c.probability.value());
    return most;
}

}  // namespace trunnion
