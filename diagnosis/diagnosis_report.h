// The last stage: the results as values for output; fresh rows: measured_shrink.cpp.
#pragma once

#include "diagnosis/diagnosis.h"
#include "diagnosis/prepare/prepare.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

/// Results of all earlier stages.
struct Outcome {
    const Prepared& prepared;
    Design& design;
    const SearchSetting& setting;
    const Model& model;
    const Judgement& judgement;
    const NoiseBelief& noise;
    const std::vector<bool>& used;
    const std::vector<bool>& beside_set_up;  ///< the same before a model set readings aside
    const Challenged& found;                 ///< the model with the contenders of its causes
};
Diagnosis report_of(const Outcome& found, const DiagnosisOptions& options);

/// H of a separate table: the fraction of its excess that `after` removes, weighted by sigma. 1
/// when the table shows no gap that could be reduced, 0 when `after` would make one there.
double measured_part(const Outcome& found, const setup::Setup& after,
                     const records::ReadingTable& holdout);

/// Reduction of the gap on a separate table, in um (not whitened); bootstrap over poses and passes.
HeldOut measured_shrink(const Outcome& found, const setup::Setup& after,
                        const records::ReadingTable& holdout, std::uint64_t seed);

}  // namespace trunnion::diagnosis
