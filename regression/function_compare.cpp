#include "regression/function_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace trunnion::regression {

namespace {

KeyedLines keys_of(const FunctionEvents& events) {
    KeyedLines keys;
    SpilledWindow<FunctionEvent> window(events);
    for (std::uint64_t k = 0; k < events.size(); ++k) keys.append({window[k].key, window[k].line});
    return keys;
}

/// Coolant and all other functions are two sequences: M8 M3 and M3 M8 at one place are equal.
FunctionEvents kept(const FunctionEvents& all, bool stores, bool coolant) {
    FunctionEvents events;
    SpilledWindow<FunctionEvent> window(all);
    for (std::uint64_t k = 0; k < all.size(); ++k) {
        const FunctionKind kind = window[k].kind;
        if ((kind == FunctionKind::coolant) != coolant) continue;
        if (stores || kind != FunctionKind::store) events.append(window[k]);
    }
    return events;
}

double event_distance(const FunctionEvent& p, const FunctionEvent& q) {
    return std::hypot(p.tip_mm[0] - q.tip_mm[0], p.tip_mm[1] - q.tip_mm[1],
                      p.tip_mm[2] - q.tip_mm[2]);
}

class FunctionComparer {
  public:
    FunctionComparer(FunctionSide a, FunctionSide b, const FunctionCompareOptions& options,
                     bool coolant, Comparison& result)
        : side_a_(a),
          side_b_(b),
          kept_a_(kept(a.run.functions, options.stores, coolant)),
          kept_b_(kept(b.run.functions, options.stores, coolant)),
          a_(kept_a_),
          b_(kept_b_),
          options_(options),
          result_(result) {}

    bool run() {
        const KeyedLines keys_a = keys_of(kept_a_), keys_b = keys_of(kept_b_);
        KeyGap before;
        key_gaps(keys_a, keys_b, [&](const KeyGap& gap) {
            matched(before.a_last, gap.a_first, before.b_last);
            gap_between(gap);
            before = gap;
        });
        matched(before.a_last, kept_a_.size(), before.b_last);
        result_.compared += std::max(kept_a_.size(), kept_b_.size());
        return same_writes_;
    }

  private:
    void matched(std::uint64_t first, std::uint64_t last, std::uint64_t b_first) {
        for (std::uint64_t k = first; k < last; ++k) pair(k, b_first + (k - first));
    }

    void pair(std::uint64_t i, std::uint64_t j) {
        const FunctionEvent p = a_[i], q = b_[j];
        if (p.kind == FunctionKind::dwell &&
            std::abs(p.value - q.value) >
                options_.tolerances.time_ratio * std::max(p.value, q.value) + 1e-4)
            add(fmt::format("{} -> {:g} s", text_of(p), q.value), i, j, p.value, q.value);
        else if (options_.places && p.placed && q.placed && elsewhere(p, q))
            add(fmt::format("{} stands at another place of the path", text_of(p)), i, j, 0.0, 0.0);
        cut_a_mm_ = p.cut_mm;
        cut_b_mm_ = q.cut_mm;
    }

    /// Compares cut lengths since the last common function; the tolerance allows for chords being
    /// shorter than arcs.
    bool elsewhere(const FunctionEvent& p, const FunctionEvent& q) const {
        const double cut_a = p.cut_mm - cut_a_mm_, cut_b = q.cut_mm - cut_b_mm_;
        if (std::abs(cut_a - cut_b) > 0.01 * std::max(cut_a, cut_b) + 0.05) return true;
        if (side_a_.run.path.modes() != side_b_.run.path.modes()) return false;
        return event_distance(p, q) > 4.0 * options_.tolerances.position_mm;
    }

    static bool writes(SpilledWindow<FunctionEvent>& events, std::uint64_t first,
                       std::uint64_t last) {
        for (std::uint64_t k = first; k < last; ++k)
            if (events[k].kind == FunctionKind::store) return true;
        return false;
    }

    void gap_between(const KeyGap& gap) {
        if (writes(a_, gap.a_first, gap.a_last) || writes(b_, gap.b_first, gap.b_last))
            same_writes_ = false;
        const std::uint64_t in_a = gap.a_last - gap.a_first, in_b = gap.b_last - gap.b_first;
        const std::uint64_t both = std::min(in_a, in_b);
        for (std::uint64_t k = 0; k < both; ++k) {
            const std::uint64_t i = gap.a_first + k, j = gap.b_first + k;
            add(fmt::format("{} instead of {}", text_of(b_[j]), text_of(a_[i])), i, j, a_[i].value,
                b_[j].value);
        }
        for (std::uint64_t k = gap.a_first + both; k < gap.a_last; ++k)
            if (!ends_only(a_[k], exact_only_a_))
                add(fmt::format("{} is missing in B", text_of(a_[k])), k, gap.b_last, 0.0, 0.0);
        for (std::uint64_t k = gap.b_first + both; k < gap.b_last; ++k)
            if (!ends_only(b_[k], exact_only_b_))
                add(fmt::format("{} is only in B", text_of(b_[k])), gap.a_last, k, 0.0, 0.0);
    }

    /// The end of an exact stop that only this side started is not a separate difference.
    static bool ends_only(const FunctionEvent& e, bool& begun) {
        if (e.kind != FunctionKind::exact_stop) return false;
        const bool ends = begun && e.value == 0.0;
        begun = e.value != 0.0;
        return ends;
    }

    /// The path comparison may have reported it: the same words, or an offset that is not set as
    /// the cause of a move ("G57 instead of G55").
    bool told_by_path(const std::string& what) const {
        const std::size_t end = what.find(" (not set)");
        const std::string offset = end == std::string::npos ? "" : what.substr(0, end) + " instead";
        return std::any_of(result_.differences.begin(), result_.differences.end(),
                           [&](const Difference& d) {
                               return d.cause.starts_with(what) ||
                                      (!offset.empty() && d.cause.starts_with(offset));
                           });
    }

    /// `i` or `j` may refer to the function after a missing one; it gives the position.
    void add(const std::string& what, std::uint64_t i, std::uint64_t j, double value_a,
             double value_b) {
        if (told_by_path(what)) return;
        const auto known = known_.find(what);
        if (known != known_.end()) {
            ++result_.differences[known->second].count;
            return;
        }
        if (result_.differences.size() >= options_.most_differences) {
            ++result_.differences_left_out;
            return;
        }
        Difference d;
        d.kind = DifferenceKind::function;
        d.what = what;
        d.a = place(a_, side_a_, i);
        d.b = place(b_, side_b_, j);
        d.value_a = value_a;
        d.value_b = value_b;
        known_[what] = result_.differences.size();
        result_.differences.push_back(std::move(d));
    }

    static ComparePlace place(SpilledWindow<FunctionEvent>& events, FunctionSide side,
                              std::uint64_t at) {
        ComparePlace p;
        p.program = side.lines.main_name();
        if (events.size() == 0) return p;
        const FunctionEvent e = events[std::min(at, events.size() - 1)];
        if (e.line == 0) return p;
        const auto& programs = side.run.path.programs();
        if (e.program < programs.size()) p.program = programs[e.program];
        p.line = p.last_line = static_cast<int>(e.line);
        side.lines.show(p);
        return p;
    }

    FunctionSide side_a_, side_b_;
    FunctionEvents kept_a_, kept_b_;
    SpilledWindow<FunctionEvent> a_, b_;
    FunctionCompareOptions options_;
    Comparison& result_;
    std::map<std::string, std::size_t> known_;  ///< differences so far, by their sentence
    bool same_writes_ = true;
    bool exact_only_a_ = false, exact_only_b_ = false;
    double cut_a_mm_ = 0.0, cut_b_mm_ = 0.0;  ///< at the last common function
};

}  // namespace

bool compare_functions(FunctionSide a, FunctionSide b, const FunctionCompareOptions& options,
                       Comparison& result) {
    const bool same_writes = FunctionComparer(a, b, options, false, result).run();
    FunctionComparer(a, b, options, true, result).run();
    return same_writes;
}

}  // namespace trunnion::regression
