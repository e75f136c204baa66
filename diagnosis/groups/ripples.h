// Periods of ripples that the positions of an axis can resolve.
#pragma once

#include <optional>

#include "diagnosis/groups/candidate_groups.h"

namespace trunnion::diagnosis {

/// On a grid of fewer positions a ripple whose period is not unique is never claimed: it has half
/// as many frequencies as positions, and one of them resembles an error of any shape.
inline constexpr std::size_t many_on_grid = 24;

/// Of the period that was found: a ripple so much finer that has the same values at all places is
/// improbable, because the prior falls with the number of periods in a turn.
inline constexpr double far_finer = 1.0 / 8.0;

/// A period (mm or rad) is resolved by at least 8 distinct positions over at least two periods,
/// without a gap in the phase above 0.4 of a period and, if all positions are on an equidistant
/// grid, with at least two of its steps in a period. On a grid of 24 positions or more exactly two
/// steps are enough: the readings alternate.
bool shows_period(std::vector<double> places, double period);

/// Other keys of the catalogue that a ripple may have: at the positions of its axis, which stand on
/// a grid, their values are the same (aliases). Not those of an eighth of its period or less, which
/// are improbable. Empty for any other effect.
std::vector<double> equal_periods(const Prepared& prepared, const effects::Effect& effect,
                                  const std::vector<double>& keys);

/// True for a ripple of exactly two steps of the grid: only one of its two components is seen, and
/// nothing of it between the positions.
bool shows_two_phases(const Prepared& prepared, const effects::Effect& effect,
                      const std::vector<double>& keys);

/// Chance that a ripple of some period explains this part (0 to 1) of independent errors at the
/// places of its axis: their number less mean, cosine and sine are free, and any of the periods
/// that the places tell apart may fit. 0 for other effects.
double chance_of_period(const Prepared& prepared, const effects::Effect& effect,
                        const std::vector<double>& keys, double part);

/// Number of different positions of an axis, whatever is read there.
std::size_t place_count(const Prepared& prepared, Axis axis);

/// True for a ripple of which the period, or one of the other keys, is that of a usual lead or pole
/// pitch: a multiple of 0.5 mm or of an eighth of an inch, 2 mm or more; always for one that counts
/// periods in a turn.
bool may_be_usual(const effects::Effect& effect, const std::vector<double>& keys,
                  const std::vector<double>& others);

/// The keys of a ripple of a linear axis at few places (8 to 23) over less than 200 mm that explain
/// most of `rest_mm` (device rows), of all periods: near a rough one, chance wins over what is
/// there. Empty for other effects, more places, a longer way, or more than 500 readings.
std::optional<std::vector<double>> period_at_few_places(const Prepared& prepared,
                                                        const effects::Effect& effect,
                                                        std::vector<double> keys,
                                                        const Eigen::VectorXd& rest_mm);

/// Adds a ripple that the positions of its axis do not resolve as a possible rival: no model
/// contains it, but what another effect explains may be this one. Not for fewer than 8 positions,
/// where some ripple fits any error.
void add_unresolved_ripple(Design& design, const Prepared& prepared, const Whitener& whitener,
                           const effects::Effect& effect, std::vector<double> keys);

/// Adds the effect with given keys if the positions of its axis resolve it and no textbook effect
/// of that axis is equivalent on these readings: at least a fifth of its squared columns must be
/// outside theirs, or so much that they would not count as its rivals; of a spike, which may be the
/// backlash on straight lines, a hundredth. Of periods with the same
/// values on a grid of many positions the longest is added; on one of fewer positions none.
std::optional<std::size_t> add_ripple_or_other(Design& design, const Prepared& prepared,
                                               const Whitener& whitener,
                                               const effects::Effect& effect,
                                               std::vector<double> keys);

}  // namespace trunnion::diagnosis
