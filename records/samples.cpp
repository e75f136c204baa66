#include "records/samples.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <optional>

#include "records/passes.h"
#include "records/smoothed_motion.h"
#include "records/walk.h"

namespace trunnion::records {
namespace {

signed char sign_of(double moved, double rounding) {
    return moved > rounding ? 1 : moved < -rounding ? -1 : 0;
}

Vector3 linear_position(const Reading& row) {
    return {row.commanded[Axis::X], row.commanded[Axis::Y], row.commanded[Axis::Z]};
}

/// What the row was among the rows of a longer table. The side of an axis at rest is that of the
/// present table, because it may be assumed anew.
void take_among_all(const Reading& row, AxisSample& sample) {
    const AxisSample& all = *row.among_all;
    sample.since_reversal = all.since_reversal;
    if (row.device != Device::ballbar) return;
    sample.run_up_unknown = all.run_up_unknown;
    sample.velocity = all.velocity;
    sample.acceleration = all.acceleration;
    sample.jerk = all.jerk;
    sample.path_mm = all.path_mm;
    for (std::size_t i = 0; i < axis_count; ++i)
        if (all.velocity.value[i] != 0.0 || all.acceleration.value[i] != 0.0)
            sample.travel[i] = all.travel[i];
}

/// Rows of one pass whose differences are velocities.
class Pass {
  public:
    Pass(std::span<const Reading> all, const PassRows& rows, const AxisNames& names)
        : all_(all), rows_(rows), names_(names), stops_(is_log_of_stops()) {}

    void fill(const std::vector<Axis>& axes, const Chosen& chosen,
              std::vector<AxisSample>& samples) const {
        double path_mm = 0.0;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (k > 0) path_mm += arc_mm(k);
            if (!chosen.has(rows_[k])) continue;
            AxisSample& sample = samples[chosen.place_of(rows_[k])];
            sample.path_mm = path_mm;
            if (!is_continuous(row(k).device)) continue;
            const Neighbours around = neighbours(k);
            for (const Axis axis : axes) fill_velocity(k, around, axis, sample);
            fill_curvature(k, axes, sample);
            take_told(row(k), sample);
            if (row(k).among_all) take_among_all(row(k), sample);
        }
    }

    /// Adds what the time constant `time_constant_s` of the axis's drive makes of the motion.
    void smooth(Axis axis, double time_constant_s, const Chosen& chosen,
                std::vector<AxisSample>& samples) const {
        const std::vector<Vector3> motion = smoothed(axis, time_constant_s);
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (!is_continuous(row(k).device) || !chosen.has(rows_[k])) continue;
            AxisSample& sample = samples[chosen.place_of(rows_[k])];
            if (smooth_among_all(row(k), axis, sample)) continue;
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
    /// True when the row was chosen from a longer table behind the same drives.
    static bool smooth_among_all(const Reading& row, Axis axis, AxisSample& sample) {
        if (!row.among_all || row.device != Device::ballbar) return false;
        const AxisSample& all = *row.among_all;
        sample.smooth_velocity[axis] = all.smooth_velocity[axis];
        sample.smooth_acceleration[axis] = all.smooth_acceleration[axis];
        sample.smooth_jerk[axis] = all.smooth_jerk[axis];
        return all.smooth_velocity[axis] != 0.0 || all.smooth_acceleration[axis] != 0.0;
    }

    const Reading& row(std::size_t k) const { return all_[rows_[k]]; }
    double q(std::size_t k, Axis axis) const { return row(k).commanded[axis]; }

    /// True for a log of settled positions: at a quarter of its rows or more the axis came from one
    /// side and the next row lies on that side, too. Differences of such rows are no velocities,
    /// and its rows stand. In a dense log few rows are turning points.
    bool is_log_of_stops() const {
        constexpr std::size_t least_part = 4;  // one in so many rows (assumed)
        std::size_t count = 0, turned = 0;
        AxisSides came{};
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            const Reading& reading = row(k);
            if (reading.device != Device::axis || reading.among_all || reading.velocity_mm_s)
                continue;
            const auto axis = names_.find(reading.feature);
            if (!axis) continue;
            const double rounding = names_.is_rotary(*axis) ? rows_rounding.rad : rows_rounding.mm;
            const Neighbours around = neighbours(k);
            signed char& side = came[index_of(*axis)];
            if (const signed char last = sign_of(q(k, *axis) - q(around.before, *axis), rounding);
                last != 0)
                side = last;
            const signed char next = sign_of(q(around.after, *axis) - q(k, *axis), rounding);
            ++count;
            if (side != 0 && next == -side) ++turned;
        }
        return turned * least_part > count;
    }

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
        if (stops_ && row(k).device == Device::axis) return;
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
        if (stops_ && row(k).device == Device::axis) return;
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
    bool stops_;  ///< a log of settled positions
};

/// Sides before the first row: from the file head, for its first session.
AxisSides sides_before(const ReadingTable& table, std::size_t begin) {
    if (begin == 0) return table.side_before;
    const auto known = table.part_sides.find(table.rows[begin].part);
    const bool first = table.rows[begin - 1].part != table.rows[begin].part;
    return first && known != table.part_sides.end() ? known->second : AxisSides{};
}

/// The table's axes, their names, and the time constants of their drives.
struct AxesOfRows {
    const std::vector<Axis>& axes;
    const AxisNames& names;
    const TimeConstants& constants;
};

/// The samples of the chosen ones of `rows`, which are of one session and continue `history`.
std::vector<AxisSample> samples_in(std::span<const Reading> rows, const AxesOfRows& of,
                                   const TravelHistory& history, const Chosen& chosen) {
    std::vector<AxisSample> samples = walked(rows, history, chosen);
    for (AxisSample& sample : samples)
        for (const Axis axis : of.axes)
            sample.side_unknown[index_of(axis)] = sample.travel[index_of(axis)] == 0;
    for (const PassRows& list : passes_of(rows)) {
        const Pass pass(rows, list, of.names);
        pass.fill(of.axes, chosen, samples);
        for (const Axis axis : of.axes)
            if (const double seconds = of.constants[index_of(axis)]; seconds > 0.0)
                pass.smooth(axis, seconds, chosen, samples);
    }
    for (AxisSample& sample : samples)
        for (const Axis axis : of.axes)
            if (sample.velocity[axis] != 0.0) sample.side_unknown[index_of(axis)] = false;
    return samples;
}

}  // namespace

bool is_continuous(Device device) {
    return device == Device::ballbar || device == Device::axis;
}

std::vector<AxisSample> samples_of(std::span<const Reading> rows, const std::vector<Axis>& axes,
                                   TravelHistory history, const AxisNames& names,
                                   const TimeConstants& constants) {
    return samples_in(rows, {axes, names, constants}, history, Chosen(rows.size()));
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

std::vector<AxisSample> samples_among(const ReadingTable& table,
                                      std::span<const std::size_t> chosen,
                                      const TimeConstants& constants) {
    std::vector<AxisSample> samples;
    const std::span<const Reading> rows(table.rows);
    for (std::size_t begin = 0, done = 0; begin < rows.size();) {
        const std::size_t end = session_end(table.rows, begin);
        std::size_t next = done;
        while (next < chosen.size() && chosen[next] < end) ++next;
        const TravelHistory history(sides_before(table, begin), rows_rounding, table.names);
        const Chosen here(end - begin, begin, chosen.subspan(done, next - done));
        const auto part = samples_in(rows.subspan(begin, end - begin),
                                     {table.axes, table.names, constants}, history, here);
        samples.insert(samples.end(), part.begin(), part.end());
        begin = end;
        done = next;
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
