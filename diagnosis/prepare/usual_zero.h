// How far the zero of a test scatters as a rule.
#pragma once

namespace trunnion::diagnosis {

constexpr double usual_zero_mm = 1e-3;  ///< a variance of 1 of the groups of offset_groups.cpp

}  // namespace trunnion::diagnosis
