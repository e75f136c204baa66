// Probability of a cause by the evidence: of the models with it among all that may stand in its
// place.
#pragma once

#include "diagnosis/search/offers.h"
#include "diagnosis/search/stand_ins.h"
#include "diagnosis/verdict/claims.h"

namespace trunnion::diagnosis {

/// What may stand in place of a member: one effect, or two of few parameters.
struct Alternatives {
    const std::vector<Offer>& others;
    const std::vector<TwoInstead>& pairs;
    /// The member is a table that holds at its places only: a ripple of its axis that these do not
    /// resolve does the same there, and is no other cause.
    bool at_places = false;
};

/// Probability by the evidence: of a cause, and of the cause or a free form that makes it doubtful.
struct EvidenceOf {
    double cause, axis;
};
/// Posterior weight of the models that contain a member of `model` (`held`), relative to: the
/// chosen model, the model without it, those with it replaced, by one effect or two, and those with
/// another one in place of two. `zeta`: tempering exponent.
EvidenceOf evidence_of(const Searching& search, const Model& model, const Offer& held,
                       const Alternatives& instead, double zeta);

/// True for two free forms of the same axis.
bool are_forms_of_one_axis(const ColumnGroup& a, const ColumnGroup& b);
/// Logarithm of the sum of exponentials.
double log_sum(const std::vector<double>& values);

}  // namespace trunnion::diagnosis
