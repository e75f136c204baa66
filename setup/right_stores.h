// What the pivot stores of a control must hold for its machine, and what typing that leaves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/machine.h"
#include "offsets/pivot_parameters.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// The stores that say where the rotary axes are, mm: 19700-19714 for G43.4 and G68.2/G53.1, and
/// the centre that DPP and G54.2 turn about (G54 plus the external offset).
struct RotaryStores {
    offsets::PivotParameters pivot;
    Vector3 g54 = Vector3::Zero();
};

/// The stores in force. Nothing without 19680; throws Alarm 5459 for numbers that cannot be.
std::optional<RotaryStores> rotary_stores(const kinematics::Chain& chain,
                                          const offsets::Stores& stores);

/// Where a point of a rotary axis's line lies with all axes at zero, location errors of the axis
/// and of its carriers included, counted from where the spindle's gauge point then really is (a
/// control knows positions by its tool only; EX0S EY0S EZ0S of the spindle shift it). mm along M.
Vector3 known_point_mm(const kinematics::Machine& machine, Axis axis);

/// The stores that put the tip right on this machine, in the gauge of `in_force`: what no function
/// can see stays as it is (the part of a point along its own axis). Exact without tilts; tilts of
/// an axis have no place in these stores and are left out. G54 is the point of the second axis
/// nearest to the first (of a table's one axis: the point nearest to G54; without a rotary table:
/// G54 as it is).
RotaryStores right_stores(const kinematics::Machine& known, const RotaryStores& in_force);

/// Shortest way from the first table axis to the second, mm: G54 holds one point, so DPP and G54.2
/// are off by (R1 - 1) times this whatever G54 says. Zero where the axes meet, and with one or no
/// rotary axis under the table.
Vector3 step_between_axes_mm(const RotaryStores& stores);

/// One number of a store.
struct StoreNumber {
    std::string name;   ///< "19704", "G54 X"
    int parameter = 0;  ///< 0: of a work offset
    int component = 0;  ///< 0, 1, 2 along X, Y, Z
    int place = 0;      ///< 0 G54, 1 19700-2, 2 19703-5, 3 19709-11, 4 19712-14
    double value_mm = 0.0;
};
/// The numbers that count on this kind of machine. G54 counts where a rotary axis is under the
/// table.
std::vector<StoreNumber> store_numbers(const RotaryStores& stores);
/// The same stores with one value changed.
void set_number(RotaryStores& stores, const StoreNumber& number, double value_mm);

/// Least input increment of a length, mm: 0.001 (IS-B), 0.0001 where 1013#1 ISC is 1; on an inch
/// machine (1001#0) a tenth of that in inches. 1013 from memory, so assumed.
double least_increment_mm(const offsets::Parameters& parameters);
RotaryStores rounded(const RotaryStores& stores, double increment_mm);

/// One line of a list that a person types from.
struct StoreLine {
    StoreNumber in_force;
    double exact_mm = 0.0;  ///< unrounded
    double type_mm = 0.0;   ///< in the control's increments
};

/// What to type, and how far the tip then still wanders on the table, largest over the travel.
struct StoresToType {
    RotaryStores in_force, exact, typed;
    std::vector<StoreLine> lines;
    std::vector<StoreLine> fixture;  ///< sets of G54.2 in use, which are counted from G54
    double increment_mm = 0.001;
    double now_um = 0.0;                         ///< with the stores in force, G43.4 and G68.2
    double tilts_um = 0.0;                       ///< left by tilts of the axes, unrounded
    double rounding_um = 0.0;                    ///< added by the increment
    double g54_now_um = 0.0, g54_left_um = 0.0;  ///< DPP and G54.2: in force, after typing
    double apart_um = 0.0;                       ///< part of that because the axes do not meet
};

/// For the machine `known`; nothing where 19700-19714 do not apply. `point_W_mm` is where the tip
/// works, `tip_S_mm` the tool.
std::optional<StoresToType> stores_to_type(const Setup& setup, const kinematics::Machine& known,
                                           const Vector3& point_W_mm, const Vector3& tip_S_mm);

}  // namespace trunnion::setup
