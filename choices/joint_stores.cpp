#include "choices/joint_stores.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "choices/folds.h"
#include "choices/most_rows.h"
#include "choices/store_sets.h"

namespace trunnion::choices {

namespace {

using Eigen::Index, Eigen::VectorXd;

constexpr int most_selections = 4;   ///< of selection and fit
constexpr int most_fits = 25;        ///< steps of Gauss-Newton
constexpr double lone_block = 0.99;  ///< of what is known of a number
constexpr double worth_a_fit = 0.5;  ///< of what a store removes: another one may do as much

/// The set that was chosen, near the present run.
struct Chosen {
    const LinearLoss& linear;
    const Selection& selection;
    const NumberSet& set;
    double score;
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
          table_(store_table(start_, question.used)),
          before_(comparer_.run(start_)) {}

    JointStores explain() {
        see();
        for (int round = 0; round < most_selections; ++round)
            if (!select()) break;
        settle_on_most_rows();
        return told();
    }

  private:
    /// Numbers that the log depends on at the present run; one that was changed and is not seen any
    /// more keeps its value.
    void see() {
        seen_.clear();
        columns_.clear();
        other_moves_.clear();
        for (std::size_t s = 0; s < table_.size(); ++s)
            for (const StoredNumber& number : table_[s].numbers) {
                bool other_moves = false;
                auto column = column_of(comparer_, now_.setup, now_.run, number, &other_moves);
                if (other_moves) other_moves_.insert(s);
                if (!column) continue;
                columns_.push_back(std::move(*column));
                seen_.push_back(
                    {&number, s, value_of(start_, number), value_of(now_.setup, number)});
            }
    }
    NumberSet present() const {
        NumberSet out;
        for (std::size_t k = 0; k < seen_.size(); ++k)
            if (std::abs(seen_[k].now - seen_[k].start) > least_change_of(comparer_.log()))
                out.push_back(static_cast<Index>(k));
        return out;
    }
    /// Takes a better set, if the control confirms it.
    bool select() {
        const LinearLoss linear(comparer_, now_, columns_, seen_);
        const Selection selection(linear, seen_, score_, least_odds_);
        const NumberSet old = present(), set = selection.improved(selection.grown_from_parts(old));
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

    /// Foreign blocks pull each number a little, and need others that do not differ.
    void settle_on_most_rows() {
        const NumberSet set = present();
        Numbers numbers;
        for (const Index k : set) numbers.push_back(seen_[static_cast<std::size_t>(k)].number);
        if (numbers.empty() || !fit_to_most_rows(comparer_, numbers, now_)) return;
        for (const Index k : set) {
            const Seen& seen = seen_[static_cast<std::size_t>(k)];
            if (std::abs(value_of(now_.setup, *seen.number) - seen.start) <=
                least_change_of(comparer_.log()))
                seen.number->in(now_.setup) = seen.start;
        }
        now_.run = comparer_.run(now_.setup);
        see();
    }

    JointStores told() {
        JointStores out;
        const NumberSet set = present();
        const LinearLoss linear(comparer_, now_, columns_, seen_);
        const Selection selection(linear, seen_, score_, least_odds_);
        const VectorXd sigma = set.empty() ? VectorXd() : linear.sigma(set, now_.run.loss);
        const Chosen chosen{linear, selection, set, selection.score_of(set, now_.run.loss)};
        for (const std::size_t store : selection.stores(set)) {
            StoreCause cause{table_[store].name, table_[store].what, {}, 0.0, {}};
            for (std::size_t k = 0; k < set.size(); ++k) {
                const Seen& seen = seen_[static_cast<std::size_t>(set[k])];
                if (seen.store == store)
                    cause.numbers.push_back({seen.number->name, seen.number->unit, seen.start,
                                             seen.now, sigma[static_cast<Index>(k)]});
            }
            weigh(chosen, store, cause);
            out.causes.push_back(std::move(cause));
        }
        for (const Seen& seen : seen_) out.weighed.insert(seen.number->name);
        for (const std::size_t store : other_moves_)
            for (const StoredNumber& number : table_[store].numbers)
                out.weighed.insert(number.name);
        out.left_out = left_out(set);
        out.control = std::move(now_);
        return out;
    }
    /// Against the set without the store, and with each other one in its place.
    void weigh(const Chosen& chosen, std::size_t store, StoreCause& cause) const {
        const Selection& selection = chosen.selection;
        const NumberSet rest = selection.without(chosen.set, {store});
        cause.others = std::exp(std::min(0.0, selection.score(rest) - chosen.score));
        for (const std::size_t other : selection.all_stores()) {
            if (other == store) continue;
            const NumberSet instead = selection.with(rest, other);
            double behind =
                behind_by(chosen, instead, instead.empty() ? 0.0 : chosen.linear.loss(instead));
            if (behind >= rival_gap_ && may_do(chosen, rest, other))
                behind = std::min(behind, refitted(chosen, rest, other));
            cause.others += std::exp(-behind);
            if (behind < rival_gap_ && selection.stores(chosen.set).count(other) == 0)
                cause.rivals.push_back(table_[other].name);
        }
        // A store without a derivative (an empty length) is in no set that was compared.
        const std::set<std::size_t> compared = selection.all_stores();
        for (const std::size_t other : other_moves_) {
            if (other == store || compared.contains(other)) continue;
            const double behind = refitted(chosen, rest, other);
            cause.others += std::exp(-behind);
            if (behind < rival_gap_) cause.rivals.push_back(table_[other].name);
        }
    }
    double behind_by(const Chosen& chosen, const NumberSet& instead, double loss) const {
        if (instead.empty()) return std::numeric_limits<double>::infinity();
        return behind_by(chosen, chosen.selection.score_of(instead, loss), instead.size(), loss);
    }
    /// A set that leaves as little has an equal share, however many numbers its stores have.
    double behind_by(const Chosen& chosen, double score, std::size_t count, double loss) const {
        const double numbers = score_(loss, chosen.set.size()) - score_(loss, count);
        const double behind = chosen.score - score;
        const double same =
            score_(now_.run.loss, chosen.set.size()) - score_(loss, chosen.set.size());
        return std::max(0.0, std::abs(same) < equal_score ? behind - numbers : behind);
    }
    bool may_do(const Chosen& chosen, NumberSet set, std::size_t other) const {
        const double rest = chosen.linear.least(set);
        for (std::size_t k = 0; k < seen_.size(); ++k)
            if (seen_[k].store == other)
                set = Selection::added(std::move(set), static_cast<Index>(k));
        return rest - chosen.linear.least(set) > worth_a_fit * (rest - now_.run.loss);
    }
    /// The same through the control: far from the present run the derivatives are others.
    double refitted(const Chosen& chosen, const NumberSet& set, std::size_t other) const {
        FittedControl control{start_, {}};
        Numbers numbers;
        for (const Index k : set) {
            const Seen& seen = seen_[static_cast<std::size_t>(k)];
            numbers.push_back(seen.number);
            seen.number->in(control.setup) = seen.now;
        }
        control.run = comparer_.run(control.setup);
        StoreFit fit = fit_store(comparer_, control.setup, control.run, table_[other], blocks_);
        if (fit.numbers.empty()) return std::numeric_limits<double>::infinity();
        const std::size_t before = numbers.size();
        for (const StoredNumber& number : table_[other].numbers) {
            const auto is_fitted = [&](const FittedNumber& n) { return n.name == number.name; };
            if (std::any_of(fit.numbers.begin(), fit.numbers.end(), is_fitted) &&
                std::find(numbers.begin(), numbers.end(), &number) == numbers.end())
                numbers.push_back(&number);
        }
        control = {std::move(fit.setup), std::move(fit.run)};
        for (int k = 0; k < most_fits && improve(comparer_, numbers, control); ++k) {
        }
        std::set<std::size_t> stores = chosen.selection.stores(set);
        if (numbers.size() > before) stores.insert(other);
        const double score = score_(control.run.loss, numbers.size()) -
                             least_odds_ * static_cast<double>(stores.size());
        return behind_by(chosen, score, numbers.size(), control.run.loss);
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
    std::vector<double> left_out(const NumberSet& set) const {
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
    std::set<std::size_t>
        other_moves_;  ///< stores with a number whose every step makes other moves
};

}  // namespace

JointStores explained_together(const StoreQuestion& question, FittedControl now) {
    return Joint(question, std::move(now)).explain();
}

}  // namespace trunnion::choices
