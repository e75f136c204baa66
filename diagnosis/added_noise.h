// Noise beyond what single readings state (added_noise.cpp): the sigma of a fit of a beam or a spot
// is that of the fit, and the telescope, the air or the target scatter besides.
//
// Model       variance of a reading: nu^2 (sigma_i^2 + s^2) of one device whose rows state
//             different sigmas, in place of nu^2 sigma_i^2.
// Estimate    restricted likelihood of the readings with the members of the model found, whose
//             sizes and nu are fitted again for each s (estimation/variance_groups.h).
// Taken       where a search under it has more evidence than that with nu alone by several nats,
//             and neighbours differ by as much: what follows the place is no noise.
//
// Several targets read at one stop of the axes share what the machine does not repeat: a part of
// the variance of points, along each direction of M (DeviceNoise::shared). It is found in the same
// way where stops hold more readings than directions, and no repeats are needed.
#pragma once

#include "diagnosis/round.h"

namespace trunnion::diagnosis {

/// A search under another noise.
using Again = std::function<Searched(const Prepared&, const Round&)>;

/// Gives rows the noise that adds to theirs, and stops what their readings share, in `prepared` and
/// `round`, with the search under it; nothing where the evidence for it is not clear.
void add_noise(Prepared& prepared, Searched& searched, Round& round, const Again& again);

}  // namespace trunnion::diagnosis
