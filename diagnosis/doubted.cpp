#include "diagnosis/doubted.h"

#include <algorithm>

#include "diagnosis/rules.h"

namespace trunnion::diagnosis {
namespace {

bool is_improbable_ripple(const Outcome& f, const Claim& claim) {
    if (claim.probability >= rules::claimed || !f.judgement.interpolates[claim.position])
        return false;
    return f.design.group(f.model.members[claim.position]).kind == GroupKind::periodic ||
           std::any_of(claim.rival_groups.begin(), claim.rival_groups.end(),
                       [&](std::size_t group) {
                           return f.design.groups()[group].only_rival &&
                                  f.design.group(group).kind == GroupKind::periodic;
                       });
}

bool is_claimed(const Outcome& f, std::size_t position, const std::vector<Claim>& claims) {
    const std::string& name = f.design.group(f.model.members[position]).name;
    return std::any_of(claims.begin(), claims.end(), [&](const Claim& claim) {
        return claim.probability >= rules::claimed &&
               (claim.position == position || claim.name == name);
    });
}

}  // namespace

std::vector<double> usual_sizes(Design& design, const Model& model) {
    const Fit fit = fit_of(design, model);
    std::vector<double> sizes;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        sizes.push_back(design.group(model.members[k])
                            .feature_values(fit.mean.segment(fit.first[k], fit.size[k]))
                            .lpNorm<Eigen::Infinity>());
    return sizes;
}

std::optional<Judgement> doubted(const Outcome& f, const std::vector<Claim>& claims) {
    Judgement judgement = f.judgement;
    for (const Claim& claim : claims) {
        if (!is_improbable_ripple(f, claim)) continue;
        if (claim.share >= rules::between_part) judgement.between_places = false;
        for (std::size_t k = 0; k < f.model.members.size(); ++k)
            if (f.design.group(f.model.members[k]).name == claim.name)
                judgement.interpolates[k] = false;
    }
    const std::vector<double> sizes = usual_sizes(f.design, f.model);
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        if (!is_cause(f.design.group(f.model.members[k]).kind) || sizes[k] <= rules::enormous ||
            is_claimed(f, k, claims))
            continue;
        judgement.interpolates[k] = false;
        for (const Claim& claim : claims)
            if (claim.position == k && claim.own >= rules::between_part)
                judgement.between_places = false;
    }
    if (judgement.interpolates == f.judgement.interpolates) return std::nullopt;
    return judgement;
}

}  // namespace trunnion::diagnosis
