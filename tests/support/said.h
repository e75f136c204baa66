// What a diagnosis says, causes with their rivals, in one line for the messages of tests.
#pragma once

#include <fmt/format.h>

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

}  // namespace trunnion
