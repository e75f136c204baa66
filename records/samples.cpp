// Velocity, direction of travel and distance since reversal, from positions and times alone.
#include <cmath>

#include "base/units.h"
#include "records/readings.h"

namespace trunnion {
namespace {

/// Positions are written with six decimals (mm or deg): less movement than this is none.
constexpr double rounding_mm = 1.5e-6;

double rounding(Axis axis) {
    return is_rotary(axis) ? rad_from_deg(rounding_mm) : rounding_mm;
}

signed char sign_of(double v, double tolerance) {
    return v > tolerance ? 1 : v < -tolerance ? -1 : 0;
}

using Rows = std::vector<std::size_t>;  // of one test, in order

std::map<std::string, Rows> rows_by_test(const ReadingTable& table) {
    std::map<std::string, Rows> tests;
    for (std::size_t i = 0; i < table.rows.size(); ++i) tests[table.rows[i].test].push_back(i);
    return tests;
}

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

/// One axis of one test.
class AxisHistory {
  public:
    AxisHistory(const ReadingTable& table, const Rows& rows, Axis axis,
                std::vector<AxisSample>& samples)
        : table_(table), rows_(rows), axis_(axis), samples_(samples) {}

    void fill() {
        fill_approach();
        for (std::size_t k = 0; k < rows_.size(); ++k)
            if (row(k).device == Device::ballbar) fill_velocity(k);
        fill_since_reversal();
    }

  private:
    const Reading& row(std::size_t k) const { return table_.rows[rows_[k]]; }
    double q(std::size_t k) const { return row(k).commanded[axis_]; }
    AxisSample& sample(std::size_t k) { return samples_[rows_[k]]; }
    signed char move(std::size_t k) const { return sign_of(q(k) - q(k - 1), rounding(axis_)); }

    void fill_approach() {
        signed char last = 0;
        for (std::size_t k = 1; k < rows_.size() && last == 0; ++k) last = move(k);
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (k > 0 && move(k) != 0) last = move(k);
            sample(k).travel[index_of(axis_)] = last;
        }
    }

    void fill_velocity(std::size_t k) {
        const std::size_t before = k == 0 ? k : k - 1;
        const std::size_t after = k + 1 == rows_.size() ? k : k + 1;
        const double time_s = row(after).time_s - row(before).time_s;
        const double moved = q(after) - q(before);
        const signed char sign =
            time_s > 0.0 ? sign_of(moved, rounding(axis_)) : static_cast<signed char>(0);
        sample(k).travel[index_of(axis_)] = sign;
        sample(k).velocity[axis_] = sign == 0 ? 0.0 : moved / time_s;
    }

    /// Where the axis turned: vertex of the parabola through rows k-1, k, k+1 of a reversal at k.
    double turning_point(std::size_t k) const {
        if (k == 0 || k + 1 >= rows_.size()) return q(k);
        const double a = q(k - 1) - q(k), b = q(k + 1) - q(k);
        const double curvature = a + b;
        if (curvature == 0.0) return q(k);
        return q(k) - (b - a) * (b - a) / (8.0 * curvature);
    }

    /// An axis that starts at its turning point (a circle begun at a quadrant) moves three times as
    /// far in the second step as in the first.
    bool starts_at_turn() const {
        if (rows_.size() < 3 || row(0).device != Device::ballbar) return false;
        const double first = q(1) - q(0), second = q(2) - q(1);
        return first * second > 0.0 && std::abs(first) < 0.5 * std::abs(second);
    }

    void fill_since_reversal() {
        double from = q(0);
        bool at_start = starts_at_turn(), turned = at_start;
        signed char direction = 0;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            const signed char step = k == 0 ? static_cast<signed char>(0) : move(k);
            if (step != 0 && direction != 0 && step != direction) {
                from = row(k).device == Device::ballbar ? turning_point(k - 1) : q(k - 1);
                turned = true;
                at_start = false;
                if (sample(k - 1).travel[index_of(axis_)] == step) {  // it turned before that row
                    sample(k - 1).since_reversal[index_of(axis_)] = std::abs(q(k - 1) - from);
                    sample(k - 1).run_up_unknown[index_of(axis_)] = false;
                }
            }
            if (step != 0) direction = step;
            sample(k).since_reversal[index_of(axis_)] =
                std::abs(q(k) - from) + (turned ? 0.0 : no_reversal_seen + 1.0);
            sample(k).run_up_unknown[index_of(axis_)] = at_start;
        }
    }

    const ReadingTable& table_;
    const Rows& rows_;
    Axis axis_;
    std::vector<AxisSample>& samples_;
};

}  // namespace

std::vector<AxisSample> samples_of(const ReadingTable& table) {
    std::vector<AxisSample> samples;
    samples.reserve(table.rows.size());
    for (const Reading& row : table.rows) samples.push_back(sample_of(row));
    for (const auto& [test, rows] : rows_by_test(table))
        for (const Axis axis : table.axes) AxisHistory(table, rows, axis, samples).fill();
    return samples;
}

}  // namespace trunnion
