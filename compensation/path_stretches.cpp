#include "compensation/path_stretches.h"

#include <algorithm>
#include <cmath>

#include "emulator/follow_move.h"

namespace trunnion::compensation {
namespace {

constexpr double near_s = 1e-4;  ///< step to the neighbours that give a direction

Travel direction_at(const motion::AxisMove& move, double s) {
    const AxisPositions a = move.at(std::max(0.0, s - near_s)),
                        b = move.at(std::min(1.0, s + near_s));
    Travel travel{};
    for (std::size_t i = 0; i < axis_count; ++i)
        if (const double way = b.value[i] - a.value[i]; std::abs(way) > records::path_rounding.mm)
            travel[i] = way > 0.0 ? 1 : -1;
    return travel;
}

/// Reversal point of axis i between a, where it moves in direction `sign`, and b, where it moves
/// back.
double turning_place(const motion::AxisMove& move, std::size_t i, signed char sign, double a,
                     double b) {
    while (b - a > 1e-9) {
        const double middle = 0.5 * (a + b);
        (direction_at(move, middle)[i] == sign ? a : b) = middle;
    }
    return 0.5 * (a + b);
}

std::vector<double> turning_places(const motion::AxisMove& move) {
    std::vector<double> places{0.0};
    const int steps =
        move.arc ? std::max(16, static_cast<int>(16.0 * std::abs(move.arc->turns))) : 32;
    Travel last = direction_at(move, 0.0);
    std::array<double, axis_count> last_s{};
    for (int k = 1; k <= steps; ++k) {
        const double s = static_cast<double>(k) / steps;
        const Travel now = direction_at(move, s);
        for (std::size_t i = 0; i < axis_count; ++i) {
            if (now[i] == 0) continue;
            if (last[i] == -now[i]) places.push_back(turning_place(move, i, last[i], last_s[i], s));
            last[i] = now[i];
            last_s[i] = s;
        }
    }
    places.push_back(1.0);
    std::sort(places.begin(), places.end());
    const auto same = [](double a, double b) { return b - a < near_s; };
    places.erase(std::unique(places.begin(), places.end(), same), places.end());
    places.back() = 1.0;
    return places;
}

}  // namespace

std::vector<PathStretch> path_stretches(const motion::AxisMove& move) {
    if (!move.arc && !move.curve) {
        PathStretch whole;
        for (std::size_t i = 0; i < axis_count; ++i)
            if (const double way = move.to.value[i] - move.from.value[i];
                std::abs(way) > records::path_rounding.mm)
                whole.travel[i] = way > 0.0 ? 1 : -1;
        return {whole};
    }
    const std::vector<double> places = turning_places(move);
    std::vector<PathStretch> stretches;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
        stretches.push_back(
            {places[k], places[k + 1], direction_at(move, 0.5 * (places[k] + places[k + 1]))});
    return stretches;
}

}  // namespace trunnion::compensation
