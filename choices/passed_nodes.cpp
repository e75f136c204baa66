#include "choices/passed_nodes.h"

#include <algorithm>
#include <cmath>

namespace trunnion::choices {

using offsets::ControlPosition;

namespace {

constexpr double usual_sigmas = 3.0;  ///< of a row: noise does that
constexpr double surely_shown = 4.0;  ///< periods of a feed: it has a row

}  // namespace

void PassedNodes::measure() {
    strides_ = Strides(log_, space_);
    begin_.assign(path_.nodes.size(), 0);
    length_.assign(path_.nodes.size(), 0.0);
    for (std::size_t k = 1; k < begin_.size(); ++k) {
        const bool begins = path_.nodes[k - 1].end;
        begin_[k] = begins ? static_cast<std::uint32_t>(k - 1) : begin_[k - 1];
        length_[k] = (begins ? 0.0 : length_[k - 1]) +
                     std::sqrt(space_.square(path_.nodes[k - 1].at, path_.nodes[k].at));
    }
}

ControlPosition PassedNodes::off_chord(std::size_t i, std::size_t k) const {
    if (log_.rows[i].cut) return {};
    const ControlPosition& from = log_.rows[i].at;
    const ControlPosition& to = log_.rows[std::min(i + 1, log_.rows.size() - 1)].at;
    const ControlPosition& node = path_.nodes[k].at;
    return space_.apart(space_.between(from, to, space_.nearest(from, to, node)), node);
}

ControlPosition PassedNodes::shortened(ControlPosition apart, double by) const {
    const double size = std::sqrt(space_.square(apart, {}));
    const double kept = size > 0.0 ? std::max(0.0, 1.0 - by / size) : 0.0;
    for (double& value : apart.value) value *= kept;
    return apart;
}

/// A feed that takes several periods of the samples, and has no row, was not made, however far
/// apart the samples of rapids are.
double PassedNodes::allowed(std::size_t i, std::size_t k, const Progress& motion) const {
    const double usual = strides_.allowed(i, motion);
    const PathNode& node = path_.nodes[k];
    const double period = log_.period_min * node.feed_mm_min;  // a distance
    const bool shown = period > 0.0 && node.end && length_[k] > surely_shown * log_.lost * period;
    return shown && motion.rows == 0 ? std::min(usual, log_.lost * period) : usual;
}

ControlPosition PassedNodes::missed(std::size_t i, std::size_t k, const Progress& motion) const {
    const ControlPosition apart = off_chord(i, k);
    // A row that only seems to be an end has its noise once, by its own place.
    if (log_.marked && path_.nodes[k].end)
        return log_.rows[i].end ? apart : shortened(apart, usual_sigmas / log_.rows[i].weight);
    return shortened(apart, allowed(i, k, motion));
}

ControlPosition PassedNodes::missed_before(const Progress& motion) const {
    if (motion.begin == 0 || motion.first == 0) return {};
    return shortened(off_chord(motion.first - 1, motion.begin), strides_.allowed_before(motion));
}

PassedNodes::Cost PassedNodes::cost(std::size_t from, std::size_t k, const Progress& motion) const {
    // Of two visits of a block, the second does not begin where the first one ended.
    const bool whole = path_.nodes[k].end && motion.begin == begin_[k];
    const double before = whole ? space_.square(missed_before(motion), {}) : 0.0;
    return {space_.square(missed(from, k, motion), {}), std::max(0.0, before - motion.told)};
}

std::size_t PassedNodes::row_at(const std::vector<std::size_t>& rows, std::size_t i, std::size_t k,
                                const Progress& motion) const {
    const std::size_t next = rows[std::min(i, rows.size() - 1)];
    const std::size_t before = next - std::min<std::size_t>(next, 1);
    if (i == 0) return before;
    const std::size_t last = rows[i - 1];
    if (i == rows.size() || last == before) return last;
    const auto square = [&](std::size_t r) { return space_.square(missed(r, k, motion), {}); };
    return square(before) < square(last) ? before : last;
}

}  // namespace trunnion::choices
