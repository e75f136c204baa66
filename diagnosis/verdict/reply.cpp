#include "diagnosis/verdict/reply.h"

#include <algorithm>

#include "diagnosis/search/model_weight.h"

namespace trunnion::diagnosis {
namespace {

constexpr double least_overlap = 0.1;  ///< part of a contribution that a rival must do

bool has(const Model& model, std::size_t group) {
    return std::find(model.members.begin(), model.members.end(), group) != model.members.end();
}

/// A model with the members that are the cause in another one.
Model with_cause(const Design& design, Model model, const Model& other, const std::string& cause) {
    for (std::size_t k = 0; k < other.members.size(); ++k) {
        const ColumnGroup& group = design.group(other.members[k]);
        if (!is_cause(group.kind) || group.name != cause || has(model, other.members[k])) continue;
        model.members.push_back(other.members[k]);
        model.variances.tau.push_back(other.variances.tau[k]);
    }
    return model;
}

/// Causes that a contender has and the chosen model has not, with the fraction of `part` that each
/// does in it, the largest first.
std::vector<std::pair<double, std::size_t>> others_in(Design& design, const Model& chosen,
                                                      const Model& contender,
                                                      const Eigen::VectorXd& part) {
    const Eigen::VectorXd along =
        contributions(design, contender, fit_of(design, contender)).transpose() * part;
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t k = 0; k < contender.members.size(); ++k) {
        const std::size_t group = contender.members[k];
        const auto same = [&](std::size_t m) {
            return same_cause(design.group(m), design.group(group));
        };
        if (is_cause(design.group(group).kind) &&
            std::none_of(chosen.members.begin(), chosen.members.end(), same))
            found.emplace_back(-along(static_cast<Eigen::Index>(k)), group);
    }
    std::sort(found.begin(), found.end());
    for (auto& [does, group] : found) does *= -1.0 / part.squaredNorm();
    return found;
}

/// Whitened contribution of all forms of a cause.
Eigen::VectorXd part_of(Design& design, const Model& model, const std::string& cause) {
    const Eigen::MatrixXd parts = contributions(design, model, fit_of(design, model));
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(parts.rows());
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]);
            is_cause(group.kind) && group.name == cause)
            sum += parts.col(static_cast<Eigen::Index>(k));
    return sum;
}

}  // namespace

std::vector<std::size_t> in_place_of(Design& design, const Model& chosen, const Model& contender,
                                     const Eigen::VectorXd& part) {
    std::vector<std::size_t> groups;
    for (const auto& [does, group] : others_in(design, chosen, contender, part))
        if (does > least_overlap) groups.push_back(group);
    return groups;
}

Model reply_to(const Searching& search, const Model& chosen, const Model& contender,
               const std::string& cause) {
    Design& design = search.design;
    const Model both = with_cause(design, contender, chosen, cause);
    Model best = tuned(design, search.setting, both, 2);
    double weight = weight_of(design, best);
    for (const std::size_t group :
         in_place_of(design, chosen, contender, part_of(design, chosen, cause))) {
        const auto at = std::find(both.members.begin(), both.members.end(), group);
        Model other = without(both, static_cast<std::size_t>(at - both.members.begin()));
        other = tuned(design, search.setting, std::move(other), 2);
        const double own = weight_of(design, other);
        if (!(own > weight)) continue;
        weight = own;
        best = std::move(other);
    }
    return pruned(design, search.setting, std::move(best));
}

}  // namespace trunnion::diagnosis
