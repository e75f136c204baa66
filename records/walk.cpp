#include "records/walk.h"

#include <cmath>

#include "records/samples.h"

namespace trunnion::records {
namespace {

AxisSample sample_of(const Reading& row) {
    AxisSample sample;
    sample.position = row.commanded;
    sample.time_s = row.time_s;
    sample.feed_mm_min = row.feed_mm_min;
    sample.spindle_rad = row.spindle_rad;
    sample.temperature_c = row.temperature_c;
    sample.load_kg = row.load_kg;
    sample.clamped = row.clamped;
    sample.mode = row.mode;
    return sample;
}

bool dense(const Reading& a, const Reading& b) {
    return a.device == Device::ballbar && b.device == Device::ballbar && a.test == b.test;
}

/// Reversal point of each axis that reversed at row k: vertex of the parabola through its
/// neighbours.
AxisPositions turning_points(std::span<const Reading> rows, std::size_t k) {
    AxisPositions at = rows[k].commanded;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double a = rows[k - 1].commanded.value[i] - at.value[i],
                     b = rows[k + 1].commanded.value[i] - at.value[i];
        if (a + b != 0.0) at.value[i] -= (b - a) * (b - a) / (8.0 * (a + b));
    }
    return at;
}

/// An axis that starts at its reversal point (a circle started at a quadrant) moves three times as
/// far in the second step as in the first.
void assume_turns(std::span<const Reading> rows, std::size_t k, TravelHistory& history) {
    if (k + 2 >= rows.size() || !dense(rows[k], rows[k + 1]) || !dense(rows[k], rows[k + 2]))
        return;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double first = rows[k + 1].commanded.value[i] - rows[k].commanded.value[i],
                     second = rows[k + 2].commanded.value[i] - rows[k + 1].commanded.value[i];
        if (first * second > 0.0 && std::abs(first) < 0.5 * std::abs(second))
            history.assume_turned(i);
    }
}

/// Processes the rows in order through the history.
class Walk {
  public:
    Walk(std::span<const Reading> rows, TravelHistory history, const Chosen& chosen)
        : rows_(rows), history_(history), chosen_(chosen), samples_(chosen.count()) {}

    std::vector<AxisSample> samples() {
        for (std::size_t k = 0; k < rows_.size(); ++k) step(k);
        return std::move(samples_);
    }

  private:
    void step(std::size_t k) {
        const bool begins = k == 0 ? history_.begun() : way_unknown(rows_[k - 1], rows_[k]);
        if (k > 1 && dense(rows_[k - 2], rows_[k - 1]) && dense(rows_[k - 1], rows_[k])) {
            const AxisPositions turned_at = turning_points(rows_, k - 1);
            history_.advance(rows_[k].commanded, &turned_at);
            look_back(k, turned_at);
        } else {
            history_.advance(rows_[k].commanded);
        }
        if (begins) history_.begin_anew();
        if (begins) assume_turns(rows_, k, history_);
        if (!chosen_.has(k)) return;
        AxisSample& sample = samples_[chosen_.place_of(k)];
        sample = sample_of(rows_[k]);
        history_.describe(sample);
    }

    /// The axis reversed before the last row, so it did not continue to that row.
    void look_back(std::size_t k, const AxisPositions& turned_at) {
        if (!chosen_.has(k - 1)) return;
        AxisSample& last = samples_[chosen_.place_of(k - 1)];
        for (std::size_t i = 0; i < axis_count; ++i) {
            const double from = rows_[k - 2].commanded.value[i], at = rows_[k].commanded.value[i];
            if (!history_.just_turned(i) || (at - from) * history_.travel()[i] <= 0.0) continue;
            last.since_reversal[i] = std::abs(rows_[k - 1].commanded.value[i] - turned_at.value[i]);
            last.run_up_unknown[i] = false;
        }
    }

    std::span<const Reading> rows_;
    TravelHistory history_;
    const Chosen& chosen_;
    std::vector<AxisSample> samples_;
};

}  // namespace

bool way_unknown(const Reading& from, const Reading& to) {
    return from.device != Device::none && from.test != to.test;
}

std::vector<AxisSample> walked(std::span<const Reading> rows, const TravelHistory& history,
                               const Chosen& chosen) {
    return Walk(rows, history, chosen).samples();
}

}  // namespace trunnion::records
