// Correct values of the control's pivot stores for its machine, and the error that remains after
// entering them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/machine.h"
#include "offsets/pivot_parameters.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// The stores with the locations of the rotary axes, mm: 19700-19714 for G43.4 and G68.2/G53.1, and
/// the centre of rotation of DPP and G54.2 (G54 plus the external offset).
struct RotaryStores {
    offsets::PivotParameters pivot;
    Vector3 g54 = Vector3::Zero();
};

/// The active stores. Empty without 19680; throws Alarm 5459 for invalid parameters.
std::optional<RotaryStores> rotary_stores(const kinematics::Chain& chain,
                                          const offsets::Stores& stores);

/// A point of a rotary axis line with all axes at zero, including location errors of the axis and
/// of its carriers, relative to the actual position of the spindle's gauge point: a control knows
/// positions through its tool only, so EX0S EY0S EZ0S of the spindle shift it. mm along the axes of
/// M.
Vector3 known_point_mm(const kinematics::Machine& machine, Axis axis);

/// The stores that position the tip correctly on this machine. Components without any effect (of a
/// point along its own axis) keep their values of `in_force`. Exact without tilts; tilts of an axis
/// cannot be expressed by these stores and are ignored. G54 becomes the point of the second axis
/// nearest to the first (with one table axis: its point nearest to G54; without a rotary table:
/// unchanged).
RotaryStores right_stores(const kinematics::Machine& known, const RotaryStores& in_force);

/// Shortest vector from the first table axis to the second, mm. G54 holds only one point, so DPP
/// and G54.2 have the error (R1 - 1) times this vector for any G54. Zero when the axes intersect,
/// and with fewer than two rotary table axes.
Vector3 step_between_axes_mm(const RotaryStores& stores);

/// One value of a store.
struct StoreNumber {
    std::string name;   ///< "19704", "G54 X"
    int parameter = 0;  ///< 0: work offset
    int component = 0;  ///< 0, 1, 2 along X, Y, Z
    int place = 0;      ///< 0 G54, 1 19700-2, 2 19703-5, 3 19709-11, 4 19712-14
    double value_mm = 0.0;
};
/// The values that matter on this kind of machine. G54 matters with a rotary table axis.
std::vector<StoreNumber> store_numbers(const RotaryStores& stores);
/// Changes one value of the stores.
void set_number(RotaryStores& stores, const StoreNumber& number, double value_mm);

/// Least input increment of a length, mm: 0.001 (IS-B), 0.0001 with 1013#1 ISC = 1; on an inch
/// machine (1001#0) a tenth of that in inch. 1013 is from memory, therefore assumed.
double least_increment_mm(const offsets::Parameters& parameters);
RotaryStores rounded(const RotaryStores& stores, double increment_mm);

/// One line of a list of values to enter.
struct StoreLine {
    StoreNumber in_force;
    double exact_mm = 0.0;  ///< unrounded
    double type_mm = 0.0;   ///< rounded to the control's increment
};

/// Values to enter, and the remaining displacement of the tip on the table: maximum over the
/// travel.
struct StoresToType {
    RotaryStores in_force, exact, typed;
    std::vector<StoreLine> lines;
    std::vector<StoreLine> fixture;  ///< sets of G54.2 in use, which are relative to G54
    double increment_mm = 0.001;
    double now_um = 0.0;                         ///< with the active stores, G43.4 and G68.2
    double tilts_um = 0.0;                       ///< caused by tilts of the axes, before rounding
    double rounding_um = 0.0;                    ///< added by the increment
    double g54_now_um = 0.0, g54_left_um = 0.0;  ///< DPP and G54.2: with the active stores, after
                                                 ///< entering the values
    double apart_um = 0.0;                       ///< part of that caused by axes that do not
                                                 ///< intersect
};

/// For the machine `known`; empty when 19700-19714 do not apply. `point_W_mm`: tip position;
/// `tip_S_mm`: tool.
std::optional<StoresToType> stores_to_type(const Setup& setup, const kinematics::Machine& known,
                                           const Vector3& point_W_mm, const Vector3& tip_S_mm);

}  // namespace trunnion::setup
