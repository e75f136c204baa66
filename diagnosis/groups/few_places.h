// Axes that were read at few places: what is not told there, and what holds there alone.
#pragma once

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// True where a linear axis stands at two positions only in all readings that show displacements.
bool is_at_two_places(const Prepared& prepared, Axis axis);
/// True for a play sideways of an axis that reaches each of two positions from one side. There it
/// is the squareness in each direction, and one cause of two parameters must not stand for two of
/// one: it is offered for each direction by itself.
bool is_squareness_here(const Prepared& prepared, const effects::Effect& effect);
/// True for an error motion of an axis that stands at one place in all readings: whatever it does
/// there is a constant of the set-up, and what looks like it is a zero of another channel. Its play
/// is seen at one place, if that was reached from both sides.
bool is_of_resting_axis(const Prepared& prepared, const effects::Effect& effect);
/// Adds the names of these effects to those that the readings do not show.
void add_resting(const Prepared& prepared, std::vector<std::string>& unseen);

/// True for a play of a linear axis, along it or sideways, whose side is a function of the
/// position: no place was reached from both sides, and along the travel the side changes twice at
/// most (a grid in layers, always upwards). A step there is a form of the axis as well.
bool is_side_of_places(const Prepared& prepared, const effects::Effect& effect);

/// True for a textbook form with a bend, or with a table beside it, of a linear axis that was read
/// at so few places that other forms would do the same there; and for harmonics of a rotary axis
/// with a gap between its places.
bool bends_at_few_places(const Design& design, const Prepared& prepared, const Model& model,
                         std::size_t position);

/// True for harmonics of a turn that was read in equal steps, if a fifth of their squares or more
/// is of orders above a third of the number of places (assumed). A wave that is less than twice as
/// fine has the same values there: order 7 at every 30 degrees has those of order 5.
bool is_alias_of_finer(Design& design, const Prepared& prepared, const Model& model,
                       std::size_t position);

}  // namespace trunnion::diagnosis
