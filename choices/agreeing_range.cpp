#include "choices/agreeing_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trunnion::choices {

namespace {

constexpr double three_sigmas = 9.0;  ///< of the loss: a value differs from the present one
constexpr int halvings = 6;           ///< of the last step
constexpr double wider = 4.0;         ///< sigmas of a number: a range that is no noise
constexpr double least_step = 0.001;  ///< mm or deg
constexpr double least_told = 0.02;   ///< mm or deg: width of a range that is worth a note

class Range {
  public:
    Range(const Comparer& comparer, const FittedControl& control, const StoredNumber& number)
        : comparer_(comparer),
          control_(control),
          number_(number),
          value_(value_of(control.setup, number)),
          most_(control.run.loss + three_sigmas * scale_of(comparer, control.run.loss)) {}

    AgreeingRange around(double step) const {
        const double low = reach(-1.0, step), high = reach(1.0, step);
        const bool no_less = low <= std::max(number_.least, value_ - most_searched);
        return {low, high, no_less && high >= value_ + most_searched};
    }

  private:
    bool agrees(double value) const {
        setup::Setup other = control_.setup;
        number_.in(other) = value;
        return comparer_.run(other).loss <= most_;
    }
    /// The farthest value to one side that agrees, and all before it.
    double reach(double side, double step) const {
        const double end =
            side > 0.0 ? value_ + most_searched : std::max(number_.least, value_ - most_searched);
        double last = value_, far = value_;
        for (double by = step; last != end; by *= 2.0) {
            far = side > 0.0 ? std::min(end, value_ + by) : std::max(end, value_ - by);
            if (!agrees(far)) break;
            last = far;
        }
        if (last == value_ || last == end) return last;
        for (int k = 0; k < halvings; ++k) {
            const double middle = 0.5 * (last + far);
            (agrees(middle) ? last : far) = middle;
        }
        return last;
    }

    const Comparer& comparer_;
    const FittedControl& control_;
    const StoredNumber& number_;
    double value_, most_;
};

const StoredNumber* number_of(const std::vector<Store>& table, const std::string& name) {
    for (const Store& store : table)
        for (const StoredNumber& number : store.numbers)
            if (number.name == name) return &number;
    return nullptr;
}

}  // namespace

AgreeingRange agreeing_range(const Comparer& comparer, const FittedControl& control,
                             const StoredNumber& number, double step) {
    return Range(comparer, control, number).around(step);
}

void settle_in_ranges(const SearchQuestion& question, GapSearch& found) {
    const std::vector<Store> table = store_table(found.setup, question.used);
    for (GapStep& step : found.steps) {
        bool is_wide = false;
        for (FittedNumber& fitted : step.chosen.numbers) {
            const StoredNumber* number = number_of(table, fitted.name);
            // A way that is 0 or more is that of a cycle; samples need not show its end.
            if (number == nullptr || number->least < 0.0) continue;
            const double first = std::max(wider * fitted.sigma, least_step);
            const FittedControl now{found.setup, found.run};
            const AgreeingRange range = agreeing_range(question.comparer, now, *number, first);
            if (range.high - range.low < first) continue;
            is_wide = true;
            fitted.to = 0.5 * (range.low + range.high);
            fitted.sigma = (range.high - range.low) / std::sqrt(12.0);
            number->in(found.setup) = fitted.to;
            found.run = question.comparer.run(found.setup);
        }
        if (!is_wide) continue;
        step.chosen.take = [numbers = step.chosen.numbers, used = question.used](setup::Setup& s) {
            const std::vector<Store> stores = store_table(s, used);
            for (const FittedNumber& fitted : numbers)
                if (const StoredNumber* number = number_of(stores, fitted.name))
                    number->in(s) = fitted.to;
        };
    }
}

std::vector<std::string> tell_ranges(const Comparer& comparer, const FittedControl& control,
                                     std::vector<std::string>& notes) {
    std::vector<std::string> unseen;
    for (const Store& store : store_table(control.setup)) {
        if (store.name != "5114" && store.name != "5115") continue;
        const StoredNumber& number = store.numbers.front();
        setup::Setup other = control.setup;
        number.in(other) += least_told;
        if (same_way(comparer.path(other), control.run.path)) continue;  // no such cycle
        const double value = value_of(control.setup, number);
        const AgreeingRange range = agreeing_range(comparer, control, number, least_told);
        if (range.anything) {
            unseen.push_back(store.name);
            notes.push_back(
                fmt::format("{} ({}, here {:.4g} mm) is not tested: this log shows "
                            "nothing of it",
                            store.name, store.what, value));
        } else if (range.high - range.low >= least_told) {
            notes.push_back(
                fmt::format("{} ({}, here {:.4g} mm): this log agrees with {:.3f} to "
                            "{:.3f} mm",
                            store.name, store.what, value, range.low, range.high));
        }
    }
    return unseen;
}

}  // namespace trunnion::choices
