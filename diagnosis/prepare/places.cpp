#include "diagnosis/prepare/places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace trunnion::diagnosis {
namespace {

constexpr double least_of_response = 0.1;  ///< mm for 1 mm of a linear axis
constexpr double least_response =
    1e-6;  ///< of a rotary one, whose arm may be short: less is arithmetic
constexpr double same_position = 1e-6;  ///< of the range

double response_of(const Prepared& p, std::size_t row, Axis axis) {
    return std::abs(p.base.gradient[row].axis[axis]);
}

/// What is free beside a reading: readings with the same share it.
using SharedZero = std::tuple<records::Device, int, int, int, std::size_t>;
SharedZero shared_of(const Prepared& p, std::size_t row) {
    const emulator::Contact& c = p.replay.contact(row);
    return {c.device, c.zero, c.artefact, c.instrument, p.replay.session(row)};
}

}  // namespace

Range range_of(const Prepared& p, Axis axis) {
    Range range{HUGE_VAL, -HUGE_VAL};
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        range.low = std::min(range.low, p.replay.sample(i).position[axis]);
        range.high = std::max(range.high, p.replay.sample(i).position[axis]);
    }
    return range;
}

namespace {

/// Takes out rows beside whose zero the axis stands still in all that are marked.
std::vector<bool> where_it_moves(const Prepared& p, Axis axis, std::vector<bool> marked) {
    std::map<SharedZero, Range> spans;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        if (!marked[i]) continue;
        Range& range = spans.try_emplace(shared_of(p, i), Range{HUGE_VAL, -HUGE_VAL}).first->second;
        range.low = std::min(range.low, p.replay.sample(i).position[axis]);
        range.high = std::max(range.high, p.replay.sample(i).position[axis]);
    }
    const double same = same_position * range_of(p, axis).span();
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        marked[i] = marked[i] && spans[shared_of(p, i)].span() > same;
    return marked;
}

}  // namespace

std::vector<bool> tells_place(const Prepared& p, Axis axis) {
    const double least = p.table.names.is_rotary(axis) ? least_response : least_of_response;
    std::vector<bool> tells(p.replay.size());
    for (std::size_t i = 0; i < p.replay.size(); ++i) tells[i] = response_of(p, i, axis) >= least;
    return where_it_moves(p, axis, std::move(tells));
}

std::vector<bool> sees_moves(const Prepared& p, Axis axis) {
    return where_it_moves(p, axis, std::vector<bool>(p.replay.size(), true));
}

std::vector<Place> telling_places(const Prepared& p, Axis axis) {
    const std::vector<bool> tells = tells_place(p, axis);
    std::vector<Place> all;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        if (!tells[i]) continue;
        const double part = response_of(p, i, axis) / p.base.sigma_mm(static_cast<Eigen::Index>(i));
        all.push_back({p.replay.sample(i).position[axis], part * part});
    }
    std::sort(all.begin(), all.end(),
              [](const Place& a, const Place& b) { return a.position < b.position; });
    if (all.empty()) return all;
    const double same = same_position * (all.back().position - all.front().position);
    std::vector<Place> places{all.front()};
    for (std::size_t k = 1; k < all.size(); ++k) {
        if (all[k].position - places.back().position <= same)
            places.back().weight += all[k].weight;
        else
            places.push_back(all[k]);
    }
    return places;
}

std::vector<double> positions_at(const std::vector<Place>& places) {
    std::vector<double> list;
    for (const Place& place : places) list.push_back(place.position);
    return list;
}

double effective_count(const std::vector<Place>& places) {
    double sum = 0.0, squares = 0.0;
    for (const Place& place : places) {
        sum += place.weight;
        squares += place.weight * place.weight;
    }
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

}  // namespace trunnion::diagnosis
