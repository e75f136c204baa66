// One test of one axis, and two tables that hold its two directions.
#pragma once

#include <string>
#include <vector>

#include "imports/iso_points.h"

namespace trunnion::imports {

/// The moving axis and its name.
struct MovedAxis {
    Axis axis = Axis::X;
    bool rotary = false;
    std::string name;
};

/// The quantity read while the axis moved: its position or, if stated, its straightness (`along`)
/// or its pitch, yaw or roll (`about`).
struct WhatWasRead {
    bool angular = false;
    Vector3 direction_M;
    std::string test;
};

struct IsoTest {
    const TextTable* table = nullptr;  ///< the first one
    Facts facts;
    IsoQuantities quantities;
    MovedAxis axis;
    WhatWasRead what;
    IsoSeries series;
    int run = 0;  ///< told by the heading of its table: "Run 2 reverse"
};
/// The run that the heading tells, of a table of one pass; 0: none. Its points get this run.
int run_of_heading(const TextTable& table, IsoSeries& series);

/// Adds a test. If an earlier table of the same file holds the same targets of the same axis in the
/// other direction, or in another run by its heading, both are one test with one zero, with a note.
void add_test(std::vector<IsoTest>& tests, IsoTest test, std::vector<std::string>& notes);

/// True when `test` has only readings of `earlier`, but for rounding: a report may list them again
/// as deviations. Both hold deviations.
bool repeats(const IsoTest& earlier, const IsoTest& test);

}  // namespace trunnion::imports
