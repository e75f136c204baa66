#include "regression/path_compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace trunnion::regression {

namespace {

DifferenceKind kind_of(RegionKind kind) {
    switch (kind) {
        case RegionKind::moved: return DifferenceKind::moved;
        case RegionKind::only_a: return DifferenceKind::only_a;
        case RegionKind::only_b: return DifferenceKind::only_b;
        case RegionKind::feed: return DifferenceKind::feed;
        case RegionKind::spindle: return DifferenceKind::spindle;
        case RegionKind::coolant: return DifferenceKind::coolant;
        case RegionKind::tool: return DifferenceKind::tool;
        case RegionKind::path: break;
    }
    return DifferenceKind::path;
}

/// False for feed, spindle, coolant and tool.
bool is_path(RegionKind kind) {
    return kind == RegionKind::path || kind == RegionKind::moved || kind == RegionKind::only_a ||
           kind == RegionKind::only_b;
}

class PathComparer {
  public:
    PathComparer(const PathRecord& a, const PathRecord& b, const WalkOptions& options,
                 std::size_t most_clusters)
        : a_(a),
          b_(b),
          options_(options),
          most_clusters_(most_clusters),
          walk_(a.segments(), b.segments(), options),
          passes_a_(a.passes()),
          passes_b_(b.passes()),
          seen_a_(a.segments()),
          seen_b_(b.segments()) {}

    PathComparison run() {
        fill_totals();
        align(source(), options_.align, [this](const PassPair& pair) { compare(pair); });
        for (auto& [tool, row] : rows_) result_.tools.push_back(row);
        return std::move(result_);
    }

  private:
    AlignSource source() {
        const Tolerances& t = options_.tolerances;
        return {a_.passes().size(), b_.passes().size(),
                [this, &t](std::uint64_t i, std::uint64_t j) {
                    return alike(passes_a_[i], passes_b_[j], t);
                },
                [this, &t](const PassRanges& a, const PassRanges& b, Keys& keys_a, Keys& keys_b) {
                    PassIds ids(t);
                    identify(passes_a_, a, ids, keys_a);
                    identify(passes_b_, b, ids, keys_b);
                }};
    }

    static void identify(SpilledWindow<Pass>& passes, const PassRanges& ranges, PassIds& ids,
                         Keys& keys) {
        keys.clear();
        for (const PassRange& range : ranges)
            for (std::uint64_t k = range.first; k < range.last; ++k)
                keys.push_back(ids.id_of(passes[k]));
    }

    void compare(const PassPair& pair) {
        switch (pair.pairing) {
            case Pairing::same: compare_same(pair); break;
            case Pairing::changed: compare_changed(pair); break;
            case Pairing::reordered:
                for (std::uint64_t k = 0; k < pair.a.size(); ++k)
                    compare_cut(pair.a.first + k, pair.b.first + k);
                add_whole(DifferenceKind::reordered, pair);
                break;
            case Pairing::only_a: add_whole(DifferenceKind::only_a, pair); break;
            case Pairing::only_b: add_whole(DifferenceKind::only_b, pair); break;
        }
    }

    void compare_same(const PassPair& pair) {
        const Pass p = passes_a_[pair.a.first], q = passes_b_[pair.b.first];
        std::vector<PathRegion> regions;
        if (other_functions(p, q)) {
            walk_.compare({p.first, p.cut_first}, {q.first, q.cut_first}, regions, unused_);
            result_.approaches_differ += regions.empty() ? 0 : 1;
            regions.clear();
            walk(p.cut_first, p.last, q.cut_first, q.last, regions);
        } else if ((pair.a.first == 0 && pair.b.first == 0) ||
                   apart_mm(p.first, q.first) <= options_.tolerances.position_mm) {
            walk(p.first, p.last, q.first, q.last, regions);
        } else {
            compare_approach(p, q, regions);
            walk(p.cut_first, p.last, q.cut_first, q.last, regions);
        }
        take(regions, pair.a);
    }

    /// The path to a cut from another place on each side: it necessarily differs by as much as the
    /// places do. What is further apart is a difference of its own.
    void compare_approach(const Pass& p, const Pass& q, std::vector<PathRegion>& regions) {
        std::vector<PathRegion> found;
        walk_.compare({p.first, p.cut_first}, {q.first, q.cut_first}, found, unused_);
        double begins_apart_mm = apart_mm(p.first, q.first);
        const double ends_apart_mm = p.cuts() ? apart_mm(p.cut_first, q.cut_first) : 0.0;
        for (PathRegion& r : found) {
            const bool at_cut = r.a.last == p.cut_first && r.b.last == q.cut_first;
            double allowed_mm = at_cut ? ends_apart_mm : 0.0;
            if (is_path(r.kind)) {
                allowed_mm = std::max(allowed_mm, std::exchange(begins_apart_mm, 0.0));
                if (allowed_mm > options_.tolerances.position_mm) {
                    allowed_mm += options_.tolerances.position_mm;
                    if (r.position_mm <= allowed_mm) continue;
                    skip_near(r, allowed_mm);
                }
            }
            result_.totals.worst(r.position_mm, r.direction_rad, r.a.first, r.b.first);
            regions.push_back(r);
        }
    }

    /// Leaves out the blocks of a region that end no further apart than this.
    void skip_near(PathRegion& r, double allowed_mm) {
        while (r.a.first + 1 < r.a.last && r.b.first + 1 < r.b.last &&
               apart_mm(r.a.first + 1, r.b.first + 1) <= allowed_mm)
            ++r.a.first, ++r.b.first;
    }

    /// The path to the cut cannot agree: another machine, or another positioning function there.
    bool other_functions(const Pass& p, const Pass& q) const {
        return options_.other_machine || p.cut_modes != q.cut_modes ||
               (a_.modes() != b_.modes() && p.modes != q.modes);
    }

    void compare_changed(const PassPair& pair) {
        if (one_to_one(pair)) {
            for (std::uint64_t k = 0; k < pair.a.size(); ++k)
                compare_same({Pairing::same,
                              {pair.a.first + k, pair.a.first + k + 1},
                              {pair.b.first + k, pair.b.first + k + 1}});
            return;
        }
        const Pass p = passes_a_[pair.a.first], q = passes_b_[pair.b.first];
        std::vector<PathRegion> regions;
        walk(p.first, passes_a_[pair.a.last - 1].last, q.first, passes_b_[pair.b.last - 1].last,
             regions);
        take(regions, pair.a);
    }

    /// Equal numbers of passes with the same tools and similar lengths: moved or changed one by
    /// one.
    bool one_to_one(const PassPair& pair) {
        if (pair.a.size() != pair.b.size()) return false;
        for (std::uint64_t k = 0; k < pair.a.size(); ++k) {
            const Pass p = passes_a_[pair.a.first + k], q = passes_b_[pair.b.first + k];
            const double most = std::max(0.02 * p.cut_mm, 40.0 * options_.tolerances.position_mm);
            if (p.tool != q.tool || p.cuts() != q.cuts()) return false;
            if (p.modes == q.modes && std::abs(p.cut_mm - q.cut_mm) > most) return false;
        }
        return true;
    }

    void compare_cut(std::uint64_t i, std::uint64_t j) {
        const Pass p = passes_a_[i], q = passes_b_[j];
        std::vector<PathRegion> regions;
        walk(p.cut_first, p.last, q.cut_first, q.last, regions);
        take(regions, {i, i + 1}, false);
    }

    void walk(std::uint64_t a_first, std::uint64_t a_last, std::uint64_t b_first,
              std::uint64_t b_last, std::vector<PathRegion>& regions) {
        walk_.compare({a_first, a_last}, {b_first, b_last}, regions, result_.totals);
    }

    /// Distance of the places where two segments begin.
    double apart_mm(std::uint64_t i, std::uint64_t j) {
        return (seen_a_[i - 1].end().position_mm - seen_b_[j - 1].end().position_mm).norm();
    }

    /// Adds the regions to the clusters and counts the result of each pass of A.
    void take(std::vector<PathRegion>& regions, PassRange range, bool count = true) {
        const auto by_place = [](const PathRegion& p, const PathRegion& q) {
            return p.a.first < q.a.first;
        };
        std::stable_sort(regions.begin(), regions.end(), by_place);
        std::size_t next = 0, added = 0;
        for (std::uint64_t k = range.first; k < range.last; ++k) {
            const Pass pass = passes_a_[k];
            const bool final = k + 1 == range.last;
            for (; added < regions.size() && (final || regions[added].a.first < pass.last); ++added)
                add(kind_of(regions[added].kind), regions[added], pass.tool, {});
            while (next < regions.size() && ends(regions[next]) <= pass.first) ++next;
            bool moved = false, other = false;
            for (std::size_t r = next; r < added; ++r)
                if (ends(regions[r]) > pass.first)
                    (regions[r].kind == RegionKind::moved ? moved : other) = true;
            if (!count) continue;
            ToolRow& row = rows_[pass.tool];
            ++(other ? row.changed : moved ? row.moved : row.equal);
        }
    }

    static std::uint64_t ends(const PathRegion& r) { return std::max(r.a.last, r.a.first + 1); }

    void add_whole(DifferenceKind kind, const PassPair& pair) {
        PathRegion region;
        auto &a = passes_a_, &b = passes_b_;
        // The first cutting block gives the position; an empty side refers to the next cut.
        const auto at = [](SpilledWindow<Pass>& passes, std::uint64_t first, std::uint64_t end) {
            return first < passes.size() ? std::min(passes[first].cut_first, end - 1) : end;
        };
        const std::uint64_t at_a = at(a, pair.a.first, a_.segments().size());
        const std::uint64_t at_b = at(b, pair.b.first, b_.segments().size());
        region.a = {at_a, pair.a.size() > 0 ? std::max(at_a, a[pair.a.last - 1].last) : at_a};
        region.b = {at_b, pair.b.size() > 0 ? std::max(at_b, b[pair.b.last - 1].last) : at_b};
        const int tool = pair.a.size() > 0 ? a[pair.a.first].tool : b[pair.b.first].tool;
        Amount amount;
        for (std::uint64_t k = pair.a.first; k < pair.a.last; ++k) amount.cut_a_mm += a[k].cut_mm;
        for (std::uint64_t k = pair.b.first; k < pair.b.last; ++k) amount.cut_b_mm += b[k].cut_mm;
        if (kind == DifferenceKind::reordered) amount.count = pair.a.size();
        ToolRow& row = rows_[tool];
        row.only_a += kind == DifferenceKind::only_a ? pair.a.size() : 0;
        row.only_b += kind == DifferenceKind::only_b ? pair.b.size() : 0;
        row.reordered += kind == DifferenceKind::reordered ? pair.a.size() : 0;
        if (kind != DifferenceKind::reordered) ++result_.totals.compared;
        add(kind, region, tool, amount);
    }

    /// Contribution of a region to its cluster.
    struct Amount {
        double cut_a_mm = 0.0, cut_b_mm = 0.0;
        std::uint64_t count = 1;
    };

    /// Key of a change; regions with equal keys are the same change.
    using Key = std::tuple<DifferenceKind, int, long, long, long, long, long>;
    Key key_of(DifferenceKind kind, const PathRegion& r, int tool) const {
        const double grid = 4.0 * options_.tolerances.position_mm;
        const auto n = [](double v) { return std::lround(v); };
        const double ratio = r.value_a != 0.0 ? r.value_b / r.value_a : 0.0;
        return {kind,
                tool,
                n(r.shift_mm.x() / grid),
                n(r.shift_mm.y() / grid),
                n(r.shift_mm.z() / grid),
                n(ratio * 1000.0),
                r.value_a == 0.0 ? n(r.value_b) : 0};
    }

    void add(DifferenceKind kind, const PathRegion& region, int tool, const Amount& amount) {
        const bool joins = kind != DifferenceKind::path && kind != DifferenceKind::only_a &&
                           kind != DifferenceKind::only_b && kind != DifferenceKind::reordered;
        PathCluster* cluster = nullptr;
        if (joins) {
            const auto [place, fresh] =
                by_key_.try_emplace(key_of(kind, region, tool), result_.clusters.size());
            if (!fresh && place->second < result_.clusters.size())
                cluster = &result_.clusters[place->second];
        } else if (!result_.clusters.empty() && result_.clusters.back().kind == kind &&
                   result_.clusters.back().last_a.last == region.a.first &&
                   result_.clusters.back().last_b.last == region.b.first) {
            cluster = &result_.clusters.back();
        }
        if (cluster == nullptr && kind == DifferenceKind::path) cluster = last_of_many(tool);
        if (cluster == nullptr) {
            if (result_.clusters.size() >= most_clusters_) {
                ++result_.left_out;
                return;
            }
            result_.clusters.push_back({kind, region, 0, 0.0, 0.0, tool, 0.0, 0.0, {}, {}});
            cluster = &result_.clusters.back();
            if (kind == DifferenceKind::path) by_tool_[tool].push_back(result_.clusters.size() - 1);
        }
        cluster->count += amount.count;
        cluster->position_mm = std::max(cluster->position_mm, region.position_mm);
        cluster->direction_rad = std::max(cluster->direction_rad, region.direction_rad);
        cluster->cut_a_mm += amount.cut_a_mm;
        cluster->cut_b_mm += amount.cut_b_mm;
        cluster->last_a = region.a;
        cluster->last_b = region.b;
    }

    /// If the whole path of a tool differs, the places after the first ones are one cluster.
    PathCluster* last_of_many(int tool) {
        constexpr std::size_t shown_by_tool = 50;
        const std::vector<std::size_t>& clusters = by_tool_[tool];
        return clusters.size() < shown_by_tool ? nullptr : &result_.clusters[clusters.back()];
    }

    void fill_totals() {
        for (const auto& [tool, t] : a_.totals()) {
            ToolRow& row = rows_[tool];
            row.passes_a = t.passes;
            row.cut_a_mm = t.cut_mm;
            row.rapid_a_mm = t.rapid_mm;
            row.cut_a_s = t.cut_s;
            row.feed_a = {t.feed_min, t.feed_max};
            row.spindle_a = {t.spindle_min, t.spindle_max};
        }
        for (const auto& [tool, t] : b_.totals()) {
            ToolRow& row = rows_[tool];
            row.passes_b = t.passes;
            row.cut_b_mm = t.cut_mm;
            row.rapid_b_mm = t.rapid_mm;
            row.cut_b_s = t.cut_s;
            row.feed_b = {t.feed_min, t.feed_max};
            row.spindle_b = {t.spindle_min, t.spindle_max};
        }
        for (auto& [tool, row] : rows_) row.tool = tool;
    }

    const PathRecord &a_, &b_;
    WalkOptions options_;
    std::size_t most_clusters_;
    StretchComparer walk_;
    SpilledWindow<Pass> passes_a_, passes_b_;
    SegmentWindow seen_a_, seen_b_;
    PathComparison result_;
    WalkTotals unused_;
    std::map<int, ToolRow> rows_;
    std::map<Key, std::size_t> by_key_;
    std::map<int, std::vector<std::size_t>> by_tool_;  ///< clusters of kind path
};

}  // namespace

PathComparison compare_paths(const PathRecord& a, const PathRecord& b, const WalkOptions& options,
                             std::size_t most_clusters) {
    if (a.size() == 0 && b.size() == 0) return {};
    return PathComparer(a, b, options, most_clusters).run();
}

}  // namespace trunnion::regression
