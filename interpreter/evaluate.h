// Evaluates the reverse Polish code of an expression.
#pragma once

#include "interpreter/code.h"
#include "interpreter/memory.h"

namespace trunnion::interpreter {

struct EvaluationRules {
    bool signed_angles = false;  ///< parameter 6004#0 = 1: ATAN[a]/[b] in -180..180, ASIN in
                                 ///< -90..90; 0: 0..360 and 270..90
    double increments_per_unit = 1000.0;  ///< ROUND inside an NC word; ADP
};

/// The value of `code`; vacant only when the expression is a single vacant variable. In arithmetic
/// vacant counts as 0; EQ and NE distinguish vacant from 0. Angles in degrees. Alarms have the
/// column.
double evaluate(const Op* code, std::uint32_t count, const Memory& memory,
                const EvaluationRules& rules);

/// Rounds a value that is used as a number of something; vacant is 0. Alarm 110 beyond 9 digits.
int whole_number(double value, int column);

}  // namespace trunnion::interpreter
