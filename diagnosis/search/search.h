// Groups of columns that explain the readings: step-by-step search with the restricted likelihood
// of models. Each function takes a model and returns a better one; the design is only evaluated.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "diagnosis/search/design.h"

namespace trunnion::diagnosis {

/// Members (indices into Design::groups) with their variances.
struct Model {
    std::vector<std::size_t> members;
    estimation::Variances variances;
    double score = 0.0;  ///< log likelihood relative to no member, plus the log priors of the
                         ///< members
};

struct SearchSetting {
    estimation::NoisePrior noise;
    double empty = 0.0;  ///< likelihood without members, with its own noise estimate
    /// Better keys for the member added last, as another group; empty if there are none. The
    /// residual of a rough key would require members that do not exist.
    std::function<std::optional<std::size_t>(const Model& model, std::size_t position)> refine = {};
    /// Asked at each step: false ends the search with the best model so far. Empty: never.
    std::function<bool()> go_on = {};
    /// Beside forms of every axis some 20 errors may be seen at once (assumed).
    std::size_t most_members = 24;
    /// A model does not grow further if even as many steps as are left, each with the gain of the
    /// last one, would not reach this score.
    double worth_growing = -std::numeric_limits<double>::infinity();

    bool stopped() const { return go_on && !go_on(); }
};
SearchSetting search_setting(Design& design, const estimation::NoisePrior& noise);
Model empty_model(Design& design, const SearchSetting& setting);

/// Estimates the members' variances and the noise again, from `start`, in `sweeps` sweeps.
Model tuned(Design& design, const SearchSetting& setting, Model start, int sweeps);

/// A group that could be added to a model.
struct Offer {
    std::size_t group = 0;
    estimation::GroupGain gain;
    double value = 0.0;                 ///< mean gain plus log prior, nats
    estimation::GroupInformation left;  ///< of the group beside the model
    double explained() const;           ///< chi-squared explained at its best size
};
Offer offer_of(const Design& design, std::size_t group, const estimation::GroupInformation& left);
/// Offers beside a model; OffersBeside (diagnosis/search/offers.h) has those beside parts of it,
/// too.
std::vector<Offer> offers(Design& design, const Model& model,
                          const std::function<bool(GroupKind)>& takes = {});
/// Minimum gain of an exchange, nats.
inline constexpr double better = 0.5;
/// Members up to which pairs of them are tried against one effect in their place.
inline constexpr std::size_t pairs_up_to = 6;

/// True for the same member, or the same cause in another form.
bool same_cause(const ColumnGroup& a, const ColumnGroup& b);
/// Gain of each member beside the others, in their order.
std::vector<Offer> worth_of_members(Design& design, const Model& model);
Model without(const Model& model, std::size_t position);
Model with(Model model, const Offer& offer);
/// The score with each member's likelihood averaged over its size (GroupGain::mean) instead of its
/// maximum: models with different numbers of members are compared by it.
double evidence(Design& design, const Model& model);

/// Removes the weakest members as long as one does not pay for its prior.
Model pruned(Design& design, const SearchSetting& setting, Model model);
/// Replaces members one by one by offers that raise the score.
Model swapped(Design& design, const SearchSetting& setting, Model model);
/// Adds members one by one as long as the score increases.
Model grown(Design& design, const SearchSetting& setting, Model model);
/// Removes weak members of a grown model, swaps members for better ones, and changes lengths of
/// free forms together with a named effect, until the score no longer increases.
Model settled(Design& design, const SearchSetting& setting, Model model);
/// The better result of a search with and one without the zeros of tests.
Model searched(Design& design, const SearchSetting& setting);

/// Fitted coefficients of the members beside the set-up: mean and square root of the covariance.
struct Fit {
    Eigen::VectorXd mean;
    Eigen::MatrixXd half;  ///< R, where R'R is the covariance
    std::vector<Eigen::Index> first, size;
};
Fit fit_of(Design& design, const Model& model);
/// Whitened contribution of each member to the data, set-up projected out: rows x members.
Eigen::MatrixXd contributions(Design& design, const Model& model, const Fit& fit);

}  // namespace trunnion::diagnosis
