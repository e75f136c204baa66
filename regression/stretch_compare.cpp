#include "regression/stretch_compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regression/deviation.h"

namespace trunnion::regression {

namespace {

bool near(const PathPoint& p, const PathPoint& q, const Tolerances& t) {
    return (p.position_mm - q.position_mm).squaredNorm() <= t.position_mm * t.position_mm &&
           (p.orientation - q.orientation).squaredNorm() <= t.direction_rad * t.direction_rad;
}

}  // namespace

void WalkTotals::worst(double position, double direction, std::uint64_t a, std::uint64_t b) {
    if (position > position_mm) {
        position_mm = position;
        worst_a = a;
        worst_b = b;
    }
    if (direction > direction_rad) {
        direction_rad = direction;
        if (position_mm == 0.0) {
            worst_a = a;
            worst_b = b;
        }
    }
}

void StretchComparer::compare(Stretch a, Stretch b, std::vector<PathRegion>& regions,
                              WalkTotals& totals) {
    regions_ = &regions;
    totals_ = &totals;
    stretch_a_ = a;
    stretch_b_ = b;
    first_region_ = regions.size();
    attributes_.begin(regions);
    commits_.clear();
    Corner at{a.first, b.first};
    bool together = common(at.i, at.j);
    while (at.i < a.last || at.j < b.last) {
        if (together && at.i < a.last && at.j < b.last && quick_match(at, a, b)) {
            attributes(at);
            commit(at);
            ++at.i, ++at.j;
            continue;
        }
        const FrechetResult walk =
            next_common_corner({a_, {at.i, a.last}}, {b_, {at.j, b.last}}, options_.tolerances);
        if (walk.reached) {
            attributes_between(at, {walk.a, walk.b});
            totals.compared += walk.a - at.i;
            totals.worst(walk.position_mm, walk.direction_rad, at.i, at.j);
            at = {walk.a, walk.b};
            together = true;
            continue;
        }
        if (retry_exact(at, a, b)) continue;
        Corner from = first_failing(walk, at, a, b);
        // Blocks with a common start but different ends differ, even where the next ones agree
        // again.
        if (from.i > at.i && from.j > at.j && !common(from.i, from.j) &&
            common(from.i - 1, from.j - 1))
            --from.i, --from.j;
        const Corner to = regions.size() - first_region_ + 1 >= options_.max_regions
                              ? Corner{a.last, b.last}
                              : meet_again(from, a, b);
        add_region(from, to);
        totals.compared += to.i - at.i;
        at = to;
        together = common(at.i, at.j);
        commits_.clear();
    }
    attributes_.end();
}

/// Compares segment by segment from a common corner: lines by their ends, arcs along their path.
bool StretchComparer::quick_match(Corner at, Stretch a, Stretch b) {
    const Segment &sa = a_[at.i], &sb = b_[at.j];
    if (sa.kind != sb.kind || sa.is_arc() != sb.is_arc()) return false;
    if ((at.i + 1 == a.last) != (at.j + 1 == b.last)) return false;
    if (!near(sa.end(), sb.end(), options_.tolerances)) return false;
    return !sa.is_arc() || same_arc(at);
}

bool StretchComparer::same_arc(Corner at) {
    const Segment &sa = a_[at.i], &sb = b_[at.j];
    if ((sa.sweep_rad > 0.0) != (sb.sweep_rad > 0.0) && sa.normal == sb.normal) return false;
    const PathPoint start_a = a_[at.i - 1].end(), start_b = b_[at.j - 1].end();
    Tolerances inner = options_.tolerances;  // between the compared points the deviation may be
                                             // slightly larger
    inner.position_mm *= 0.8;
    inner.direction_rad *= 0.8;
    const int count = 4 + static_cast<int>(std::abs(sa.sweep_rad));
    for (int k = 1; k < count; ++k) {
        const double s = static_cast<double>(k) / count;
        if (!near(point_at(start_a, sa, s), point_at(start_b, sb, s), inner)) return false;
    }
    return true;
}

/// Short segments close to the tolerance: an earlier corner may have been matched wrongly, so the
/// exact comparison is repeated from some corners back, beyond the place where it failed.
bool StretchComparer::retry_exact(Corner& at, Stretch a, Stretch b) {
    if (commits_.empty()) return false;
    const Corner back = commits_.front();
    const double reach = (a_[at.i - 1].end().position_mm - a_[back.i - 1].end().position_mm).norm();
    commits_.clear();
    if (reach > 40.0 * options_.tolerances.position_mm) return false;
    const auto beyond = [](std::uint64_t next, std::uint64_t last) {
        return std::min(next + 1, last - 1);  // the end of a stretch is a common corner too
    };
    const FrechetResult walk =
        next_common_corner({a_, {back.i, a.last}, beyond(at.i, a.last)},
                           {b_, {back.j, b.last}, beyond(at.j, b.last)}, options_.tolerances);
    if (!walk.reached) return false;
    totals_->worst(walk.position_mm, walk.direction_rad, at.i, at.j);
    attributes_between(at, {walk.a, walk.b});
    at = {walk.a, walk.b};
    return true;
}

void StretchComparer::commit(Corner at) {
    constexpr std::size_t kept = 16;
    const PathPoint p = a_[at.i].end(), q = b_[at.j].end();
    totals_->worst((p.position_mm - q.position_mm).norm(), (p.orientation - q.orientation).norm(),
                   at.i, at.j);
    ++totals_->compared;
    if (commits_.size() == 2 * kept)
        commits_.erase(commits_.begin(), commits_.begin() + static_cast<std::ptrdiff_t>(kept));
    commits_.push_back(at);
}

/// The segments to report: those with the nearest ends among the ones where the comparison stopped.
StretchComparer::Corner StretchComparer::first_failing(const FrechetResult& failed, Corner from,
                                                       Stretch a, Stretch b) {
    Corner best{std::min(failed.a, std::max(from.i, a.last - 1)),
                std::min(failed.b, std::max(from.j, b.last - 1))};
    double least = std::numeric_limits<double>::infinity();
    for (const Corner& c : {Corner{failed.a, failed.b}, Corner{failed.a, failed.b - 1},
                            Corner{failed.a - 1, failed.b}}) {
        if (c.i < from.i || c.j < from.j || c.i >= a.last || c.j >= b.last) continue;
        const double apart = (a_[c.i].end().position_mm - b_[c.j].end().position_mm).norm();
        if (apart < least - 1e-9) {
            least = apart;
            best = c;
        }
    }
    return best;
}

// Feed, spindle, coolant, tool ------------------------------------------------------------------

void StretchComparer::attributes(Corner at) {
    const double length_a = length_mm(a_[at.i - 1].end(), a_[at.i]);
    attributes_.pair(at.i, at.j, length_a, length_mm(b_[at.j - 1].end(), b_[at.j]));
}

/// One path waits at a corner while the other moves within the tolerance. One such move is
/// rounding; many of a kind (rapid, feed) that the waiting path has not at this corner are a
/// difference.
void StretchComparer::other_kind_alone(Corner from, Corner to) {
    const auto has_at = [](SegmentWindow& path, std::uint64_t next, std::uint64_t last,
                           SegmentKind kind) {
        return path[next - 1].kind == kind || (next < last && path[next].kind == kind);
    };
    const std::uint64_t beside_a = from.i < stretch_a_.last ? from.i : from.i - 1;
    const std::uint64_t beside_b = from.j < stretch_b_.last ? from.j : from.j - 1;
    for (std::uint64_t i = from.i; i < to.i; ++i)
        if (!has_at(b_, from.j, stretch_b_.last, a_[i].kind))
            attributes_.alone(i, beside_b, length_mm(a_[i - 1].end(), a_[i]));
    for (std::uint64_t j = from.j; j < to.j; ++j)
        if (!has_at(a_, from.i, stretch_a_.last, b_[j].kind))
            attributes_.alone(beside_a, j, length_mm(b_[j - 1].end(), b_[j]));
}

/// Stretches with equal paths but different segmentation: pairs by fraction of length.
void StretchComparer::attributes_between(Corner from, Corner to) {
    const auto length_of = [](SegmentWindow& path, std::uint64_t first, std::uint64_t last) {
        std::vector<double> ends;
        double sum = 0.0;
        for (std::uint64_t k = first; k < last; ++k)
            ends.push_back(sum += length_mm(path[k - 1].end(), path[k]));
        return ends;
    };
    const auto ends_a = length_of(a_, from.i, to.i), ends_b = length_of(b_, from.j, to.j);
    if (ends_a.empty() || ends_b.empty() || ends_a.back() <= 0.0 || ends_b.back() <= 0.0)
        return other_kind_alone(from, to);
    const double scale = ends_a.back() / ends_b.back();
    std::size_t i = 0, j = 0;
    double done = 0.0;
    while (i < ends_a.size() && j < ends_b.size()) {
        const double end_b = ends_b[j] * scale;
        const double end = std::min(ends_a[i], end_b);
        if (end > done) attributes_.pair(from.i + i, from.j + j, end - done, (end - done) / scale);
        done = std::max(done, end);
        if (ends_a[i] <= end_b)
            ++i;
        else
            ++j;
    }
}

// Where the paths meet again --------------------------------------------------------------------

/// True when the corners before segments i and j coincide.
bool StretchComparer::common(std::uint64_t i, std::uint64_t j) {
    return near(a_[i - 1].end(), b_[j - 1].end(), options_.tolerances);
}

/// True when the paths really agree again from here: the next segments match too.
bool StretchComparer::confirmed(std::uint64_t i, std::uint64_t j, Stretch a, Stretch b) {
    if (i == a.last && j == b.last) return true;
    if (i == a.last || j == b.last) return false;
    const Stretch any{1, std::numeric_limits<std::uint64_t>::max()};
    if (quick_match({i, j}, any, any)) return true;
    return next_common_corner({a_, {i, std::min(a.last, i + 8)}},
                              {b_, {j, std::min(b.last, j + 8)}}, options_.tolerances)
        .reached;
}

StretchComparer::Corner StretchComparer::meet_again(Corner at, Stretch a, Stretch b) {
    Corner found = at;
    if (meet_near(found, a, b)) return found;
    if (meet_shifted(found, a, b)) return found;
    const std::size_t most = options_.resync_segments;
    for (std::size_t window = 2048;; window *= 12) {
        window = std::min(window, most);
        if (meet_far(found, a, b, window)) return found;
        if (window > a.last - at.i && window > b.last - at.j) return {a.last, b.last};
        if (window == most) return {std::min(a.last, at.i + most), std::min(b.last, at.j + most)};
    }
}

bool StretchComparer::meet_near(Corner& at, Stretch a, Stretch b) {
    constexpr std::uint64_t window = 24;
    const auto try_at = [&](std::uint64_t i, std::uint64_t j) {
        if (i > a.last || j > b.last || !common(i, j) || !confirmed(i, j, a, b)) return false;
        at = {i, j};
        return true;
    };
    // Smallest number of omitted segments first, then the most equal counts.
    for (std::uint64_t sum = 1; sum <= window; ++sum)
        for (std::uint64_t d = sum % 2; d <= sum; d += 2) {
            const std::uint64_t more = (sum + d) / 2, less = (sum - d) / 2;
            if (try_at(at.i + more, at.j + less) || (d > 0 && try_at(at.i + less, at.j + more)))
                return true;
        }
    return false;
}

/// The same path with a shift: follows it as long as the shift is constant.
bool StretchComparer::meet_shifted(Corner& at, Stretch a, Stretch b) {
    if (at.i >= a.last || at.j >= b.last) return false;
    const Vector3 shift = b_[at.j].end().position_mm - a_[at.i].end().position_mm;
    const double tolerance = options_.tolerances.position_mm;
    std::uint64_t k = 1;
    for (; at.i + k < a.last && at.j + k < b.last; ++k) {
        const Segment &sa = a_[at.i + k], &sb = b_[at.j + k];
        const Vector3 here = sb.end().position_mm - sa.end().position_mm;
        if (sa.kind != sb.kind || (here - shift).norm() > tolerance) break;
        if (common(at.i + k, at.j + k) && confirmed(at.i + k, at.j + k, a, b)) break;
    }
    if (k < 12) return false;
    at = {at.i + k, at.j + k};
    return true;
}

namespace {

/// Grid cell of a point as one number; `corner` 0..7 shifts the point by a quarter of a cell, so
/// that nearby points share at least one of eight cells; -1: not shifted.
std::uint64_t cell_of(const Vector3& p, double size, int corner) {
    std::uint64_t h = 0x9E3779B97F4A7C15ULL;
    for (int d = 0; d < 3; ++d) {
        const double shift = corner < 0 ? 0.0 : ((corner >> d) & 1 ? 0.25 : -0.25);
        const auto n = static_cast<std::int64_t>(std::floor(p[d] / size + shift));
        h = (h ^ static_cast<std::uint64_t>(n)) * 0xBF58476D1CE4E5B9ULL;
        h ^= h >> 29;
    }
    return h;
}

}  // namespace

StretchComparer::CornerTable StretchComparer::corners_of_b(std::uint64_t first,
                                                           std::uint64_t last) {
    const double cell = 64.0 * options_.tolerances.position_mm;
    CornerTable corners;
    corners.reserve(last - first + 1);
    for (std::uint64_t j = first; j <= last; ++j)
        corners.emplace_back(cell_of(b_[j - 1].end().position_mm, cell, -1), j);
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// The nearest common corner of both, found by a hash of B's corners.
bool StretchComparer::meet_far(Corner& at, Stretch a, Stretch b, std::size_t window) {
    const double cell = 64.0 * options_.tolerances.position_mm;
    const std::uint64_t b_end = std::min<std::uint64_t>(b.last, at.j + window);
    const std::uint64_t a_end = std::min<std::uint64_t>(a.last, at.i + window);
    const CornerTable corners = corners_of_b(at.j, b_end);
    std::uint64_t best = std::numeric_limits<std::uint64_t>::max();
    Corner found = at;
    int tries = 0;  // limit, because a place met thousands of times must not cost quadratic time
    for (std::uint64_t i = at.i; i <= a_end && i - at.i < best; ++i) {
        const Vector3 p = a_[i - 1].end().position_mm;
        for (int corner = 0; corner < 8; ++corner) {
            const std::uint64_t key = cell_of(p, cell, corner);
            auto k = std::lower_bound(corners.begin(), corners.end(), std::pair{key, at.j});
            for (; k != corners.end() && k->first == key && tries < 200000; ++k, ++tries) {
                const std::uint64_t j = k->second;
                if (i == at.i && j == at.j) continue;
                const std::uint64_t cost = (i - at.i) + (j - at.j);
                if (cost >= best) break;
                if (!common(i, j) || !confirmed(i, j, a, b)) continue;
                best = cost;
                found = {i, j};
            }
        }
    }
    if (best == std::numeric_limits<std::uint64_t>::max()) return false;
    at = found;
    return true;
}

void StretchComparer::add_region(Corner from, Corner to) {
    PathRegion region;
    region.a = {from.i, to.i};
    region.b = {from.j, to.j};
    const Deviation apart = deviation_between(a_, region.a, b_, region.b, options_.tolerances);
    region.position_mm = apart.position_mm;
    region.direction_rad = apart.direction_rad;
    if (const auto shift = common_shift(a_, region.a, b_, region.b, options_.tolerances)) {
        region.kind = RegionKind::moved;
        region.shift_mm = *shift;
        region.position_mm = shift->norm();
    } else if (from.i == to.i) {
        region.kind = RegionKind::only_b;
    } else if (from.j == to.j) {
        region.kind = RegionKind::only_a;
    }
    totals_->worst(region.position_mm, region.direction_rad, std::min(from.i, to.i),
                   std::min(from.j, to.j));
    regions_->push_back(region);
}

}  // namespace trunnion::regression
