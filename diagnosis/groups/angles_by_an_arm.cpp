#include "diagnosis/groups/angles_by_an_arm.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr double least_own = 0.01;  ///< of the squared columns
constexpr double least_told = 1.0;  ///< chi-squared of an angle of usual size outside the others
constexpr double turns_together = -0.7;  ///< ln 0.5: a slide that turns about one axis of M turns
                                         ///< about another as well (assumed)

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

/// True where readings tell a turn of usual size from the errors named first, though it does nearly
/// the same: through several arms that differ by little.
bool is_told(const Design& design, const ColumnGroup& turn,
             const std::vector<Eigen::Index>& others) {
    return design.outside(turn.features, others) * design.of(turn.features).information.trace() >=
           least_told;
}

/// The turns of an axis by what the readings tell of them.
struct Turns {
    std::set<char> by_an_arm, by_themselves, told;
};

Turns turns_of(const Design& design, const ColumnGroup& angles) {
    Turns turns;
    const std::vector<Eigen::Index> others = features_named_first(design, angles);
    if (others.empty()) return turns;
    for (const char turn : {'A', 'B', 'C'}) {
        const ColumnGroup one = about(angles, {turn});
        if (one.features.empty()) continue;
        const bool seen = design.outside(one.features, others) >= least_own;
        (seen ? turns.by_themselves : turns.by_an_arm).insert(turn);
        if (seen || is_told(design, one, others)) turns.told.insert(turn);
    }
    return turns;
}

/// Turns through one arm that do the same share the prior of one: the name that comes first is as
/// probable as all of them.
void share_prior_of_same(Design& design, const std::vector<std::size_t>& arms) {
    for (const std::size_t k : arms) {
        const ColumnGroup& own = design.group(k);
        double same = 0.0;
        for (const std::size_t m : arms)
            if (design.outside(own.features, design.group(m).features) < least_own) same += 1.0;
        design.favour(k, -std::log(std::max(1.0, same)));
    }
}

}  // namespace

bool are_told_by_themselves(const Design& design, const ColumnGroup& angles) {
    const std::vector<Eigen::Index> others = features_named_first(design, angles);
    return others.empty() || turns_of(design, angles).by_an_arm.empty();
}

void favour_motions_over_angles(Design& design) {
    std::vector<std::size_t> arms;
    for (std::size_t k = 0, count = design.groups().size(); k < count; ++k) {
        const ColumnGroup angles = design.group(k);
        if (!is_angular(angles) || angles.shape.size() > 0) continue;
        const Turns turns = turns_of(design, angles);
        if (turns.by_an_arm.empty()) continue;
        if (!turns.by_themselves.empty()) design.add(about(angles, turns.by_themselves));
        const double of_arm =
            rules::by_an_arm - std::log(static_cast<double>(turns.by_an_arm.size()));
        // A slide that turns about one axis turns about others, too: that is one error.
        if (turns.told.size() > std::max<std::size_t>(1, turns.by_themselves.size())) {
            ColumnGroup together = about(angles, turns.told);
            together.log_prior += turns_together + (turns.by_themselves.empty() ? of_arm : 0.0);
            design.add(std::move(together));
        }
        for (const char turn : turns.by_an_arm) {
            ColumnGroup arm = about(angles, {turn});
            arm.log_prior += of_arm;
            arms.push_back(design.add(std::move(arm)));
        }
        design.hide(k);
    }
    share_prior_of_same(design, arms);
}

}  // namespace trunnion::diagnosis
