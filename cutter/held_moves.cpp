#include "cutter/held_moves.h"

#include "cutter/cutter_alarms.h"
#include "geometry/plane_crossing.h"

namespace trunnion::cutter {

void HeldMoves::emit(const PathOutput& out) {
    try {
        receiver_.take(out);
    } catch (Alarm& alarm) {
        place_alarm(alarm, out.move.marks);
        ahead_.clear();
        throw;
    }
}

void HeldMoves::check_crossing(const PathOutput& next) const {
    for (const PathOutput& earlier : ahead_)
        if (earlier.beside && earlier.block != next.block &&
            !touch(earlier.move.plane, next.move.plane) && cross_over(earlier.way, next.way))
            raise_cutter_alarm(41);
}

void HeldMoves::add(const PathOutput& out) {
    if (out.beside) check_crossing(out);
    ahead_.push_back(out);
    constexpr std::size_t most = 256;  // limit, so that a contour of depth moves alone cannot fill
                                       // the buffer
    const bool hold = (out.beside || !out.move.plane.moves()) && ahead_.size() < most;
    const auto held = static_cast<std::uint64_t>(hold ? blocks_ahead : 0);
    std::size_t done = 0;
    while (done < ahead_.size() && ahead_[done].block + held <= block) emit(ahead_[done++]);
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(done));
}

void HeldMoves::add_event(const PathOutput& event) {
    if (ahead_.empty()) return emit(event);
    ahead_.push_back(event);
    ahead_.back().block = block;
}

void HeldMoves::release() {
    const std::vector<PathOutput> ahead = std::move(ahead_);
    ahead_.clear();
    for (const PathOutput& out : ahead) emit(out);
}

}  // namespace trunnion::cutter
