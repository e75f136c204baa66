// What a verdict says, and where a gap lies.
#pragma once

#include <string>

#include "base/finite.h"

namespace trunnion::diagnosis {

enum class Verdict : unsigned char { no_gap, explained, partly_explained, ambiguous, unexplained };
const char* to_string(Verdict verdict);

/// A quantity that the gap depends on, with its part of it.
struct DriverShare {
    std::string by, component, text;
    Finite share = 0.0, p_value = 1.0;
};

}  // namespace trunnion::diagnosis
