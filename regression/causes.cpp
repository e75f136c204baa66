#include "regression/causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string_view>

#include "regression/moved_pivot.h"
#include "regression/run_states.h"

namespace trunnion::regression {

namespace {

using Fields = std::vector<std::size_t>;

unsigned explaining(DifferenceKind kind) {
    switch (kind) {
        case DifferenceKind::feed: return explains_feed;
        case DifferenceKind::spindle: return explains_speed;
        case DifferenceKind::coolant: return explains_coolant;
        case DifferenceKind::tool: return explains_tool;
        default: return explains_path;
    }
}

bool is_among(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reported only if no earlier field of the table explains the difference, because these follow
/// from others.
bool follows_from_others(std::string_view name) {
    return is_among(name,
                    {"cutter radius", "tool length", "work zero", "work zero of the rotary axes",
                     "motion", "local shift", "angles of the tilted plane", "feed", "speed"});
}

/// True for fields that may differ for a while before the path shows it.
bool can_lie_hidden(std::string_view name, bool arc) {
    if (name == "plane") return arc;
    return is_among(name,
                    {"units", "feed mode", "radius number", "cutter radius", "level after a cycle",
                     "surface speed", "spindle", "speed", "coolant", "tool", "feed"});
}

/// An item on one side only needs no state as its cause: its block is its position.
bool says_all(DifferenceKind kind) {
    return kind == DifferenceKind::only_a || kind == DifferenceKind::only_b;
}

class Explainer {
  public:
    explicit Explainer(const CauseInput& input)
        : in_(input),
          a_(input.a),
          b_(input.b),
          path_a_(input.a.path.segments()),
          path_b_(input.b.path.segments()) {}

    std::vector<ExplainedCluster> run(const std::vector<PathCluster>& clusters) {
        for (const PathCluster& cluster : clusters) add(cause_of(cluster), cluster);
        if (const auto moved = moved_pivot(clusters, pivot_input())) return one_pivot(*moved);
        return std::move(result_);
    }

  private:
    struct Found {
        std::string cause, group;  ///< clusters with the same group are one difference; empty:
                                   ///< separate
        CausePlace a, b;
    };

    /// The same cause, or the same words at the same place, is one difference.
    void add(const Found& found, const PathCluster& cluster) {
        std::vector<std::string> keys;
        if (!found.group.empty()) keys.push_back(found.group);
        if (!found.cause.empty())
            keys.push_back(fmt::format("{}@{},{}", found.cause, found.a.line, found.b.line));
        for (const std::string& key : keys)
            if (const auto known = groups_.find(key); known != groups_.end())
                return join(result_[known->second].cluster, cluster);
        for (const std::string& key : keys) groups_[key] = result_.size();
        result_.push_back({cluster, found.cause, found.a, found.b});
    }

    static void join(PathCluster& into, const PathCluster& more) {
        into.count += more.count;
        into.position_mm = std::max(into.position_mm, more.position_mm);
        into.direction_rad = std::max(into.direction_rad, more.direction_rad);
        into.cut_a_mm += more.cut_a_mm;
        into.cut_b_mm += more.cut_b_mm;
    }

    Found cause_of(const PathCluster& c) {
        const std::uint64_t i = c.first.a.first, j = c.first.b.first;
        if (c.kind == DifferenceKind::reordered)
            return {"passes reordered", fmt::format("reordered T{}", c.tool), {}, {}};
        if (says_all(c.kind)) return by_own_block(c.kind == DifferenceKind::only_a, i, j);
        const Fields now = differing(i, j, explaining(c.kind));
        Fields fresh = now;
        if (i > 1 && j > 1) {
            const Fields before =
                differing(move_before(path_a_, i), move_before(path_b_, j), explaining(c.kind));
            std::erase_if(fresh, [&](std::size_t f) {
                return std::find(before.begin(), before.end(), f) != before.end();
            });
        }
        if (Found missing = by_missing_block(i, j); !missing.cause.empty()) return missing;
        if (!fresh.empty()) return active_ = by_state(fresh, i, j);
        if (!active_.group.empty() && active_fields_stand(now)) return active_;
        if (Found written = by_blocks(c, i, j); !written.cause.empty()) return written;
        return hidden(now, i, j);
    }

    /// The change of a tool is no move: the states of the block behind it are those of its move.
    static std::uint64_t move_before(SegmentWindow& path, std::uint64_t at) {
        std::uint64_t before = at - 1;
        while (before > 1 && before < path.size() && path[before].kind == SegmentKind::jump)
            --before;
        return before;
    }

    Found hidden(Fields now, std::uint64_t i, std::uint64_t j) {
        const bool arc = i < in_.a.path.segments().size() && path_a_[i].is_arc();
        std::erase_if(
            now, [arc](std::size_t f) { return !can_lie_hidden(snapshot_fields()[f].name, arc); });
        return now.empty() ? Found{} : active_ = by_state(now, i, j);
    }

    bool active_fields_stand(const Fields& now) const {
        return !active_fields_.empty() &&
               std::all_of(active_fields_.begin(), active_fields_.end(), [&](std::size_t f) {
                   return std::find(now.begin(), now.end(), f) != now.end();
               });
    }

    Fields differing(std::uint64_t i, std::uint64_t j, unsigned explains) {
        const ControlSnapshot p = a_.row(a_.at(i)).state, q = b_.row(b_.at(j)).state;
        Fields fields;
        const auto all = snapshot_fields();
        for (std::size_t f = 0; f < all.size(); ++f)
            if ((all[f].explains & explains) != 0 && !same_value(all[f].value(p), all[f].value(q)))
                fields.push_back(f);
        return fields;
    }

    Found by_state(Fields fields, std::uint64_t i, std::uint64_t j) {
        active_fields_ = fields;
        const auto first_order = [](std::size_t f) {
            return !follows_from_others(snapshot_fields()[f].name);
        };
        if (std::any_of(fields.begin(), fields.end(), first_order))
            std::erase_if(fields, [&](std::size_t f) { return !first_order(f); });
        Found found;
        for (std::size_t k = 0; k < std::min<std::size_t>(2, fields.size()); ++k) {
            const std::string said = say(snapshot_fields()[fields[k]], i, j, k == 0, found);
            found.cause += (k > 0 ? ", " : "") + said;
        }
        found.group = found.cause;
        const bool value_alone = fields.size() == 1 &&
                                 std::string_view(snapshot_fields()[fields[0]].name) == "work zero";
        if (value_alone)
            if (const auto written = in_.gaps.first_that_writes()) {
                found.cause = written->what.empty() ? found.cause : written->what;
                found.a.line = static_cast<std::uint32_t>(written->line_a);
                found.b.line = static_cast<std::uint32_t>(written->line_b);
            }
        return found;
    }

    /// One field in words; the first one gives the position.
    std::string say(const SnapshotField& field, std::uint64_t i, std::uint64_t j, bool places,
                    Found& found) {
        const std::uint64_t at_a = a_.at(i), at_b = b_.at(j);
        const std::uint64_t entry_a = a_.entry(field, at_a), entry_b = b_.entry(field, at_b);
        const StateRow row_a = a_.row(entry_a), row_b = b_.row(entry_b);
        const auto value_a = field.value(row_a.state), value_b = field.value(row_b.state);
        const bool a_changed =
            entry_a > 0 && same_value(field.value(a_.row(entry_a - 1).state), value_b);
        const bool b_changed =
            entry_b > 0 && same_value(field.value(b_.row(entry_b - 1).state), value_a);
        if (places) {
            found.a = {row_a.line, row_a.program};
            found.b = {row_b.line, row_b.program};
            // A side without this change has no block for it; the next moving block is used.
            if (a_changed && !b_changed) found.b = beside(path_b_, row_a.first_segment, i, j);
            if (b_changed && !a_changed) found.a = beside(path_a_, row_b.first_segment, j, i);
        }
        const std::string text_a = field.text(row_a.state), text_b = field.text(row_b.state);
        if (a_changed && !b_changed && !written_in_b(row_a.line, text_b))
            return fmt::format("{} is missing in B, {} stays in force", text_a, text_b);
        return fmt::format("{} instead of {}", text_b, text_a);
    }

    /// True when B's block in place of A's line sets it, although it was already active.
    bool written_in_b(std::uint32_t line_a, const std::string& text) {
        const auto cause = in_.gaps.before(static_cast<int>(line_a), 0);
        return cause && cause->line_a == static_cast<int>(line_a) &&
               cause->what.find(text + " ") != std::string::npos;
    }

    /// The block of the other side at the same distance before the difference.
    static CausePlace beside(SegmentWindow& path, std::uint64_t entry, std::uint64_t own,
                             std::uint64_t other) {
        if (path.size() < 2) return {};
        const std::uint64_t back = own > entry ? own - entry : 0;
        const std::uint64_t at = other > back ? other - back : 1;
        const Segment s = path[std::min(at, path.size() - 1)];
        return {s.line, s.program};
    }

    /// The moving block exists on one side only: the states at the next block do not explain
    /// anything.
    Found by_missing_block(std::uint64_t i, std::uint64_t j) {
        const CausePlace a = place(path_a_, i), b = place(path_b_, j);
        const auto cause =
            in_.gaps.block_missing(static_cast<int>(a.line), static_cast<int>(b.line));
        return cause ? found_at(*cause, a, b) : Found{};
    }

    static Found found_at(const WrittenCause& cause, CausePlace a, CausePlace b) {
        Found found;
        found.cause = cause.what;
        found.a = {static_cast<std::uint32_t>(cause.line_a), a.program};
        found.b = {static_cast<std::uint32_t>(cause.line_b), b.program};
        return found;
    }

    /// The block of a pass on one side only, if the other side has it with other words (K2 instead
    /// of K3).
    Found by_own_block(bool in_a, std::uint64_t i, std::uint64_t j) {
        const CausePlace a = place(path_a_, i), b = place(path_b_, j);
        const auto cause =
            in_.gaps.at(in_a ? static_cast<int>(a.line) : 0, in_a ? 0 : static_cast<int>(b.line));
        return cause ? found_at(*cause, a, b) : Found{};
    }

    /// G41 or G42 on either side: the following blocks change the end of this one.
    bool beside_contour(std::uint64_t i, std::uint64_t j) {
        constexpr std::size_t cutter = 7;
        return a_.row(a_.at(i)).state.modal10[cutter] > 400 ||
               b_.row(b_.at(j)).state.modal10[cutter] > 400;
    }

    /// The last written change before these lines; under G41 and G42, or if there is none, one
    /// shortly after them.
    std::optional<WrittenCause> written_near(int line_a, int line_b, bool read_ahead) {
        constexpr int ahead = 3;
        auto behind = in_.gaps.before(line_a, line_b);
        const bool here = behind && behind->line_a == line_a && behind->line_b == line_b;
        if (here || (behind && !read_ahead)) return behind;
        auto next = in_.gaps.before(line_a + ahead, line_b + ahead);
        const bool follows = next && (next->line_a > line_a || next->line_b > line_b);
        return follows && !next->what.empty() ? next : behind;
    }

    Found by_blocks(const PathCluster& c, std::uint64_t i, std::uint64_t j) {
        const CausePlace a = place(path_a_, i), b = place(path_b_, j);
        const int line_a = static_cast<int>(a.line), line_b = static_cast<int>(b.line);
        const auto cause = written_near(line_a, line_b, beside_contour(i, j));
        if (!cause || cause->what.empty()) return {};
        Found found = found_at(*cause, a, b);
        if (c.kind != DifferenceKind::feed) found.group = cause->name;
        return found;
    }

    static CausePlace place(SegmentWindow& path, std::uint64_t at) {
        if (path.size() == 0) return {};
        const Segment s = path[std::min(at, path.size() - 1)];
        return {s.line, s.program};
    }

    MovedPivotInput pivot_input() const { return {in_.a, in_.b, in_.transform, in_.tolerances}; }

    std::vector<ExplainedCluster> one_pivot(const MovedPivot& moved) {
        std::vector<ExplainedCluster> left;
        const auto is_moved = [](const ExplainedCluster& e) {
            return e.cluster.kind == DifferenceKind::moved;
        };
        const auto first = std::find_if(result_.begin(), result_.end(), is_moved);
        first->cause = moved.text;
        double largest_mm = 0.0;
        for (const ExplainedCluster& e : result_)
            if (is_moved(e)) largest_mm = std::max(largest_mm, e.cluster.position_mm);
        for (ExplainedCluster& e : result_) {
            const bool between =  // the paths between shifted sections
                e.cluster.kind == DifferenceKind::path &&
                (e.cluster.position_mm < 1.5 * largest_mm ||
                 explains(moved, e.cluster, pivot_input()));
            if (&e == &*first) continue;
            if (is_moved(e) || between)
                join(first->cluster, e.cluster);
            else
                left.push_back(std::move(e));
        }
        const auto behind = [&](const ExplainedCluster& e) {
            return e.cluster.first.a.first > first->cluster.first.a.first;
        };
        left.insert(std::find_if(left.begin(), left.end(), behind), *first);
        return left;
    }

    const CauseInput& in_;
    RunStates a_, b_;
    SegmentWindow path_a_, path_b_;
    std::vector<ExplainedCluster> result_;
    std::map<std::string, std::size_t> groups_;
    Found active_;
    Fields active_fields_;
};

}  // namespace

std::vector<ExplainedCluster> explain(const std::vector<PathCluster>& clusters,
                                      const CauseInput& input) {
    return Explainer(input).run(clusters);
}

std::string frame_hint(const RecordedRun& run, const char* side) {
    constexpr std::uint64_t looked_at = 100000;
    constexpr std::size_t length = 8;
    SpilledWindow<StateRow> rows(run.states);
    SpilledWindow<RotaryRow> turns(run.rotaries);
    std::uint64_t turn = 0;
    for (std::uint64_t k = 1; k < std::min(looked_at, rows.size()); ++k) {
        const StateRow row = rows[k];
        const int code = row.state.modal10[length], before = rows[k - 1].state.modal10[length];
        if ((code != 434 && code != 435) || code == before) continue;
        while (turn + 1 < turns.size() && turns[turn + 1].first_segment < row.first_segment) ++turn;
        const auto deg = turns[turn].rotary_deg;
        if (deg == std::array<double, 3>{}) continue;
        return fmt::format(
            "{} line {}: {} begins with the rotary axes at A{:g} B{:g} C{:g}; its coordinates are "
            "read in the work frame as it lies then (tcp_frame of the setup); a post that means "
            "the "
            "frame at rotary zero writes other ones",
            side, row.line, code == 434 ? "G43.4" : "G43.5", deg[0], deg[1], deg[2]);
    }
    return {};
}

}  // namespace trunnion::regression
