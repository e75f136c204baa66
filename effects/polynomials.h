// Polynomials of a linear axis: p1 (q/reach) + p2 (q/reach)^2 + ..., q the axis position.
#pragma once

namespace trunnion::effects {

/// Travel at which polynomial coefficients are specified.
inline constexpr double reach_mm = 200.0;

}  // namespace trunnion::effects
