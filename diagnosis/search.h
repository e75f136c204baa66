// Which groups of columns explain the readings: restricted likelihood of models, searched step by
// step. Functions from a model to a better model; the design only answers questions.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/design.h"

namespace trunnion::diagnosis {

/// Members (indices into Design::groups) with their variances.
struct Model {
    std::vector<std::size_t> members;
    estimation::Variances variances;
    double score = 0.0;  ///< log likelihood against no member, plus the members' log priors
};

struct SearchSetting {
    estimation::NoisePrior noise;
    double empty = 0.0;  ///< likelihood without members, its own noise fitted
    /// Better keys for a member that has just joined, as another group; nothing where there are
    /// none. What a rough key leaves would call for members that are not there.
    std::function<std::optional<std::size_t>(const Model& model, std::size_t position)> refine = {};
};
SearchSetting search_setting(Design& design, const estimation::NoisePrior& noise);
Model empty_model(Design& design, const SearchSetting& setting);

/// The members' variances and the noise anew, from `start`, in so many sweeps.
Model tuned(Design& design, const SearchSetting& setting, Model start, int sweeps);

/// A group that could join a model.
struct Offer {
    std::size_t group = 0;
    estimation::GroupGain gain;
    double value = 0.0;                 ///< mean gain plus log prior, nats
    estimation::GroupInformation left;  ///< of the group beside the model
    double explained() const;           ///< chi-squared that it takes at its best size
};
/// All visible groups that the model does not hold in another form, best first; of the kinds that
/// `takes` (where given) takes.
std::vector<Offer> offers(Design& design, const Model& model,
                          const std::function<bool(GroupKind)>& takes = {});
/// The same member, or the same cause in another form?
bool same_cause(const ColumnGroup& a, const ColumnGroup& b);
/// What each member adds beside the others, in their order.
std::vector<Offer> worth_of_members(Design& design, const Model& model);
Model without(const Model& model, std::size_t position);

/// Members added one by one as long as the score rises.
Model grown(Design& design, const SearchSetting& setting, Model model);
/// Weak members taken away, members swapped for better ones, free forms for other lengths with a
/// named effect beside, until the score rises no more.
Model settled(Design& design, const SearchSetting& setting, Model model);
/// Started with and without the zeros of tests; the better one.
Model searched(Design& design, const SearchSetting& setting);

/// Fitted coefficients of the members beside the set-up: mean and root of the covariance.
struct Fit {
    Eigen::VectorXd mean;
    Eigen::MatrixXd half;  ///< R with R'R the covariance
    std::vector<Eigen::Index> first, size;
};
Fit fit_of(Design& design, const Model& model);
/// Whitened part of the data that each member stands for, set-up projected out: rows x members.
Eigen::MatrixXd contributions(Design& design, const Model& model, const Fit& fit);

}  // namespace trunnion::diagnosis
