#include "regression/frechet.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

namespace trunnion::regression {

namespace {

/// Reachable or free part of a cell edge, as fractions of the edge.
struct Interval {
    double low = 1.0, high = 0.0;
    bool empty() const { return low > high; }
};

/// The t in [0, 1] with |offset + t * step| <= tolerance.
Interval within(const Vector3& offset, const Vector3& step, double tolerance) {
    const double a = step.squaredNorm();
    const double b = offset.dot(step);
    const double c = offset.squaredNorm() - tolerance * tolerance;
    if (a < 1e-24) return c <= 0.0 ? Interval{0.0, 1.0} : Interval{};
    const double root = b * b - a * c;
    if (root < 0.0) return {};
    const double r = std::sqrt(root);
    return {std::max(0.0, (-b - r) / a), std::min(1.0, (-b + r) / a)};
}

struct Node {
    PathPoint point;
    std::uint64_t segment = 0;              ///< segment that ends here or passes through
    bool corner = false;                    ///< it ends the segment
    SegmentKind kind = SegmentKind::rapid;  ///< of the chord that ends here
};

/// The free part of the edge `from`..`to` as seen from a point.
Interval free_part(const PathPoint& point, const PathPoint& from, const PathPoint& to,
                   const Tolerances& t) {
    const Interval p = within(from.position_mm - point.position_mm,
                              to.position_mm - from.position_mm, t.position_mm);
    if (p.empty()) return {};
    const Interval d = within(from.orientation - point.orientation,
                              to.orientation - from.orientation, t.direction_rad);
    return {std::max(p.low, d.low), std::min(p.high, d.high)};
}

/// A path divided into chords, generated on demand.
class ChordLine {
  public:
    ChordLine(SegmentWindow& path, Stretch stretch, const Tolerances& tolerances)
        : path_(path), next_(stretch.first), last_(stretch.last), tolerances_(tolerances) {
        nodes_.push_back({path_[next_ - 1].end(), next_ - 1, true, SegmentKind::origin});
    }
    /// True when node k exists.
    bool has(std::size_t k) {
        while (base_ + nodes_.size() <= k && next_ < last_) extend();
        return k < base_ + nodes_.size();
    }
    const Node& operator[](std::size_t k) const { return nodes_[k - base_]; }
    void drop_before(std::size_t k) {
        while (base_ < k && nodes_.size() > 1) {
            nodes_.pop_front();
            ++base_;
        }
    }

  private:
    void extend() {
        const Segment segment = path_[next_];
        chords_.clear();
        append_chords(nodes_.back().point, segment, tolerances_, chords_);
        for (std::size_t k = 0; k < chords_.size(); ++k)
            nodes_.push_back({chords_[k], next_, k + 1 == chords_.size(), segment.kind});
        ++next_;
    }

    SegmentWindow& path_;
    std::uint64_t next_, last_;
    Tolerances tolerances_;
    std::deque<Node> nodes_;
    std::size_t base_ = 0;
    std::vector<PathPoint> chords_;
};

/// Reachable part of the left edge of row j.
struct Row {
    std::size_t j = 0;
    Interval reach;
};

class FreeSpaceWalk {
  public:
    FreeSpaceWalk(WalkedSide a, WalkedSide b, const Tolerances& tolerances)
        : a_(a.path, a.stretch, tolerances),
          b_(b.path, b.stretch, tolerances),
          tolerances_(tolerances),
          a_beyond_(a.beyond),
          b_beyond_(b.beyond) {
        result_.a = a.stretch.first;
        result_.b = b.stretch.first;
    }

    FrechetResult run() {
        if (!start()) return result_;
        for (std::size_t column = 0; a_.has(column + 1); ++column) {
            a_min_ = {};
            walk_column(column);
            if (found_) return result_;
            take(a_min_);
            if (rows_.empty()) return result_;
            result_.a = std::max(result_.a, next_segment(a_[column + 1]));
            a_.drop_before(column);
            b_.drop_before(rows_.front().j);
            take_rows_before(rows_.front().j);
        }
        return result_;
    }

  private:
    static std::uint64_t next_segment(const Node& node) {
        return node.corner ? node.segment + 1 : node.segment;
    }

    /// The left edge of the whole diagram: B continues while A is at its start.
    bool start() {
        if (free_part(a_[0].point, b_[0].point, b_[0].point, tolerances_).empty()) return false;
        for (std::size_t j = 0; b_.has(j + 1); ++j) {
            const Interval part = free_part(a_[0].point, b_[j].point, b_[j + 1].point, tolerances_);
            if (part.empty() || part.low > 0.0) break;
            rows_.push_back({j, part});
            if (part.high < 1.0) break;
        }
        if (rows_.empty()) rows_.push_back({0, {0.0, 0.0}});
        return true;
    }

    void walk_column(std::size_t column) {
        next_rows_.clear();
        Interval bottom;  // reachable part of the lower edge of the current cell
        const bool last = !a_.has(column + 2);
        bool at_end = false;  // A may be at its end while B is at its node j
        std::size_t at = 0;
        std::size_t j = rows_.front().j;
        while (at < rows_.size() || !bottom.empty() || at_end) {
            if (bottom.empty() && !at_end) j = rows_[at].j;
            Interval left;
            if (at < rows_.size() && rows_[at].j == j) left = rows_[at++].reach;
            if (!b_.has(j + 1)) {  // B is at its end while A continues along the top edge
                finish_on_top(column, j, left, bottom);
                break;
            }
            if (!left.empty() && left.low <= 0.0 && bottom.empty()) bottom = lower_edge(column, j);
            if (last) at_end = goes_on_alone(column + 1, j, at_end || bottom.high >= 1.0);
            const bool reached = !left.empty() || !bottom.empty();
            bottom = reached ? walk_cell(column, j, left, bottom) : Interval{};
            if (!found_ && at_end) try_corner(column + 1, j + 1);
            if (found_) return;
            if (!bottom.empty() || at_end) result_.b = std::max(result_.b, next_segment(b_[j + 1]));
            ++j;
        }
        rows_.swap(next_rows_);
    }

    /// The lower edge from its left corner on, if that corner is reachable.
    Interval lower_edge(std::size_t column, std::size_t j) {
        const Interval part =
            free_part(b_[j].point, a_[column].point, a_[column + 1].point, tolerances_);
        return part.low <= 0.0 ? part : Interval{};
    }

    /// Propagates reachability through one cell: sets the right edge, returns the upper edge.
    Interval walk_cell(std::size_t column, std::size_t j, Interval left, Interval bottom) {
        const Node& a1 = a_[column + 1];
        const Node& b1 = b_[j + 1];
        const bool open = a1.kind == b1.kind;
        Interval right = free_part(a1.point, b_[j].point, b1.point, tolerances_);
        Interval top = free_part(b1.point, a_[column].point, a1.point, tolerances_);
        if (open) {
            if (!right.empty()) note_passing(a1.point, b_[j].point, b1.point, a_min_);
            if (!top.empty()) note_passing(b1.point, a_[column].point, a1.point, b_min(j + 1));
            if (bottom.empty()) right.low = std::max(right.low, left.low);
            if (left.empty()) top.low = std::max(top.low, bottom.low);
        } else {  // only the outer corners continue
            right.high = !bottom.empty() && bottom.high >= 1.0 && right.low <= 0.0 ? 0.0 : -1.0;
            top.high = !left.empty() && left.high >= 1.0 && top.low <= 0.0 ? 0.0 : -1.0;
        }
        if (!right.empty()) add_right(column, j, right);
        return top;
    }

    void add_right(std::size_t column, std::size_t j, Interval right) {
        next_rows_.push_back({j, right});
        if (!a_[column + 1].corner) return;
        if (right.high >= 1.0) try_corner(column + 1, j + 1);
        if (!found_ && right.low <= 0.0) try_corner(column + 1, j);
    }

    void try_corner(std::size_t column, std::size_t j) {
        const Node& a = a_[column];
        const Node& b = b_[j];
        if (!b.corner || a.segment < a_beyond_ || b.segment < b_beyond_) return;
        // At the end of one path the other must be at its end too, otherwise nothing matches its
        // remainder.
        if (a_.has(column + 1) != b_.has(j + 1)) return;
        found_ = result_.reached = true;
        take_rows_before(j);
        result_.a = a.segment + 1;
        result_.b = b.segment + 1;
        const double corner_mm = (a.point.position_mm - b.point.position_mm).norm();
        result_.position_mm = std::max(result_.position_mm, corner_mm);
        result_.direction_rad =
            std::max(result_.direction_rad, (a.point.orientation - b.point.orientation).norm());
    }

    /// True when A, at its end, may wait for B to get from node j to the next one: the counterpart
    /// of finish_on_top, with segments of any kind there, too.
    bool goes_on_alone(std::size_t end, std::size_t j, bool reached) {
        if (!reached) return false;
        const Interval edge = free_part(a_[end].point, b_[j].point, b_[j + 1].point, tolerances_);
        return edge.low <= 0.0 && edge.high >= 1.0;
    }

    void finish_on_top(std::size_t column, std::size_t j, Interval left, Interval bottom) {
        const Interval edge =
            free_part(b_[j].point, a_[column].point, a_[column + 1].point, tolerances_);
        const bool from_left = !left.empty() && left.low <= 0.0 && edge.low <= 0.0;
        if (edge.empty() || edge.high < 1.0 || (!from_left && bottom.empty())) return;
        next_rows_.push_back({j, {0.0, 0.0}});
        if (a_[column + 1].corner) try_corner(column + 1, j);
    }

    /// The smallest distance of a corner of one path from the chords of the other that may
    /// correspond to it.
    struct Passing {
        double position_mm = std::numeric_limits<double>::infinity();
        double direction_rad = std::numeric_limits<double>::infinity();
    };

    static void note_passing(const PathPoint& p, const PathPoint& from, const PathPoint& to,
                             Passing& least) {
        const Vector3 step = to.position_mm - from.position_mm;
        const double t = std::clamp(
            (p.position_mm - from.position_mm).dot(step) / std::max(step.squaredNorm(), 1e-30), 0.0,
            1.0);
        least.position_mm =
            std::min(least.position_mm, (from.position_mm + t * step - p.position_mm).norm());
        const Vector3 d = from.orientation + t * (to.orientation - from.orientation);
        least.direction_rad = std::min(least.direction_rad, (d - p.orientation).norm());
    }

    Passing& b_min(std::size_t j) {
        while (b_min_base_ + b_min_.size() <= j) b_min_.emplace_back();
        return b_min_[j - b_min_base_];
    }

    void take(const Passing& passing) {
        if (!std::isfinite(passing.position_mm)) return;
        result_.position_mm = std::max(result_.position_mm, passing.position_mm);
        result_.direction_rad = std::max(result_.direction_rad, passing.direction_rad);
    }

    void take_rows_before(std::size_t j) {
        for (; b_min_base_ < j && !b_min_.empty(); ++b_min_base_) {
            take(b_min_.front());
            b_min_.pop_front();
        }
        b_min_base_ = std::max(b_min_base_, j);
    }

    ChordLine a_, b_;
    Tolerances tolerances_;
    std::uint64_t a_beyond_, b_beyond_;
    std::vector<Row> rows_, next_rows_;
    Passing a_min_;
    std::deque<Passing> b_min_;  ///< of B's corners, starting with number b_min_base_
    std::size_t b_min_base_ = 0;
    FrechetResult result_;
    bool found_ = false;
};

}  // namespace

FrechetResult next_common_corner(WalkedSide a, WalkedSide b, const Tolerances& tolerances) {
    return FreeSpaceWalk(a, b, tolerances).run();
}

}  // namespace trunnion::regression
