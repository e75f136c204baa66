#include "diagnosis/groups/angles_by_an_arm.h"

#include <cmath>
#include <set>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr double least_own = 0.01;  ///< of the squared columns

bool is_angular(const ColumnGroup& group) {
    return group.effect->kind == effects::EffectKind::angular;
}

/// Features of the errors whose names come before angles of this axis.
std::vector<Eigen::Index> features_named_first(const Design& design, const ColumnGroup& angles) {
    std::set<Eigen::Index> others;
    for (const Design::Entry& entry : design.groups()) {
        const effects::Effect& other = *entry.group.effect;
        if (other.kind == effects::EffectKind::squareness ||
            (other.axis == angles.effect->axis && !is_angular(entry.group)))
            others.insert(entry.group.features.begin(), entry.group.features.end());
    }
    return {others.begin(), others.end()};
}

/// The part of a group that turns about some axes of M ('A', 'B', 'C').
ColumnGroup about(const ColumnGroup& angles, const std::set<char>& turns) {
    ColumnGroup part = angles;
    part.parameters.clear();
    part.features.clear();
    for (std::size_t c = 0; c < angles.parameters.size(); ++c)
        if (turns.contains(angles.effect->parameters[angles.parameters[c]].name[1])) {
            part.parameters.push_back(angles.parameters[c]);
            part.features.push_back(angles.features[c]);
        }
    return part;
}

}  // namespace

void favour_motions_over_angles(Design& design) {
    for (std::size_t k = 0, count = design.groups().size(); k < count; ++k) {
        const ColumnGroup angles = design.group(k);
        if (!is_angular(angles) || angles.shape.size() > 0) continue;
        const std::vector<Eigen::Index> others = features_named_first(design, angles);
        if (others.empty()) continue;
        std::set<char> by_an_arm, by_themselves;
        for (const char turn : {'A', 'B', 'C'}) {
            const ColumnGroup one = about(angles, {turn});
            if (one.features.empty()) continue;
            const bool seen = design.outside(one.features, others) >= least_own;
            (seen ? by_themselves : by_an_arm).insert(turn);
        }
        if (by_an_arm.empty()) continue;
        if (!by_themselves.empty()) design.add(about(angles, by_themselves));
        for (const char turn : by_an_arm) {
            ColumnGroup arm = about(angles, {turn});
            arm.log_prior += rules::by_an_arm - std::log(static_cast<double>(by_an_arm.size()));
            design.add(std::move(arm));
        }
        design.hide(k);
    }
}

}  // namespace trunnion::diagnosis
