#include "identification/time_constants.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/rounded.h"
#include "records/samples.h"

namespace trunnion::identification {
namespace {

constexpr std::size_t least_rows = 30;
constexpr std::size_t most_rows = 20000;  ///< of an axis: so many tell it well
constexpr double least_gain = 5.0;        ///< nats
constexpr double least_saving = 0.05;     ///< part of the squares
constexpr int grid = 30;                  ///< steps of a quarter
constexpr double golden = 0.6180339887498949;

/// Rows of one axis in a log.
struct LoggedRow {
    std::size_t path, at;  ///< path, and its time
    std::size_t row;       ///< of the table
    double value, weight, travel;
};

/// The log of one axis, and how well its motion explains it.
class AxisLog {
  public:
    AxisLog(const records::ReadingTable& table, Axis axis)
        : paths_(records::logged_paths(table, axis)) {
        for (std::size_t p = 0; p < paths_.size() && rows_.size() < most_rows; ++p)
            add(table, axis, p);
    }

    std::size_t size() const { return rows_.size(); }

    /// Weighted squares that the motion behind a time constant leaves.
    double left(double time_constant_s) const {
        std::vector<std::vector<Vector3>> motion;
        for (const records::CommandedPath& path : paths_)
            motion.push_back(records::smoothed_motion(path, time_constant_s));
        return left_of([&](const LoggedRow& row) { return motion[row.path][row.at]; });
    }

    /// The same of the derivatives of the command itself.
    double left_without(const std::vector<records::LoggedMotion>& motion) const {
        return left_of([&](const LoggedRow& row) { return *motion[row.row].motion; });
    }

  private:
    /// True for a row near the begin of its path, where the motion before it still counts.
    static bool is_early(const records::CommandedPath& path, std::size_t k) {
        const double after_s = path.time_s[path.at[k]] - path.time_s.front();
        return after_s < std::min(3.0 * most_time_constant_s,
                                  0.1 * (path.time_s.back() - path.time_s.front()));
    }

    void add(const records::ReadingTable& table, Axis axis, std::size_t p) {
        const records::CommandedPath& path = paths_[p];
        double travel = 0.0;
        for (std::size_t k = 0; k < path.rows.size(); ++k) {
            const double v = path.velocity[path.at[k]];
            if (v != 0.0) travel = v > 0.0 ? 1.0 : -1.0;
            const records::Reading& row = table.rows[path.rows[k]];
            if (row.device != records::Device::axis || !row.value_mm || is_early(path, k) ||
                table.names.find(row.feature) != axis || rows_.size() == most_rows)
                continue;
            const double sigma = row.sigma_mm && *row.sigma_mm > 0.0 ? *row.sigma_mm : 1.0;
            rows_.push_back({p, path.at[k], path.rows[k], *row.value_mm, 1.0 / sigma, travel});
        }
    }

    template <typename MotionOf>
    double left_of(const MotionOf& motion_of) const {
        Eigen::MatrixXd a(static_cast<Eigen::Index>(rows_.size()), 5);
        Eigen::VectorXd y(a.rows());
        for (Eigen::Index i = 0; i < a.rows(); ++i) {
            const LoggedRow& row = rows_[static_cast<std::size_t>(i)];
            a.row(i).head<3>() = row.weight * motion_of(row).transpose();
            a.row(i).tail<2>() << row.weight, row.weight * row.travel;
            y(i) = row.weight * row.value;
        }
        for (Eigen::Index c = 0; c < a.cols(); ++c)
            if (const double norm = a.col(c).norm(); norm > 0.0) a.col(c) /= norm;
        const Eigen::VectorXd h = a.transpose() * y;
        Eigen::MatrixXd normal = a.transpose() * a;
        normal.diagonal().array() += 1e-12;  // of columns that are alike or zero
        return (y - a * normal.ldlt().solve(h)).squaredNorm();
    }

    std::vector<records::CommandedPath> paths_;
    std::vector<LoggedRow> rows_;
};

/// The time constant that leaves least: the best of a grid, then golden section beside it, both in
/// the logarithm. Where much shorter ones leave hardly more, the log tells none of them (a motion
/// of one frequency), and the shortest is nearest to a series of derivatives.
double best_of(const AxisLog& log) {
    constexpr double hardly = 1.03;  // of the squares
    const double step = std::log(most_time_constant_s / least_time_constant_s) / (grid - 1);
    const auto left_at = [&](double k) {
        return log.left(least_time_constant_s * std::exp(k * step));
    };
    std::vector<double> left;
    for (int k = 0; k < grid; ++k) left.push_back(left_at(k));
    const auto least = std::min_element(left.begin(), left.end());
    const auto best = static_cast<double>(least - left.begin());
    const auto shortest = static_cast<double>(
        std::find_if(left.begin(), left.end(), [&](double l) { return l <= hardly * *least; }) -
        left.begin());
    if (shortest < best - 2.0) return least_time_constant_s * std::exp(shortest * step);
    double low = std::max(0.0, best - 1.0), high = std::min(grid - 1.0, best + 1.0);
    for (int k = 0; k < 12; ++k) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (left_at(a) < left_at(b))
            high = b;
        else
            low = a;
    }
    return least_time_constant_s * std::exp(0.5 * (low + high) * step);
}

/// The time constant that the log of an axis tells, if it tells one.
std::optional<double> time_constant_of(const AxisLog& log, double without) {
    const double seconds = best_of(log), with = log.left(seconds);
    const bool tells =
        with < (1.0 - least_saving) * without &&
        0.5 * static_cast<double>(log.size()) * std::log(without / with) > least_gain;
    return tells ? std::optional(seconds) : std::nullopt;
}

/// True where the setup tells how the axis follows.
bool tells_lag(const setup::Setup& setup) {
    return std::any_of(setup.effects.begin(), setup.effects.end(), [](const auto& effect) {
        return effect.name == "servo.mismatch" || effect.name == "servo.contour";
    });
}

}  // namespace

setup::Setup with_time_constants(setup::Setup setup, const records::ReadingTable& table) {
    const bool logged = std::any_of(table.rows.begin(), table.rows.end(), [](const auto& row) {
        return row.device == records::Device::axis;
    });
    if (!logged || tells_lag(setup)) return setup;
    const std::vector<records::LoggedMotion> motion = records::logged_motion(table);
    for (const Axis axis : table.axes) {
        double& seconds = setup.time_constant_s[index_of(axis)];
        if (seconds > 0.0) continue;
        const AxisLog log(table, axis);
        if (log.size() < least_rows) continue;
        seconds = time_constant_of(log, log.left_without(motion)).value_or(0.0);
    }
    return setup;
}

std::vector<std::string> time_constant_words(const setup::Setup& setup) {
    std::vector<std::string> sentences;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (const double seconds = setup.time_constant_s[index_of(axis.axis)]; seconds > 0.0)
            sentences.push_back(
                fmt::format("the lag of {} is that of its motion behind a time constant of {} ms{}",
                            axis.name, three_digits(1e3 * seconds),
                            seconds < 1.01 * least_time_constant_s ? " or less" : ""));
    return sentences;
}

}  // namespace trunnion::identification
