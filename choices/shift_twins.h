// What shifts all coordinates of a program exactly as the external offset does.
#pragma once

#include "choices/control_gap.h"
#include "choices/gap_search.h"

namespace trunnion::choices {

/// No log of this program tells these from an external offset: they are its rivals, and need no fit
/// of their own.
struct ShiftTwins {
    bool local = false;   ///< a G52 left in force before the program, which has none itself
    bool preset = false;  ///< the same of G92
    bool zero = false;    ///< positions counted from another machine zero: it visits none
};

/// By runs with shifts of these axes beside the run of this setup.
ShiftTwins twins_of_external(const Comparer& comparer, const FittedControl& control,
                             const std::vector<Axis>& axes = {Axis::X, Axis::Y, Axis::Z});

/// Twins of an external offset that was found share its probability. Where it is a rival they are
/// named behind it, and share what it has. Several stores that together do no more than shift the
/// whole path since the `start` have another machine zero as a rival.
void share_with_twins(const Comparer& comparer, const setup::Setup& start, const GapSearch& found,
                      std::vector<GapCause>& causes);

}  // namespace trunnion::choices
