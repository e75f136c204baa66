// All groups of columns that may explain the gap, one file for each kind: textbook_groups.cpp,
// table_groups.cpp, offset_groups.cpp, driver_groups.cpp, wandering_groups.cpp, one_line.cpp.
#pragma once

#include <functional>
#include <optional>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/design.h"

namespace trunnion::diagnosis {

/// Typical sizes of a dependence on time, place or state.
constexpr double usual_driver_mm = 5e-3, usual_driver_rad = 40e-6;

/// Simpler forms of an effect, each with a subset of its linear parameters: straightness without
/// slope, a single vector of an effect with several (one artefact of many), or the location of one
/// axis.
std::vector<std::function<bool(const effects::EffectParameter&)>> simpler_forms(
    const effects::Effect& effect);

/// Adds catalogue effects without keys, in all forms; their features come first in the design.
/// Returns the number of features, i.e. those owned by textbook effects.
Eigen::Index add_textbook_groups(Design& design, const Prepared& prepared,
                                 const Whitener& whitener);

/// Adds effects without keys, location errors and everything else in the simulation as changes that
/// start in the second or a later session and remain. Call it directly after the textbook groups;
/// returns the number of features.
Eigen::Index add_change_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Adds one group for an effect with given keys; empty when it moves no reading.
std::optional<std::size_t> add_keyed_group(Design& design, const Prepared& prepared,
                                           const Whitener& whitener, const effects::Effect& effect,
                                           std::vector<double> keys);

/// Adds forms that are no textbook form of their own, as rivals only. Angles with a bow, seen
/// through one arm, are a straightness or a scale with a bow; a straightness with a slope (by ISO
/// 230-1 a squareness or the alignment of the instrument) is an angle that grows along the way.
void add_unnamed_forms(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Adds a jump of the machine with given keys, which may be named as a rival only.
void add_machine_jump(Design& design, const Prepared& prepared, const Whitener& whitener,
                      const effects::Effect& jump, std::vector<double> keys);

/// Adds error motions of every axis in free form, one group for each correlation length.
void add_table_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Adds the zero of each test: a shift of the artefact for probes, an offset of the reading for
/// other devices.
void add_offset_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Takes angles of an axis out of the search where positions were read along one line only: what an
/// angle does there is the positioning of the axis by ISO 230-1, and its rival in any form.
void take_line_for_positioning(Design& design, const Prepared& prepared);

/// Keeps a stretch of all axes as a rival where the radius of the stylus does the same: with the
/// places of spheres and rotary axes free, all but the radius stretches alike. A probe that is off
/// by micrometres is the nearer cause, and the stretch would hold for the whole travel.
void take_radius_for_stretch(Design& design);

/// Adds the readings of each visit as values of their own, as rivals only: what a single visit
/// tells may be a bad reading. None for readings of many visits, or of devices that read along a
/// way. `used`: readings that are not set aside.
void add_spoiled_visits(Design& design, const Prepared& prepared, const std::vector<bool>& used);

/// Adds drivers: orthogonal to all textbook effects for the search, and unprojected for locating
/// the gap.
void add_driver_groups(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Eigen::Index owned);

/// Adds drivers for readings along one direction: an axis whose zero moves to and fro in time. Not
/// where the axes never come back, so that time and position are one.
void add_wandering_groups(Design& design, const Prepared& prepared, const Whitener& whitener,
                          Eigen::Index owned);

}  // namespace trunnion::diagnosis
