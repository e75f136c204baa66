// Sets of stored numbers, compared near one run of the control.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "choices/joint_stores.h"

namespace trunnion::choices {

constexpr std::size_t most_numbers = 12;  ///< of a set
constexpr double more = 1e-6;             ///< of a score

/// A number that the log depends on, and its store's place in the table.
struct Seen {
    const StoredNumber* number;
    std::size_t store;
    double start, now;
};

using NumberSet = std::vector<Eigen::Index>;  ///< of seen numbers, in order

/// The loss as a function of the numbers' whole changes since the start, near the present run.
class LinearLoss {
  public:
    LinearLoss(const Comparer& comparer, const FittedControl& now,
               const std::vector<Column>& columns, const std::vector<Seen>& seen)
        : comparer_(comparer), normal_(normal_of(comparer, now.run, columns)), loss_(now.run.loss) {
        Eigen::VectorXd since(static_cast<Eigen::Index>(seen.size()));
        for (std::size_t k = 0; k < seen.size(); ++k)
            since[static_cast<Eigen::Index>(k)] = seen[k].now - seen[k].start;
        loss_ += since.dot(2.0 * normal_.right + normal_.matrix * since);
        normal_.right += normal_.matrix * since;
    }
    Eigen::VectorXd best(const NumberSet& set) const {
        const Normal part = part_of(normal_, set);
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(set.size()));
        const Eigen::VectorXd x = solved(part, none);
        // The ridge keeps back a billionth of each number; of a large one that is more than noise.
        return x + solved({part.matrix, part.right - part.matrix * x}, none);
    }
    /// Infinite where a number of the set does not stand out.
    double loss(const NumberSet& set) const {
        if (set.empty()) return loss_;
        const Eigen::VectorXd x = best(set);
        const double loss = least(set);
        const Eigen::VectorXd sigma = this->sigma(set, loss);
        for (Eigen::Index k = 0; k < x.size(); ++k)
            if (std::abs(x[k]) <=
                std::max(least_change_of(comparer_.log()), least_sigmas * sigma[k]))
                return std::numeric_limits<double>::infinity();
        return loss;
    }
    /// Least loss with the set, whether its numbers stand out or not.
    double least(const NumberSet& set) const {
        const Normal part = part_of(normal_, set);
        const Eigen::VectorXd x = best(set);
        return std::max(0.0, loss_ - x.dot(2.0 * part.right - part.matrix * x));
    }
    Eigen::VectorXd sigma(const NumberSet& set, double loss) const {
        return sigmas(part_of(normal_, set), scale_of(comparer_, loss));
    }

  private:
    const Comparer& comparer_;
    Normal normal_;
    double loss_;
};

/// Compares sets of numbers.
class Selection {
  public:
    Selection(const LinearLoss& linear, const std::vector<Seen>& seen, const SetScore& score,
              double least_odds)
        : linear_(linear), seen_(seen), score_(score), least_odds_(least_odds) {}

    double score(const NumberSet& set) const { return score_of(set, linear_.loss(set)); }
    double score_of(const NumberSet& set, double loss) const {
        if (!std::isfinite(loss)) return -std::numeric_limits<double>::infinity();
        return score_(loss, set.size()) - least_odds_ * static_cast<double>(stores(set).size());
    }
    std::set<std::size_t> stores(const NumberSet& set) const {
        std::set<std::size_t> out;
        for (const Eigen::Index k : set) out.insert(seen_[static_cast<std::size_t>(k)].store);
        return out;
    }
    std::set<std::size_t> all_stores() const {
        std::set<std::size_t> out;
        for (const Seen& s : seen_) out.insert(s.store);
        return out;
    }
    NumberSet without(const NumberSet& set, const std::set<std::size_t>& stores) const {
        NumberSet out;
        for (const Eigen::Index k : set)
            if (!stores.contains(seen_[static_cast<std::size_t>(k)].store)) out.push_back(k);
        return out;
    }
    /// The set with numbers of one store added, as long as each raises the score.
    NumberSet with(NumberSet set, std::size_t store) const {
        double best = -std::numeric_limits<double>::infinity();
        for (bool first = true; set.size() < most_numbers; first = false) {
            NumberSet most;
            for (std::size_t k = 0; k < seen_.size(); ++k) {
                if (seen_[k].store != store || contains(set, static_cast<Eigen::Index>(k)))
                    continue;
                NumberSet next = added(set, static_cast<Eigen::Index>(k));
                const double value = score(next);
                if (value <= best + more) continue;
                best = value;
                most = std::move(next);
            }
            if (most.empty()) return first ? NumberSet() : set;
            set = std::move(most);
        }
        return set;
    }
    /// The best set within reach of one.
    NumberSet improved(NumberSet set) const {
        double best = score(set);
        for (bool changed = true; changed;) {
            changed = false;
            for (NumberSet& next : neighbours(set)) {
                const double value = score(next);
                if (value <= best + more) continue;
                best = value;
                set = std::move(next);
                changed = true;
                break;
            }
        }
        return set;
    }

    /// The best set that grows from a part of this one: the others may have been needed only beside
    /// a wrong one.
    NumberSet grown_from_parts(const NumberSet& set) const {
        NumberSet best = set;
        for (const Eigen::Index seed : set) {
            NumberSet next = grown({seed});
            if (score(next) > score(best) + more) best = std::move(next);
        }
        return best;
    }

    static NumberSet added(NumberSet set, Eigen::Index k) {
        set.insert(std::upper_bound(set.begin(), set.end(), k), k);
        return set;
    }

  private:
    /// With the store that helps most, again and again.
    NumberSet grown(NumberSet set) const {
        const std::set<std::size_t> all = all_stores();
        for (double own = score(set);;) {
            NumberSet best;
            for (const std::size_t store : all) {
                NumberSet next = with(set, store);
                const double value = score(next);
                if (next.empty() || value <= own + more) continue;
                own = value;
                best = std::move(next);
            }
            if (best.empty()) return set;
            set = std::move(best);
        }
    }
    static bool contains(const NumberSet& set, Eigen::Index k) {
        return std::find(set.begin(), set.end(), k) != set.end();
    }
    std::vector<NumberSet> neighbours(const NumberSet& set) const {
        std::vector<NumberSet> out;
        for (std::size_t k = 0; k < set.size(); ++k) {
            NumberSet fewer = set;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
            out.push_back(std::move(fewer));
        }
        const std::set<std::size_t> in = stores(set), all = all_stores();
        const auto add_each = [&](const NumberSet& rest) {
            for (const std::size_t store : all)
                if (NumberSet next = with(rest, store); !next.empty())
                    out.push_back(std::move(next));
        };
        const auto add_each_instead = [&](const NumberSet& rest) {
            add_each(rest);
            for (const std::size_t a : in) add_each(without(rest, {a}));
        };
        add_each_instead(set);
        for (std::size_t k = 0, numbers = set.size(); numbers > 1 && k < numbers; ++k)
            add_each_instead(NumberSet(out[k]));
        for (const std::size_t a : in)
            for (const std::size_t b : in)
                if (a < b) add_each(without(set, {a, b}));
        return out;
    }

    const LinearLoss& linear_;
    const std::vector<Seen>& seen_;
    const SetScore& score_;
    double least_odds_;
};

}  // namespace trunnion::choices
