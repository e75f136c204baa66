// Gaps that are told by readings which are off alike, as no noise is (alike_readings.cpp).
#pragma once

#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

/// H. `unknowns`: of the set-up, for each reading.
double part_of(const Judgement& j, double unknowns);

/// A gap where what is left of neighbours is alike: noise is then at most what they do not share.
/// Successive rows of a log are alike within the last digit, too: that is no gap.
void see_neighbours(const Prepared& p, const std::vector<bool>& used,
                    const Eigen::VectorXd& remainder, double unknowns, Judgement& j);

/// A gap where a model leaves more of a ballbar's readings, as they are, than the noise that its
/// repeats tell, of which neighbours share a part: whitened, a course of minutes is hardly seen
/// beside noise of that memory.
void see_slow_course(const Prepared& p, Design& design, const Model& model, const NoiseModel& noise,
                     Judgement& j);

}  // namespace trunnion::diagnosis
