#include "choices/way_match.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/waiting.h"
#include "choices/control_path.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t first_points = 1500;       ///< of the first look, along the longer way
constexpr std::size_t first_points_open = 4000;  ///< the same where the start must be found
constexpr std::size_t finer = 8;                 ///< points of the next look for one of this
constexpr std::size_t margin_points = 3;  ///< of a look, on each side of what it found, at least
constexpr std::size_t margin_nodes = 8;   ///< at least
constexpr std::size_t asked_every = 64;
constexpr double without_end = std::numeric_limits<double>::infinity();

enum WayStep : std::uint8_t { begins, both_go, log_goes, control_goes };

/// One look: dynamic time warping of points at equal distances, within ranges.
class Look {
  public:
    Look(const std::vector<double>& log, const std::vector<double>& control, std::size_t axes,
         Spans spans)
        : log_(log), control_(control), axes_(axes), spans_(std::move(spans)) {
        offset_.assign(spans_.low.size() + 1, 0);
        for (std::size_t i = 0; i < spans_.low.size(); ++i)
            offset_[i + 1] = offset_[i] + spans_.high[i] - spans_.low[i] + 1;
        step_.assign(offset_.back(), begins);
        measure();
    }

    /// First and last point of the control for each one of the log.
    Spans found(const OpenEnds& open) {
        const std::size_t n = control_.size() / axes_, m = log_.size() / axes_;
        before_.assign(n, without_end);
        now_.assign(n, without_end);
        for (std::size_t i = 0; i < m; ++i) {
            end_if_asked(i);
            for (std::size_t j = spans_.low[i]; j <= spans_.high[i]; ++j) fill(i, j, open.start);
            std::swap(before_, now_);
            if (i > 0)
                std::fill(now_.begin() + static_cast<std::ptrdiff_t>(spans_.low[i - 1]),
                          now_.begin() + static_cast<std::ptrdiff_t>(spans_.high[i - 1]) + 1,
                          without_end);
        }
        return traced(open.end
                          ? static_cast<std::size_t>(
                                std::min_element(before_.begin(), before_.end()) - before_.begin())
                          : n - 1);
    }

  private:
    /// From the way to the next point: points of both ways need not be opposite each other.
    double square(std::size_t i, std::size_t j) const {
        const double *p = &log_[i * axes_], *a = &control_[j * axes_], *way = &way_[j * axes_];
        double along = 0.0, square = 0.0;
        for (std::size_t k = 0; k < axes_; ++k) {
            const double d = p[k] - a[k];
            along += d * way[k];
            square += d * d;
        }
        const double s = std::clamp(along * inverse_[j], 0.0, 1.0);
        return square - s * (2.0 * along - s * length_[j]);
    }
    void measure() {
        const std::size_t n = control_.size() / axes_;
        way_.assign(control_.size(), 0.0);
        length_.assign(n, 0.0);
        inverse_.assign(n, 0.0);
        for (std::size_t j = 0; j + 1 < n; ++j) {
            for (std::size_t k = j * axes_; k < (j + 1) * axes_; ++k) {
                way_[k] = control_[k + axes_] - control_[k];
                length_[j] += way_[k] * way_[k];
            }
            if (length_[j] > 0.0) inverse_[j] = 1.0 / length_[j];
        }
    }
    void fill(std::size_t i, std::size_t j, bool open_start) {
        double least = i == 0 && (j == 0 || open_start) ? 0.0 : without_end;
        WayStep step = begins;
        const auto offer = [&](double cost, WayStep by) {
            if (cost < least) {
                least = cost;
                step = by;
            }
        };
        if (i > 0 && j > 0) offer(before_[j - 1], both_go);
        if (i > 0) offer(before_[j], log_goes);
        if (j > spans_.low[i]) offer(now_[j - 1], control_goes);
        now_[j] = least + square(i, j);
        step_[offset_[i] + (j - spans_.low[i])] = step;
    }
    Spans traced(std::size_t j) const {
        std::size_t i = spans_.low.size() - 1;
        Spans out{std::vector<std::size_t>(i + 1), std::vector<std::size_t>(i + 1)};
        out.low[i] = out.high[i] = j;
        while (true) {
            const std::uint8_t step = step_[offset_[i] + (j - spans_.low[i])];
            if (step == begins) break;
            if (step != log_goes) --j;
            if (step != control_goes) out.high[--i] = j;
            out.low[i] = j;
        }
        return out;
    }

    const std::vector<double>&log_, &control_;
    std::size_t axes_;
    Spans spans_;
    std::vector<std::size_t> offset_;
    std::vector<std::uint8_t> step_;
    std::vector<double> way_;               ///< to the next point
    std::vector<double> length_, inverse_;  ///< square of it, and 1 / square
    std::vector<double> before_, now_;
};

/// Ranges that allow everything.
Spans everything(std::size_t m, std::size_t n) {
    return {std::vector<std::size_t>(m, 0), std::vector<std::size_t>(m, n - 1)};
}

/// What a look found, with its margins: the ranges of the neighbours too.
std::pair<std::size_t, std::size_t> widened(const Spans& found, std::size_t i, std::size_t margin) {
    const std::size_t before = i > margin ? i - margin : 0,
                      after = std::min(i + margin, found.low.size() - 1);
    const std::size_t low = found.low[std::min(before, found.low.size() - 1)];
    return {low > margin ? low - margin : 0, found.high[after] + margin + 1};
}

/// Ranges for a look with more points.
Spans refined(const Spans& found, std::size_t m, std::size_t n, std::size_t margin) {
    Spans out{std::vector<std::size_t>(m), std::vector<std::size_t>(m)};
    for (std::size_t i = 0; i < m; ++i) {
        const auto [low, high] = widened(found, i / finer, margin);
        out.low[i] = std::min(low * finer, n - 1);
        out.high[i] = std::min(high * finer, n - 1);
    }
    out.low.front() = 0;
    out.high.back() = n - 1;
    return out;
}

std::size_t node_at(const Way& nodes, double along) {
    return static_cast<std::size_t>(
        std::lower_bound(nodes.along().begin(), nodes.along().end(), along) -
        nodes.along().begin());
}

/// What a look found with points a step apart.
struct Found {
    Spans spans;
    double step;
};

/// Ranges of nodes for rows, from a look with points a step apart.
Spans nodes_of_rows(const Way& rows, const Way& nodes, const Found& look, std::size_t wide) {
    const std::size_t m = rows.size(), last = nodes.size() - 1, margin = margin_nodes * wide;
    Spans out{std::vector<std::size_t>(m), std::vector<std::size_t>(m)};
    const auto near = [&](std::size_t row) {
        return widened(look.spans, static_cast<std::size_t>(rows.along()[row] / look.step),
                       margin_points * wide);
    };
    for (std::size_t i = 0; i < m; ++i) {
        // Between two rows the log's way is unknown: up to a row before, and to the next one.
        const std::size_t low = near(i - std::min<std::size_t>(i, 1)).first,
                          high = near(std::min(i + 1, m - 1)).second;
        const std::size_t from = node_at(nodes, static_cast<double>(low) * look.step),
                          to = node_at(nodes, static_cast<double>(high) * look.step);
        out.low[i] = std::min(from > margin ? from - margin : 0, last);
        out.high[i] = std::min(to + margin, last);
    }
    return out;
}

}  // namespace

Way::Way(std::vector<double> points, std::size_t axes, double ball)
    : points_(std::move(points)), axes_(axes) {
    const std::size_t n = points_.size() / axes_;
    along_.assign(n, 0.0);
    corners_ = {0};
    for (std::size_t k = 1; k < n; ++k) {
        const double far = square(corners_.back(), k);
        along_[k] = along_[corners_.back()];
        if (far <= ball * ball) continue;
        along_[k] += std::sqrt(far);
        corners_.push_back(k);
    }
}

double Way::square(std::size_t a, std::size_t b) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
        const double d = points_[a * axes_ + k] - points_[b * axes_ + k];
        sum += d * d;
    }
    return sum;
}

std::vector<double> Way::spaced(double step) const {
    const auto count = static_cast<std::size_t>(length() / step) + 1;
    std::vector<double> out;
    out.reserve(count * axes_);
    std::size_t corner = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = step * static_cast<double>(i);
        while (corner + 1 < corners_.size() && along_[corners_[corner + 1]] < at) ++corner;
        const std::size_t a = corners_[corner],
                          b = corners_[std::min(corner + 1, corners_.size() - 1)];
        const double way = along_[b] - along_[a];
        const double s = way > 0.0 ? std::clamp((at - along_[a]) / way, 0.0, 1.0) : 0.0;
        for (std::size_t k = 0; k < axes_; ++k)
            out.push_back(points_[a * axes_ + k] +
                          s * (points_[b * axes_ + k] - points_[a * axes_ + k]));
    }
    return out;
}

void end_if_asked(std::size_t count) {
    if (count % asked_every == 0 && work_must_end()) throw PathEnded();
}

Spans matched_ways(const Way& rows, const Way& nodes, const OpenEnds& open, std::size_t wide) {
    const double longer = std::max({rows.length(), nodes.length(), 1e-9});
    // More points than nodes tell nothing more.
    const auto most = static_cast<double>(nodes.size());
    const std::size_t axes = rows.axes(), margin = margin_points * wide;
    double step = longer / static_cast<double>(open.start ? first_points_open : first_points);
    const auto look = [&](const Spans* coarse) {
        const std::vector<double> log = rows.spaced(step), control = nodes.spaced(step);
        const std::size_t m = log.size() / axes, n = control.size() / axes;
        Spans spans = coarse ? refined(*coarse, m, n, margin) : everything(m, n);
        return Look(log, control, axes, std::move(spans)).found(open);
    };
    Spans found = look(nullptr);
    while (longer / step * static_cast<double>(finer) < most) {
        step /= static_cast<double>(finer);
        found = look(&found);
    }
    return nodes_of_rows(rows, nodes, {std::move(found), step}, wide);
}

}  // namespace trunnion::choices
