#include "choices/gap_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "choices/folds.h"
#include "choices/joint_stores.h"
#include "choices/options_instead.h"
#include "choices/passed_stop.h"
#include "choices/row_fit.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t most_steps = 8;
constexpr double least_gain = 4.0;      ///< of the score: odds of 50 to 1
constexpr double least_shrink = 0.02;   ///< of the loss, on left-out rows
constexpr double rival_gap = 3.0;       ///< of the score: odds of 20 to 1
constexpr double clearly_wrong = 36.0;  ///< loss of an axis: no noise has it, whatever the mean is

/// Scores for one log.
class Scorer {
  public:
    Scorer(const LogView& log, const std::vector<int>& blocks, double alike) : alike_(alike) {
        const double axes = static_cast<double>(log.axes.size());
        terms_ = axes * static_cast<double>(log.rows.size());
        n_ = is_within_noise()
                 ? terms_ / alike_
                 : axes * static_cast<double>(std::set<int>(blocks.begin(), blocks.end()).size());
    }
    bool is_within_noise() const { return alike_ > 0.0; }
    double score(double loss, std::size_t numbers) const {
        const double fit = is_within_noise() ? loss / alike_ : n_ * misfit(loss / terms_);
        return -0.5 * fit - 0.5 * static_cast<double>(numbers) * std::log(n_ + 1.0);
    }
    /// Least decrease of the loss on left-out rows.
    double least_decrease(double loss) const {
        return is_within_noise() ? 2.0 * least_gain * alike_
                                 : std::max(0.0, least_shrink * (loss - terms_));
    }
    double noise_loss() const { return terms_; }
    /// How far a candidate is behind the best one; not at all if it leaves as little, however many
    /// numbers it has.
    double behind(const GapCandidate& c, const GapCandidate& best) const {
        const bool equal = std::abs(score(c.run.loss, 0) - score(best.run.loss, 0)) < equal_score;
        return equal ? 0.0 : best.score - c.score;
    }

  private:
    /// Of a mean loss, with one slope at 1: below it, few rows that are clearly wrong hide in the
    /// mean of many that are better than their noise.
    static double misfit(double mean) { return mean > 1.0 ? std::log(mean) : mean - 1.0; }

    double terms_ = 1.0, n_ = 1.0, alike_ = 0.0;
};

/// Losses with each fold evaluated with the change only if the other folds support it.
/// A change that affects one row only cannot be left out; it is evaluated on that row.
std::vector<double> decided_elsewhere(const std::vector<double>& before,
                                      const std::vector<double>& after,
                                      const std::vector<int>& blocks) {
    const std::vector<int> folds = folds_for(before, after, blocks);
    std::array<double, fold_count> gain{};
    double all = 0.0;
    int changed = 0;
    for (std::size_t row = 0; row < before.size(); ++row) {
        changed += is_changed(before[row], after[row]) ? 1 : 0;
        gain[static_cast<std::size_t>(folds[row])] += before[row] - after[row];
        all += before[row] - after[row];
    }
    if (changed < 2) return after;
    std::vector<double> out(before.size());
    for (std::size_t row = 0; row < before.size(); ++row) {
        const bool takes = all - gain[static_cast<std::size_t>(folds[row])] > 0.0;
        out[row] = takes ? after[row] : before[row];
    }
    return out;
}

class Searcher {
  public:
    explicit Searcher(const SearchQuestion& question)
        : comparer_(question.comparer),
          blocks_(question.blocks),
          used_(question.used),
          scorer_(comparer_.log(), blocks_, question.alike),
          options_(question.setup) {
        found_.setup = question.setup;
        found_.run = question.before;
        found_.left_out = question.before.losses;
    }

    GapSearch search(const std::function<void(const char*)>& watch) {
        for (std::size_t k = 0; k < most_steps && is_searched(); ++k) {
            if (watch) watch("choices of the control");
            candidates_.clear();
            unseen_.clear();
            add_choices();
            if (watch) watch("stores of the control");
            add_stores();
            if (k == 0) found_.unseen = unseen_;
            if (!take_best()) break;
        }
        weigh_options_instead();
        return std::move(found_);
    }

  private:
    /// A store that did as much in place of another one.
    struct Instead {
        std::string name;
        std::vector<FittedNumber> numbers;
        double odds;
    };
    bool is_searched() const {
        if (scorer_.is_within_noise() || found_.run.loss > scorer_.noise_loss()) return true;
        const double most = clearly_wrong * static_cast<double>(comparer_.log().axes.size());
        return std::any_of(found_.run.losses.begin(), found_.run.losses.end(),
                           [&](double loss) { return loss > most; });
    }
    void add(GapCandidate candidate) {
        candidate.score = scorer_.score(candidate.run.loss, candidate.numbers.size());
        candidates_.push_back(std::move(candidate));
    }
    void add_choices() {
        const SameWay same(comparer_, found_.setup, found_.run.path);
        for (const Choice& choice : choice_table()) {
            if (choice.holds(found_.setup)) continue;
            setup::Setup other = found_.setup;
            choice.take(other);
            std::optional<ControlPath> path = same.other(other);
            if (!path) {
                unseen_.push_back(choice.name());
                continue;
            }
            ComparedRun run = comparer_.compared(std::move(*path));
            if (run.loss >= found_.run.loss) continue;
            if (choice.rounds && is_rounding(comparer_.log(), found_.run, run.losses)) continue;
            std::vector<double> left_out =
                decided_elsewhere(found_.run.losses, run.losses, blocks_);
            add({choice.name(),
                 choice.what,
                 choice.take,
                 {},
                 std::move(run),
                 std::move(left_out),
                 0.0,
                 false});
        }
    }
    void add_stores() {
        for (const Store& store : store_table(found_.setup, used_)) {
            StoreFit fit = fit_store(comparer_, found_.setup, found_.run, store, blocks_);
            if (!fit.seen) unseen_.push_back(store.name);
            if (fit.numbers.empty()) continue;
            const auto take = [store, numbers = fit.numbers](setup::Setup& s) {
                enter(store, numbers, s);
            };
            add({store.name, store.what, take, fit.numbers, std::move(fit.run),
                 std::move(fit.left_out), 0.0, true});
        }
    }
    bool passes(const GapCandidate& c) const {
        return c.score > now() + least_gain &&
               found_.run.loss - sum_of(c.left_out) > scorer_.least_decrease(found_.run.loss);
    }
    double now() const { return scorer_.score(found_.run.loss, 0); }

    bool take_best() {
        GapCandidate* best = nullptr;
        for (GapCandidate& c : candidates_)
            if (passes(c) && (best == nullptr || c.score > best->score + equal_score)) best = &c;
        if (best == nullptr) return false;
        GapStep step;
        double others = std::exp(now() - best->score), options = 0.0;
        for (const GapCandidate& c : candidates_) {
            if (&c == best) continue;
            const double behind = scorer_.behind(c, *best), odds = std::exp(-behind);
            others += odds;
            const bool rival = behind < rival_gap;
            if (rival) step.rivals.push_back(c.name);
            if (c.store) {
                if (rival && found_.steps.empty())
                    stores_instead_[best->name].push_back({c.name, c.numbers, odds});
                continue;
            }
            options += odds;
            if (rival) options_instead_[best->name].push_back(c.name);
        }
        options_odds_[best->name] = options;
        step.probability = 1.0 / (1.0 + others);
        step.only_passes_stop = !best->store && only_goes_on(best->run);
        const double before = found_.run.loss;
        found_.left_out = best->left_out;
        best->take(found_.setup);
        found_.run = best->run;
        if (!best->store) best->take(options_);
        step.chosen = std::move(*best);
        found_.steps.push_back(std::move(step));
        weigh_stores_together();
        return found_.run.loss < before;  // else a further store was only for a foreign block
    }
    /// The present run ends in an alarm, and the rows before it do not ask for the other.
    bool only_goes_on(const ComparedRun& other) const {
        if (!found_.run.path.alarm) return false;
        const auto before = before_stop(comparer_, found_.run, other);
        if (!before) return false;
        const double rest = scorer_.noise_loss() * (1.0 - static_cast<double>(before->rows) /
                                                              static_cast<double>(blocks_.size()));
        return scorer_.score(before->other + rest, 0) <=
               scorer_.score(before->own + rest, 0) + least_gain;
    }
    /// Replaces the stores found one by one by those that explain most together.
    void weigh_stores_together() {
        const auto is_store = [](const GapStep& step) { return step.chosen.store; };
        if (std::none_of(found_.steps.begin(), found_.steps.end(), is_store)) return;
        const SetScore score = [this](double loss, std::size_t numbers) {
            return scorer_.score(loss, numbers);
        };
        JointStores joint =
            explained_together({comparer_, options_, blocks_, used_, score, least_gain, rival_gap},
                               {found_.setup, found_.run});
        std::erase_if(found_.steps, is_store);
        found_.setup = std::move(joint.control.setup);
        found_.run = std::move(joint.control.run);
        found_.left_out = std::move(joint.left_out);
        if (found_.steps.empty() && joint.causes.size() == 1)
            add_unseen_rivals(joint.weighed, joint.causes[0]);
        for (StoreCause& cause : joint.causes) found_.steps.push_back(step_of(std::move(cause)));
    }
    /// A store that this one overwrites (G10 L2 P0 X#501) has no derivative beside it, and did as
    /// much in its place.
    void add_unseen_rivals(const std::set<std::string>& weighed, StoreCause& cause) const {
        const auto instead = stores_instead_.find(cause.name);
        if (instead == stores_instead_.end()) return;
        for (const Instead& store : instead->second) {
            const bool all = std::all_of(
                store.numbers.begin(), store.numbers.end(),
                [&](const FittedNumber& number) { return weighed.contains(number.name); });
            if (all) continue;
            cause.rivals.push_back(store.name);
            cause.others += store.odds;
        }
    }
    /// Stores that came in one step were never weighed against options, nor those that came beside
    /// another one that was replaced since.
    void weigh_options_instead() {
        const std::vector<Store> table = store_table(found_.setup, used_);
        std::size_t count = 0;
        for (const GapStep& step : found_.steps) count += step.chosen.numbers.size();
        for (GapStep& step : found_.steps) {
            if (!step.chosen.store) continue;
            setup::Setup rest = options_;
            Numbers others;
            for (const GapStep& other : found_.steps) {
                if (&other == &step || !other.chosen.store) continue;
                other.chosen.take(rest);
                add_numbers(table, other.chosen.numbers, others);
            }
            for (const OptionInstead& option : options_instead({comparer_, rest, others}))
                weigh_instead(option, score_behind(option.loss, others.size(), count), step);
        }
    }
    static void add_numbers(const std::vector<Store>& table,
                            const std::vector<FittedNumber>& fitted, Numbers& out) {
        for (const Store& store : table)
            for (const StoredNumber& number : store.numbers)
                if (std::any_of(fitted.begin(), fitted.end(),
                                [&](const FittedNumber& f) { return f.name == number.name; }))
                    out.push_back(&number);
    }
    /// Of what was found, which has `count` numbers.
    double score_behind(double loss, std::size_t numbers, std::size_t count) const {
        const double own = found_.run.loss;
        const bool equal = std::abs(scorer_.score(loss, 0) - scorer_.score(own, 0)) < equal_score;
        return equal ? 0.0
                     : std::max(0.0, scorer_.score(own, count) - scorer_.score(loss, numbers));
    }
    static void weigh_instead(const OptionInstead& option, double behind, GapStep& step) {
        if (std::find(step.rivals.begin(), step.rivals.end(), option.name) != step.rivals.end())
            return;
        step.probability = 1.0 / (1.0 / step.probability + std::exp(-behind));
        if (behind < rival_gap) step.rivals.push_back(option.name);
    }
    GapStep step_of(StoreCause cause) {
        GapStep step;
        step.probability = 1.0 / (1.0 + cause.others + options_odds_[cause.name]);
        step.rivals = std::move(cause.rivals);
        const auto& options = options_instead_[cause.name];
        step.rivals.insert(step.rivals.end(), options.begin(), options.end());
        const auto take = [name = cause.name, numbers = cause.numbers,
                           used = used_](setup::Setup& s) {
            for (const Store& store : store_table(s, used))
                if (store.name == name) enter(store, numbers, s);
        };
        step.chosen = {std::move(cause.name),
                       std::move(cause.what),
                       take,
                       std::move(cause.numbers),
                       {},
                       {},
                       0.0,
                       true};
        return step;
    }
    static void enter(const Store& store, const std::vector<FittedNumber>& numbers,
                      setup::Setup& setup) {
        for (const StoredNumber& number : store.numbers)
            for (const FittedNumber& fitted : numbers)
                if (fitted.name == number.name) number.in(setup) = fitted.to;
    }

    const Comparer& comparer_;
    const std::vector<int>& blocks_;
    const ProgramStores& used_;
    Scorer scorer_;
    setup::Setup options_;  ///< with the options found, and the stores of the start
    GapSearch found_;
    std::map<std::string, double> options_odds_;  ///< of options instead of a store
    std::map<std::string, std::vector<std::string>> options_instead_;
    /// Of the first one.
    std::map<std::string, std::vector<Instead>> stores_instead_;
    std::vector<GapCandidate> candidates_;
    std::vector<std::string> unseen_;
};

}  // namespace

GapSearch search_causes(const SearchQuestion& question,
                        const std::function<void(const char*)>& watch) {
    return Searcher(question).search(watch);
}

}  // namespace trunnion::choices
