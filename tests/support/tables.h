// A believed BC table and random vectors, for tests of the pieces alone.
#pragma once

#include "base/random.h"
#include "base/units.h"
#include "offsets/pivot_parameters.h"

namespace trunnion {

inline Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

inline offsets::PivotParameters bc_table() {
    offsets::PivotParameters pivot;
    pivot.unit = offsets::MechanicalUnit::table_table;
    pivot.first.line = Vector3::UnitY();
    pivot.second.axis = Axis::C;
    pivot.first.sign = pivot.second.sign = -1.0;
    pivot.table_point_mm = {3, -40, 120};
    pivot.table_offset_mm = {0.4, 0.2, -55};
    return pivot;
}

}  // namespace trunnion
