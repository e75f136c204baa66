#include "choices/joint_stores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "choices/folds.h"

namespace trunnion::choices {

namespace {

using Eigen::Index, Eigen::VectorXd;

constexpr int most_selections = 4;  ///< of selection and fit
constexpr int most_fits = 25;       ///< steps of Gauss-Newton
constexpr std::size_t most_numbers = 12;
constexpr double lone_block = 0.99;  ///< of what is known of a number
constexpr double more = 1e-6;        ///< of a score

/// A number that the log depends on, and its store's place in the table.
struct Seen {
    const StoredNumber* number;
    std::size_t store;
    double start, now;
};

using Set = std::vector<Index>;  ///< of seen numbers, in order

/// The loss as a function of the numbers' whole changes since the start, near the present run.
class LinearLoss {
  public:
    LinearLoss(const Comparer& comparer, const FittedControl& now,
               const std::vector<Column>& columns, const std::vector<Seen>& seen)
        : comparer_(comparer), normal_(normal_of(comparer, now.run, columns)), loss_(now.run.loss) {
        VectorXd since(static_cast<Index>(seen.size()));
        for (std::size_t k = 0; k < seen.size(); ++k)
            since[static_cast<Index>(k)] = seen[k].now - seen[k].start;
        loss_ += since.dot(2.0 * normal_.right + normal_.matrix * since);
        normal_.right += normal_.matrix * since;
    }
    VectorXd best(const Set& set) const {
        return solved(part_of(normal_, set), VectorXd::Zero(static_cast<Index>(set.size())));
    }
    /// Infinite where a number of the set does not stand out.
    double loss(const Set& set) const {
        if (set.empty()) return loss_;
        const Normal part = part_of(normal_, set);
        const VectorXd x = best(set);
        const double loss = std::max(0.0, loss_ - part.right.dot(x));
        const VectorXd sigma = sigmas(part, scale_of(comparer_, loss));
        for (Index k = 0; k < x.size(); ++k)
            if (std::abs(x[k]) <= std::max(least_change, least_sigmas * sigma[k]))
                return std::numeric_limits<double>::infinity();
        return loss;
    }
    VectorXd sigma(const Set& set, double loss) const {
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

    double score(const Set& set) const { return score_of(set, linear_.loss(set)); }
    double score_of(const Set& set, double loss) const {
        if (!std::isfinite(loss)) return -std::numeric_limits<double>::infinity();
        return score_(loss, set.size()) - least_odds_ * static_cast<double>(stores(set).size());
    }
    std::set<std::size_t> stores(const Set& set) const {
        std::set<std::size_t> out;
        for (const Index k : set) out.insert(seen_[static_cast<std::size_t>(k)].store);
        return out;
    }
    std::set<std::size_t> all_stores() const {
        std::set<std::size_t> out;
        for (const Seen& s : seen_) out.insert(s.store);
        return out;
    }
    Set without(const Set& set, const std::set<std::size_t>& stores) const {
        Set out;
        for (const Index k : set)
            if (!stores.contains(seen_[static_cast<std::size_t>(k)].store)) out.push_back(k);
        return out;
    }
    /// The set with numbers of one store added, as long as each raises the score.
    Set with(Set set, std::size_t store) const {
        double best = -std::numeric_limits<double>::infinity();
        for (bool first = true; set.size() < most_numbers; first = false) {
            Set most;
            for (std::size_t k = 0; k < seen_.size(); ++k) {
                if (seen_[k].store != store || contains(set, static_cast<Index>(k))) continue;
                Set next = added(set, static_cast<Index>(k));
                const double value = score(next);
                if (value <= best + more) continue;
                best = value;
                most = std::move(next);
            }
            if (most.empty()) return first ? Set() : set;
            set = std::move(most);
        }
        return set;
    }
    /// The best set within reach of one.
    Set improved(Set set) const {
        double best = score(set);
        for (bool changed = true; changed;) {
            changed = false;
            for (Set& next : neighbours(set)) {
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
    Set grown_from_parts(const Set& set) const {
        Set best = set;
        for (const Index seed : set) {
            Set next = grown({seed});
            if (score(next) > score(best) + more) best = std::move(next);
        }
        return best;
    }

  private:
    /// With the store that helps most, again and again.
    Set grown(Set set) const {
        const std::set<std::size_t> all = all_stores();
        for (double own = score(set);;) {
            Set best;
            for (const std::size_t store : all) {
                Set next = with(set, store);
                const double value = score(next);
                if (next.empty() || value <= own + more) continue;
                own = value;
                best = std::move(next);
            }
            if (best.empty()) return set;
            set = std::move(best);
        }
    }
    static bool contains(const Set& set, Index k) {
        return std::find(set.begin(), set.end(), k) != set.end();
    }
    static Set added(Set set, Index k) {
        set.insert(std::upper_bound(set.begin(), set.end(), k), k);
        return set;
    }
    std::vector<Set> neighbours(const Set& set) const {
        std::vector<Set> out;
        for (std::size_t k = 0; k < set.size(); ++k) {
            Set fewer = set;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
            out.push_back(std::move(fewer));
        }
        const std::set<std::size_t> in = stores(set), all = all_stores();
        const auto add_each = [&](const Set& rest) {
            for (const std::size_t store : all)
                if (Set next = with(rest, store); !next.empty()) out.push_back(std::move(next));
        };
        const auto add_each_instead = [&](const Set& rest) {
            add_each(rest);
            for (const std::size_t a : in) add_each(without(rest, {a}));
        };
        add_each_instead(set);
        for (std::size_t k = 0, numbers = set.size(); numbers > 1 && k < numbers; ++k)
            add_each_instead(Set(out[k]));
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

class Joint {
  public:
    Joint(const StoreQuestion& question, FittedControl now)
        : comparer_(question.comparer),
          start_(question.start),
          now_(std::move(now)),
          blocks_(question.blocks),
          score_(question.score),
          least_odds_(question.least_odds),
          rival_gap_(question.rival_gap),
          table_(store_table(start_)),
          before_(comparer_.run(start_)) {}

    JointStores explain() {
        see();
        for (int round = 0; round < most_selections; ++round)
            if (!select()) break;
        return told();
    }

  private:
    /// Numbers that the log depends on at the present run; one that was changed and is not seen any
    /// more keeps its value.
    void see() {
        seen_.clear();
        columns_.clear();
        for (std::size_t s = 0; s < table_.size(); ++s)
            for (const StoredNumber& number : table_[s].numbers) {
                auto column = column_of(comparer_, now_.setup, now_.run, number);
                if (!column) continue;
                columns_.push_back(std::move(*column));
                seen_.push_back(
                    {&number, s, value_of(start_, number), value_of(now_.setup, number)});
            }
    }
    Set present() const {
        Set out;
        for (std::size_t k = 0; k < seen_.size(); ++k)
            if (std::abs(seen_[k].now - seen_[k].start) > least_change)
                out.push_back(static_cast<Index>(k));
        return out;
    }
    /// Takes a better set, if the control confirms it.
    bool select() {
        const LinearLoss linear(comparer_, now_, columns_, seen_);
        const Selection selection(linear, seen_, score_, least_odds_);
        const Set old = present(), set = selection.improved(selection.grown_from_parts(old));
        if (set == old || set.empty()) return false;
        const VectorXd x = linear.best(set);
        FittedControl other{start_, {}};
        Numbers numbers;
        for (std::size_t k = 0; k < set.size(); ++k) {
            numbers.push_back(seen_[static_cast<std::size_t>(set[k])].number);
            numbers.back()->in(other.setup) += x[static_cast<Index>(k)];
        }
        other.run = comparer_.run(other.setup);
        for (int k = 0; k < most_fits && improve(comparer_, numbers, other); ++k) {
        }
        if (selection.score_of(set, other.run.loss) <=
            selection.score_of(old, now_.run.loss) + more)
            return false;
        now_ = std::move(other);
        see();
        return true;
    }

    JointStores told() {
        JointStores out;
        const Set set = present();
        const LinearLoss linear(comparer_, now_, columns_, seen_);
        const Selection selection(linear, seen_, score_, least_odds_);
        const VectorXd sigma = set.empty() ? VectorXd() : linear.sigma(set, now_.run.loss);
        const double own = selection.score_of(set, now_.run.loss);
        for (const std::size_t store : selection.stores(set)) {
            StoreCause cause{table_[store].name, table_[store].what, {}, 0.0, {}};
            for (std::size_t k = 0; k < set.size(); ++k) {
                const Seen& seen = seen_[static_cast<std::size_t>(set[k])];
                if (seen.store == store)
                    cause.numbers.push_back({seen.number->name, seen.number->unit, seen.start,
                                             seen.now, sigma[static_cast<Index>(k)]});
            }
            weigh(selection, set, store, own, cause);
            out.causes.push_back(std::move(cause));
        }
        out.left_out = left_out(set);
        out.control = std::move(now_);
        return out;
    }
    /// Against the set without the store, and with each other one in its place.
    void weigh(const Selection& selection, const Set& set, std::size_t store, double own,
               StoreCause& cause) const {
        const Set rest = selection.without(set, {store});
        cause.others = std::exp(std::min(0.0, selection.score(rest) - own));
        for (const std::size_t other : selection.all_stores()) {
            if (other == store) continue;
            const Set instead = selection.with(rest, other);
            if (instead.empty()) continue;
            const double behind = own - selection.score(instead);
            cause.others += std::exp(std::min(0.0, -behind));
            if (behind < rival_gap_ && selection.stores(set).count(other) == 0)
                cause.rivals.push_back(table_[other].name);
        }
    }
    /// A block that alone determines a number is not left out as a whole, but row by row.
    void divide_lone_blocks(const std::vector<Column>& columns, std::vector<int>& folds) const {
        for (const Column& column : columns) {
            std::map<int, double> weight;
            double sum = 0.0;
            for (std::size_t k = 0; k < column.size(); ++k)
                for (const Axis axis : comparer_.log().axes) {
                    const double own = column[k][axis] * column[k][axis];
                    weight[blocks_[now_.run.pairs[k].row]] += own;
                    sum += own;
                }
            for (const auto& [block, own] : weight) {
                if (own < lone_block * sum) continue;
                int in_turn = 0;
                for (std::size_t row = 0; row < folds.size(); ++row)
                    if (blocks_[row] == block) folds[row] = in_turn++ % fold_count;
            }
        }
    }
    std::vector<double> left_out(const Set& set) const {
        if (set.empty()) return now_.run.losses;
        std::vector<Column> columns;
        VectorXd back(static_cast<Index>(set.size()));
        for (std::size_t k = 0; k < set.size(); ++k) {
            const auto at = static_cast<std::size_t>(set[k]);
            columns.push_back(columns_[at]);
            back[static_cast<Index>(k)] = seen_[at].start - seen_[at].now;
        }
        std::vector<int> folds = folds_for(before_.losses, now_.run.losses, blocks_);
        divide_lone_blocks(columns, folds);
        return left_out_losses(comparer_, now_.run, columns, back, folds);
    }

    const Comparer& comparer_;
    const setup::Setup& start_;
    FittedControl now_;
    const std::vector<int>& blocks_;
    const SetScore& score_;
    double least_odds_, rival_gap_;
    std::vector<Store> table_;
    ComparedRun before_;  ///< with the stores of the start
    std::vector<Seen> seen_;
    std::vector<Column> columns_;
};

}  // namespace

JointStores explained_together(const StoreQuestion& question, FittedControl now) {
    return Joint(question, std::move(now)).explain();
}

}  // namespace trunnion::choices
