// Offers of groups beside a model, and beside the same model without one member or with another
// group in its place: one factorisation for all of them.
#pragma once

#include <optional>

#include "diagnosis/search/search.h"
#include "estimation/given_others.h"

namespace trunnion::diagnosis {

/// A ripple that no position resolves may have any size that its rival needs: nats by which one far
/// beyond the usual size is less probable (Cauchy's density, assumed). 0 for other groups.
double unusual_size(const Design& design, const Offer& offer);

class OffersBeside {
  public:
    using Takes = std::function<bool(GroupKind)>;
    OffersBeside(Design& design, const Model& model);

    /// All visible groups that the model does not contain in another form, best first; only kinds
    /// accepted by `takes`, if given.
    std::vector<Offer> all(const Takes& takes = {});
    /// The same beside the model without a member; `instead`: with this group of the member's size
    /// in its place.
    std::vector<Offer> without(std::size_t position, const Takes& takes = {},
                               std::optional<std::size_t> instead = std::nullopt);
    /// Log likelihood with this change, minus that of the model.
    double gained(std::size_t position, std::optional<std::size_t> instead = std::nullopt);
    /// The other forms of a textbook member, beside the model without it.
    std::vector<Offer> other_forms(std::size_t position);
    /// Groups that are kept as rivals only, beside the model without a member.
    std::vector<Offer> only_rivals(std::size_t position);
    /// Visits that may be spoiled (add_spoiled_visits), beside the whole model.
    std::vector<Offer> spoiled_visits();

  private:
    /// What the groups stand beside.
    struct Beside {
        std::vector<std::size_t> members;
        Eigen::VectorXd mean;  ///< of their coefficients
        std::optional<estimation::GivenOthers> others;
        std::optional<std::size_t> instead;
        std::optional<std::size_t> position;  ///< of the member that is absent
    };
    const Beside& changed(std::size_t position, std::optional<std::size_t> instead);
    estimation::GivenOthers others(std::size_t position, std::optional<std::size_t> instead);
    std::vector<Offer> offered(const Beside& beside, const Takes& takes);
    std::vector<Offer> exact(const Beside& beside, const std::vector<std::size_t>& groups);
    void keep_best(std::vector<std::size_t>& groups, const Beside& beside) const;
    void see(const std::vector<std::size_t>& groups);

    Design& design_;
    Model model_;
    std::shared_ptr<HeldMembers> held_;
    std::vector<Eigen::Index> first_;
    std::optional<Beside> last_;  ///< changed last
};

}  // namespace trunnion::diagnosis
