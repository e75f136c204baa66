#include "diagnosis/rounded_forms.h"

#include <algorithm>

#include "diagnosis/prepare/noise.h"

namespace trunnion::diagnosis {
namespace {

// Assumed:
constexpr double nothing_else = 0.8;  ///< part of the noise that is rounding: nothing dithers
constexpr double as_large = 1.3;      ///< errors of rounding: those of one curve may be larger
constexpr double as_likely = 0.4;     ///< probability at most

}  // namespace

void doubt_rounded_forms(const Outcome& f, std::vector<Claim>& claims) {
    const Prepared& p = f.prepared;
    const RepeatedRows rows{p.replay, p.table, p.blocks, f.used, p.cycle, p.rounding_mm};
    const double rounding = least_by_rounding(rows, p.base.sigma_mm, f.noise.model);
    if (rounding < nothing_else) return;
    for (Claim& claim : claims) {
        const GroupKind kind = f.design.group(f.model.members[claim.position]).kind;
        if ((kind != GroupKind::table && kind != GroupKind::periodic) ||
            claim.rms > as_large * rounding)
            continue;
        claim.probability = std::min(claim.probability, as_likely);
        add_rival(rounded_readings, claim);
    }
}

}  // namespace trunnion::diagnosis
