// The last stage: what was found, as the values that commands print.
#pragma once

#include "diagnosis/prepare.h"
#include "diagnosis/verdict.h"

namespace trunnion::diagnosis {

/// Everything that earlier stages found.
struct Outcome {
    const Prepared& prepared;
    Design& design;
    const SearchSetting& setting;
    const Model& model;
    const Judgement& judgement;
    const NoiseBelief& noise;
    const std::vector<bool>& used;
};
Diagnosis report_of(const Outcome& found, const DiagnosisOptions& options);

/// H of a table of its own: the part of its excess that `after` takes away, by sigma. 1 where the
/// table shows no gap that something could be taken from.
double measured_part(const Outcome& found, const setup::Setup& after,
                     const records::ReadingTable& holdout);

/// How far the gap shrinks on a table of its own, raw um; bootstrap over poses and passes.
HeldOut measured_shrink(const Outcome& found, const setup::Setup& after,
                        const records::ReadingTable& holdout, std::uint64_t seed);

}  // namespace trunnion::diagnosis
