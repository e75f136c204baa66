#include "records/stops.h"

#include <cmath>
#include <utility>

#include "records/travel.h"

namespace trunnion::records {
namespace {

/// Maximum number of moves kept between two readings before moves without information about a side
/// are dropped.
constexpr std::size_t kept_stops = 64;

/// Direction of travel of one axis; 0 at rest.
int direction(const AxisPositions& from, const AxisPositions& to, std::size_t axis) {
    const double step = to.value[axis] - from.value[axis];
    const double rounding = is_rotary(all_axes[axis]) ? rows_rounding.rad : rows_rounding.mm;
    return std::abs(step) < rounding ? 0 : step > 0.0 ? 1 : -1;
}

/// True when a -> c gives the same last direction of every axis as a -> b -> c.
bool passes_through(const AxisPositions& a, const AxisPositions& b, const AxisPositions& c) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        if (a.value[i] == b.value[i] && b.value[i] == c.value[i]) continue;  // most axes of a move
        const int last = direction(b, c, i);
        if (direction(a, c, i) != (last != 0 ? last : direction(a, b, i))) return false;
    }
    return true;
}

}  // namespace

bool same_place(const AxisPositions& a, const AxisPositions& b) {
    for (std::size_t i = 0; i < axis_count; ++i)
        if (direction(a, b, i) != 0) return false;
    return true;
}

void Stops::pass(const Reading& at, const AxisPositions* last) {
    const std::size_t n = stops_.size();
    if (n > 0 && same_place(stops_.back().commanded, at.commanded)) return;
    if (n == 0 && last && same_place(*last, at.commanded)) return;
    if (n >= 2 && stops_[n - 2].test == at.test &&
        passes_through(stops_[n - 2].commanded, stops_[n - 1].commanded, at.commanded)) {
        stops_.back() = at;
        return;
    }
    stops_.push_back(at);
    if (stops_.size() > kept_stops) prune();
}

std::vector<Reading> Stops::before(const AxisPositions& end) const {
    std::vector<Reading> list = stops_;
    if (!list.empty() && same_place(list.back().commanded, end)) list.pop_back();
    return list;
}

/// Keeps the last motion of every axis, and the last position.
void Stops::prune() {
    std::vector<bool> needed(stops_.size(), false);
    needed.front() = needed.back() = true;
    for (std::size_t i = 0; i < axis_count; ++i)
        for (std::size_t k = stops_.size() - 1; k > 0; --k)
            if (direction(stops_[k - 1].commanded, stops_[k].commanded, i) != 0) {
                needed[k] = needed[k - 1] = true;
                break;
            }
    std::vector<Reading> kept;
    for (std::size_t k = 0; k < stops_.size(); ++k)
        if (needed[k]) kept.push_back(std::move(stops_[k]));
    stops_ = std::move(kept);
}

}  // namespace trunnion::records
