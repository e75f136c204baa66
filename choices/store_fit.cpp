#include "choices/store_fit.h"

#include <algorithm>
#include <cmath>

#include "choices/far_starts.h"
#include "choices/folds.h"
#include "choices/store_columns.h"

namespace trunnion::choices {

namespace {

using Eigen::VectorXd;

constexpr double least_part = 1e-3;  ///< of the loss: minimum reduction by another number
constexpr int most_rounds = 25;
constexpr double explains = 0.05;  ///< of the loss: most that stays where no other start is tried

class Fitter {
  public:
    Fitter(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
           const Store& store)
        : comparer_(comparer), start_(setup), before_(before), now_{setup, before} {
        for (const StoredNumber& number : store.numbers) all_.push_back(&number);
        seen_ = all_;
    }

    StoreFit fit(const std::vector<int>& blocks) {
        StoreFit out;
        columns_ = keep_seen();
        out.seen = !seen_.empty() || !other_moves_.empty();
        add_numbers();
        if (now_.run.loss > explains * before_.loss) begin_elsewhere();
        return told(std::move(out), blocks);
    }

  private:
    void add_numbers() {
        while (numbers_.size() < seen_.size() && add_number()) {
            for (int round = 1; round < most_rounds && improve(comparer_, numbers_, now_);
                 ++round) {
            }
            columns_ = columns(seen_);
            if (columns_.size() != seen_.size()) break;
        }
    }
    /// From the other values that a number may have; the best fit stays.
    void begin_elsewhere() {
        const FittedControl begun{start_, before_};
        const FarStarts starts(comparer_, begun);
        for (const StoredNumber* number : other_moves_) try_all(starts.of(*number, false));
        try_all(starts.of_vacant(all_));
        for (const StoredNumber* number : Numbers(seen_)) try_all(starts.of(*number, true));
    }
    void try_all(std::vector<FarStart> starts) {
        for (FarStart& start : starts) {
            Fitter other(comparer_, start_, before_, std::move(start), all_);
            if (other.now_.run.loss < (1.0 - least_part) * now_.run.loss) take(std::move(other));
        }
    }
    void take(Fitter&& other) {
        now_ = std::move(other.now_);
        seen_ = std::move(other.seen_);
        numbers_ = std::move(other.numbers_);
        columns_ = std::move(other.columns_);
    }
    /// Fitted from another value of a number.
    Fitter(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
           FarStart start, const Numbers& all)
        : comparer_(comparer),
          start_(setup),
          before_(before),
          now_(std::move(start.control)),
          all_(all),
          seen_(all),
          numbers_{start.number} {
        while (improve(comparer_, numbers_, now_)) {
        }
        columns_ = keep_seen();
        if (std::find(seen_.begin(), seen_.end(), start.number) != seen_.end()) add_numbers();
    }
    StoreFit told(StoreFit out, const std::vector<int>& blocks) {
        if (numbers_.empty()) return out;
        columns_ = columns(numbers_);
        if (columns_.size() != numbers_.size()) return out;
        tell(out);
        out.left_out = left_out_losses(comparer_, now_.run, columns_, way_back(),
                                       folds_for(before_.losses, now_.run.losses, blocks));
        out.setup = std::move(now_.setup);
        out.run = std::move(now_.run);
        return out;
    }

    std::vector<Column> columns(const Numbers& numbers) const {
        return columns_of(comparer_, now_.setup, now_.run, numbers);
    }
    /// Keeps in `seen_` the numbers that the path depends on, and returns their columns.
    std::vector<Column> keep_seen() {
        Numbers seen;
        std::vector<Column> out;
        for (const StoredNumber* number : seen_) {
            bool other_moves = false;
            auto column = column_of(comparer_, now_.setup, now_.run, *number, &other_moves);
            if (other_moves) other_moves_.push_back(number);
            if (!column) continue;
            out.push_back(std::move(*column));
            seen.push_back(number);
        }
        seen_ = std::move(seen);
        return out;
    }
    Normal whole() const { return normal_of(comparer_, now_.run, columns_); }
    /// `columns_` are those of `seen_`. Adds the number that, fitted together with those already
    /// included, reduces the loss most, if it is significant; false if there is none.
    bool add_number() {
        const Normal all = whole();
        std::vector<Eigen::Index> in;
        for (const StoredNumber* number : numbers_) in.push_back(place_of(number));
        Eigen::Index best = -1;
        double most = least_part * now_.run.loss;
        for (Eigen::Index k = 0; k < all.right.size(); ++k) {
            if (std::find(in.begin(), in.end(), k) != in.end()) continue;
            const double gain = gain_with(all, in, k);
            if (gain <= most) continue;
            most = gain;
            best = k;
        }
        if (best < 0) return false;
        numbers_.push_back(seen_[static_cast<std::size_t>(best)]);
        in.push_back(best);
        const VectorXd none = VectorXd::Zero(static_cast<Eigen::Index>(in.size()));
        if (take_step(comparer_, numbers_, solved(part_of(all, in), none), now_)) return true;
        numbers_.pop_back();
        return false;
    }
    Eigen::Index place_of(const StoredNumber* number) const {
        return std::find(seen_.begin(), seen_.end(), number) - seen_.begin();
    }
    /// Loss removed by number `k` beside those included; 0 if it is not significant.
    double gain_with(const Normal& all, std::vector<Eigen::Index> in, Eigen::Index k) const {
        in.push_back(k);
        const Normal normal = part_of(all, in);
        const Eigen::Index last = normal.right.size() - 1;
        const VectorXd x = solved(normal, VectorXd::Zero(last + 1));
        const double gain = normal.right.dot(x);
        const double sigma =
            sigmas(normal, scale_of(comparer_, std::max(0.0, now_.run.loss - gain)))[last];
        const bool stands_out =
            std::abs(x[last]) > std::max(least_change_of(comparer_.log()), least_sigmas * sigma);
        return stands_out ? gain : 0.0;
    }
    void tell(StoreFit& out) const {
        const VectorXd s = sigmas(whole(), scale_of(comparer_, now_.run.loss));
        for (std::size_t k = 0; k < numbers_.size(); ++k) {
            const StoredNumber& number = *numbers_[k];
            const double from = value_of(start_, number), to = value_of(now_.setup, number);
            if (std::abs(to - from) > least_change_of(comparer_.log()) || is_vacant(start_, number))
                out.numbers.push_back(
                    {number.name, number.unit, from, to, s[static_cast<Eigen::Index>(k)]});
        }
    }
    /// From the fitted numbers to those of the start.
    VectorXd way_back() const {
        VectorXd back(static_cast<Eigen::Index>(numbers_.size()));
        for (std::size_t k = 0; k < numbers_.size(); ++k)
            back[static_cast<Eigen::Index>(k)] =
                value_of(start_, *numbers_[k]) - value_of(now_.setup, *numbers_[k]);
        return back;
    }

    const Comparer& comparer_;
    const setup::Setup& start_;
    const ComparedRun& before_;
    FittedControl now_;
    Numbers all_;
    Numbers seen_, numbers_;  ///< numbers that the path depends on, and those of them that are
                              ///< fitted
    Numbers other_moves_;     ///< those of which every step makes other moves
    std::vector<Column> columns_;
};

}  // namespace

StoreFit fit_store(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
                   const Store& store, const std::vector<int>& blocks) {
    return Fitter(comparer, setup, before, store).fit(blocks);
}

}  // namespace trunnion::choices
