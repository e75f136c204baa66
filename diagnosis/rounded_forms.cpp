#include "diagnosis/rounded_forms.h"

#include <algorithm>

#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr double nothing_else = 0.8;  ///< part of the noise that is rounding: nothing dithers
constexpr double as_large = 1.3;      ///< errors of rounding: those of one curve may be larger
constexpr double as_likely = 0.4;     ///< probability at most

/// Deviation of the errors of rounding, in that of the noise: median of the readings.
double rounding_of(const Outcome& f) {
    const Prepared& p = f.prepared;
    std::vector<double> parts;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        if (!f.used[i]) continue;
        const auto row = static_cast<Eigen::Index>(i);
        const double noise_mm =
            f.noise.model.of(p.replay.contact(i).device).scale * p.base.sigma_mm(row);
        parts.push_back(p.rounding_mm(row) / noise_mm);
    }
    return parts.empty() ? 0.0 : estimation::median(std::move(parts));
}

}  // namespace

void doubt_rounded_forms(const Outcome& f, std::vector<Claim>& claims) {
    const double rounding = rounding_of(f);
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
