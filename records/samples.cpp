#include "records/samples.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <optional>

#include "records/passes.h"
#include "records/smoothed_motion.h"

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

signed char sign_of(double moved, double rounding) {
    return moved > rounding ? 1 : moved < -rounding ? -1 : 0;
}

Vector3 linear_position(const Reading& row) {
    return {row.commanded[Axis::X], row.commanded[Axis::Y], row.commanded[Axis::Z]};
}

/// Rows of one pass whose differences are velocities.
class Pass {
  public:
    Pass(std::span<const Reading> all, const PassRows& rows, const AxisNames& names)
        : all_(all), rows_(rows), names_(names) {}

    void fill(const std::vector<Axis>& axes, std::vector<AxisSample>& samples) const {
        double path_mm = 0.0;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            AxisSample& sample = samples[rows_[k]];
            if (k > 0) path_mm += arc_mm(k);
            sample.path_mm = path_mm;
            if (!is_continuous(row(k).device)) continue;
            const Neighbours around = neighbours(k);
            for (const Axis axis : axes) fill_velocity(k, around, axis, sample);
            fill_curvature(k, axes, sample);
            take_told(row(k), sample);
        }
    }

    /// Adds what the time constant of the axis's drive makes of the motion.
    void smooth(Axis axis, double time_constant_s, std::vector<AxisSample>& samples) const {
        const std::vector<Vector3> motion = smoothed(axis, time_constant_s);
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (!is_continuous(row(k).device)) continue;
            AxisSample& sample = samples[rows_[k]];
            const Vector3 own(sample.velocity[axis], sample.acceleration[axis], sample.jerk[axis]);
            const bool told = row(k).smoothing && names_.find(row(k).feature) == axis;
            const Vector3 more = (told ? *row(k).smoothing : motion[k]) - own;
            sample.smooth_velocity[axis] = more.x();
            sample.smooth_acceleration[axis] = more.y();
            sample.smooth_jerk[axis] = more.z();
        }
    }

    /// The motion of an axis at each row of the pass behind the time constant of its drive.
    std::vector<Vector3> smoothed(Axis axis, double time_constant_s) const {
        const CommandedPath path = commanded_path(all_, rows_, axis, names_);
        const std::vector<Vector3> motion = smoothed_motion(path, time_constant_s);
        std::vector<Vector3> of_rows;
        for (const std::size_t k : path.at) of_rows.push_back(motion[k]);
        return of_rows;
    }

    /// The commanded motion of an axis at row k: velocity, acceleration and jerk.
    Vector3 motion(std::size_t k, Axis axis) const {
        AxisSample sample;
        fill_velocity(k, neighbours(k), axis, sample);
        fill_curvature(k, {axis}, sample);
        take_told(row(k), sample);
        return {sample.velocity[axis], sample.acceleration[axis], sample.jerk[axis]};
    }

  private:
    const Reading& row(std::size_t k) const { return all_[rows_[k]]; }
    double q(std::size_t k, Axis axis) const { return row(k).commanded[axis]; }

    struct Neighbours {
        std::size_t before, after;
    };

    /// The nearest rows before and after row k at other times: a servo log has one row for each
    /// axis.
    Neighbours neighbours(std::size_t k) const {
        std::size_t before = k, after = k;
        while (before > 0 && row(before).time_s == row(k).time_s) --before;
        while (after + 1 < rows_.size() && row(after).time_s == row(k).time_s) ++after;
        return {before, after};
    }

    void fill_velocity(std::size_t k, const Neighbours& around, Axis axis,
                       AxisSample& sample) const {
        const double time_s = row(around.after).time_s - row(around.before).time_s;
        const double moved = q(around.after, axis) - q(around.before, axis);
        const double rounding = names_.is_rotary(axis) ? rows_rounding.rad : rows_rounding.mm;
        const signed char sign =
            time_s > 0.0 ? sign_of(moved, rounding) : static_cast<signed char>(0);
        const bool moves = sign_of(q(around.after, axis) - q(k, axis), rounding) != 0;
        if (sign != 0 || moves) sample.travel[index_of(axis)] = sign;
        if (sign == 0) return;
        sample.velocity[axis] = moved / time_s;
    }

    using Moments = std::array<std::size_t, 5>;

    /// Five rows at different times around row k, row k first; empty when the test has fewer.
    std::optional<Moments> moments(std::size_t k) const {
        Moments list{k};
        std::size_t first = k, last = k;
        for (std::size_t i = 1; i < list.size(); ++i) {
            const std::size_t before = neighbours(first).before, after = neighbours(last).after;
            if (before == first && after == last) return std::nullopt;
            const bool back = (i % 2 == 1 && before != first) || after == last;
            list[i] = back ? (first = before) : (last = after);
        }
        return list;
    }

    /// Second and third derivatives at row k from cubics through the neighbouring rows.
    void fill_curvature(std::size_t k, const std::vector<Axis>& axes, AxisSample& sample) const {
        const std::optional<Moments> around = moments(k);
        if (!around) return;
        Eigen::Matrix<double, 5, 4> a;
        for (std::size_t j = 0; j < around->size(); ++j) {
            const double t = row((*around)[j]).time_s - row(k).time_s;
            a.row(static_cast<Eigen::Index>(j)) << 1.0, t, t * t / 2.0, t * t * t / 6.0;
        }
        const Eigen::LDLT<Eigen::Matrix4d> normal(a.transpose() * a);
        for (const Axis axis : axes) {
            Eigen::Matrix<double, 5, 1> moved;
            for (std::size_t j = 0; j < around->size(); ++j)
                moved(static_cast<Eigen::Index>(j)) = q((*around)[j], axis) - q(k, axis);
            if (moved.isZero(0.0)) continue;
            const Eigen::Vector4d fit = normal.solve(a.transpose() * moved);
            if (!fit.allFinite()) continue;
            sample.acceleration[axis] = fit(2);
            sample.jerk[axis] = fit(3);
        }
    }

    /// Commanded motion given in the row itself replaces differences.
    void take_told(const Reading& reading, AxisSample& sample) const {
        if (reading.device != Device::axis) return;
        const auto axis = names_.find(reading.feature);
        if (!axis) return;
        if (reading.velocity_mm_s) {
            const double v = *reading.velocity_mm_s;
            sample.velocity[*axis] = v;
            if (v != 0.0) sample.travel[index_of(*axis)] = v > 0.0 ? 1 : -1;
        }
        if (reading.acceleration_mm_s2) sample.acceleration[*axis] = *reading.acceleration_mm_s2;
    }

    /// Path length from row k - 1 to row k along the arc through three rows, not along the chord.
    double arc_mm(std::size_t k) const {
        const Vector3 a = linear_position(row(k - 1)), b = linear_position(row(k));
        const double chord = (b - a).norm();
        if (rows_.size() < 3) return chord;
        const Vector3 c = linear_position(row(k + 1 < rows_.size() ? k + 1 : k - 2));
        const double area = (b - a).cross(c - a).norm();
        if (area < 1e-9) return chord;
        const double radius = chord * (c - a).norm() * (c - b).norm() / (2.0 * area);
        return chord < 1.4 * radius ? 2.0 * radius * std::asin(chord / (2.0 * radius)) : chord;
    }

    std::span<const Reading> all_;
    const PassRows& rows_;
    const AxisNames& names_;
};

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
    Walk(std::span<const Reading> rows, TravelHistory history) : rows_(rows), history_(history) {}

    std::vector<AxisSample> samples() {
        samples_.reserve(rows_.size());
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
        samples_.push_back(sample_of(rows_[k]));
        history_.describe(samples_.back());
    }

    /// The axis reversed before the last row, so it did not continue to that row.
    void look_back(std::size_t k, const AxisPositions& turned_at) {
        for (std::size_t i = 0; i < axis_count; ++i) {
            const double from = rows_[k - 2].commanded.value[i], at = rows_[k].commanded.value[i];
            if (!history_.just_turned(i) || (at - from) * history_.travel()[i] <= 0.0) continue;
            samples_[k - 1].since_reversal[i] =
                std::abs(rows_[k - 1].commanded.value[i] - turned_at.value[i]);
            samples_[k - 1].run_up_unknown[i] = false;
        }
    }

    std::span<const Reading> rows_;
    TravelHistory history_;
    std::vector<AxisSample> samples_;
};

/// Sides before the first row: from the file head, for its first session.
AxisSides sides_before(const ReadingTable& table, std::size_t begin) {
    if (begin == 0) return table.side_before;
    const auto known = table.part_sides.find(table.rows[begin].part);
    const bool first = table.rows[begin - 1].part != table.rows[begin].part;
    return first && known != table.part_sides.end() ? known->second : AxisSides{};
}

}  // namespace

bool is_continuous(Device device) {
    return device == Device::ballbar || device == Device::axis;
}

bool way_unknown(const Reading& from, const Reading& to) {
    return from.device != Device::none && from.test != to.test;
}

std::vector<AxisSample> samples_of(std::span<const Reading> rows, const std::vector<Axis>& axes,
                                   TravelHistory history, const AxisNames& names,
                                   const TimeConstants& constants) {
    std::vector<AxisSample> samples = Walk(rows, history).samples();
    for (AxisSample& sample : samples)
        for (const Axis axis : axes)
            sample.side_unknown[index_of(axis)] = sample.travel[index_of(axis)] == 0;
    for (const PassRows& list : passes_of(rows)) {
        const Pass pass(rows, list, names);
        pass.fill(axes, samples);
        for (const Axis axis : axes)
            if (const double seconds = constants[index_of(axis)]; seconds > 0.0)
                pass.smooth(axis, seconds, samples);
    }
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (const Axis axis : axes)
            if (samples[k].velocity[axis] != 0.0) samples[k].side_unknown[index_of(axis)] = false;
    return samples;
}

std::vector<AxisSample> samples_of(const ReadingTable& table, const TimeConstants& constants) {
    std::vector<AxisSample> samples;
    const std::span<const Reading> rows(table.rows);
    for (std::size_t begin = 0; begin < rows.size();) {
        const std::size_t end = session_end(table.rows, begin);
        const TravelHistory history(sides_before(table, begin), rows_rounding, table.names);
        auto part = samples_of(rows.subspan(begin, end - begin), table.axes, history, table.names,
                               constants);
        if (end - begin == rows.size()) return part;
        samples.insert(samples.end(), part.begin(), part.end());
        begin = end;
    }
    return samples;
}

std::vector<LoggedMotion> logged_motion(const ReadingTable& table, const TimeConstants& constants) {
    std::vector<LoggedMotion> list(table.rows.size());
    const auto axis_of = [&](std::size_t i) {
        const Reading& row = table.rows[i];
        return row.device == Device::axis ? table.names.find(row.feature) : std::nullopt;
    };
    for (const PassRows& rows : passes_of(table)) {
        const Pass pass(table.rows, rows, table.names);
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (const auto axis = axis_of(rows[k])) list[rows[k]].motion = pass.motion(k, *axis);
        for (const Axis axis : table.axes) {
            const double seconds = constants[index_of(axis)];
            if (seconds <= 0.0) continue;
            const std::vector<Vector3> smoothed = pass.smoothed(axis, seconds);
            for (std::size_t k = 0; k < rows.size(); ++k)
                if (axis_of(rows[k]) == axis) list[rows[k]].smoothed = smoothed[k];
        }
    }
    return list;
}

std::vector<CommandedPath> logged_paths(const ReadingTable& table, Axis axis) {
    std::vector<CommandedPath> paths;
    for (const PassRows& pass : passes_of(table)) {
        paths.push_back(commanded_path(table.rows, pass, axis, table.names));
        paths.back().rows = pass;
    }
    return paths;
}

}  // namespace trunnion::records
