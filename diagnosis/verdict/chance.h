// Chances that noise alone gives what a model explains.
#pragma once

#include "diagnosis/prepare/noise.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

/// Chance that a model explains so much of noise, for as many effects as there are. Noise that
/// repeats tell is known as well as they are many. 1 without members.
double chance_of(const Design& design, const Model& model, const NoiseModel& noise,
                 const Sizes& sizes);

/// True where noise of any size rarely gives what the members explain (F test of free columns,
/// beside a free zero of each test and cycle), and left-out blocks agree or are too few to say.
/// What nobody states and nothing repeats cannot be smaller than what the members leave: two passes
/// of eight targets show a play of three noises, though a prior of the noise has room for it.
bool is_told_without_noise(const Design& design, const Model& model, const Judgement& j,
                           const Saving& saving);

}  // namespace trunnion::diagnosis
