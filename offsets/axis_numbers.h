// Controlled-axis numbers as used by parameters: 1 is the first axis of the control.
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "geometry/parallel_axes.h"
#include "offsets/stores.h"

namespace trunnion::offsets {

/// Letter of axis `number`: parameter 1020 of that axis when set, else `order`, else (empty order)
/// the order of `Axis`. Empty when the control has no such axis.
std::optional<Axis> axis_of_number(const Parameters& parameters, int number,
                                   const std::vector<Axis>& order);
/// Number of an axis in `order` (1020 is not used); 0 when it is not in `order`.
int number_of_axis(Axis axis, const std::vector<Axis>& order);

/// Number of an axis of that order: by 1020 where it names the axis.
int number_of_named_axis(const Parameters& parameters, Axis axis, const std::vector<Axis>& order);
/// Value of an axis parameter: the axis's own, or the one for all; nothing when it is absent.
std::optional<double> value_of_axis(const Parameters& parameters, int parameter, int number);

/// Decodes parameter 1022 of U, V and W.
ParallelAxes parallel_axes(const Parameters& parameters, const std::vector<Axis>& order);

}  // namespace trunnion::offsets
