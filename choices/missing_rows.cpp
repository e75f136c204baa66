#include "choices/missing_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t rows_for_jumps = 50;  ///< of a log that shows its sampling
constexpr std::size_t rows_a_jump = 100;    ///< with more jumps they are its way of sampling
constexpr std::size_t most_jumps = 10;
constexpr double far_longer = 4.0;  ///< than every other distance of samples
constexpr double straight = 0.1;    ///< of the shorter distance: a row beside its neighbours' chord
constexpr double like = 1.5;        ///< ratio of two distances at about the same speed
constexpr double most_like = 0.75;  ///< part of the rows of even samples
constexpr std::size_t told_jumps = 3;
constexpr double steady = 1.2;           ///< ratio of the distances before and behind
constexpr double is_multiple = 0.2;      ///< of a distance: off a whole number of them
constexpr double far_from_noise = 10.0;  ///< sigmas of a distance that is measured
constexpr std::size_t least_places = 5;  ///< with single rows missing
constexpr double mostly = 0.8;           ///< of the longer distances: whole numbers
constexpr double most_lost = 8.0;        ///< distances

struct Sampling {
    bool dense;
    bool even;
};

/// Dense: most rows lie on straight ways with their neighbours. In a log with few rows a block a
/// long distance is nothing special.
Sampling sampling_of(const LogView& view, const Space& space, const std::vector<double>& step) {
    std::size_t on_way = 0, moving = 0, alike = 0;
    for (std::size_t i = 1; i < step.size(); ++i) {
        const auto [shorter, longer] = std::minmax(step[i - 1], step[i]);
        if (shorter <= 0.0) continue;
        ++moving;
        const auto &a = view.rows[i - 1].at, &here = view.rows[i].at, &b = view.rows[i + 1].at;
        const double apart = space.square(space.between(a, b, space.nearest(a, b, here)), here);
        if (apart > straight * straight * shorter * shorter) continue;
        ++on_way;
        alike += longer <= like * shorter ? 1 : 0;
    }
    return {2 * on_way > moving,
            static_cast<double>(alike) > most_like * static_cast<double>(on_way)};
}

/// Distances of samples from one row to the next where single rows are missing: on a straight way
/// at a steady speed they are whole numbers. 1: none are missing.
double lost_in_a_row(const LogView& view, const Space& space, const std::vector<double>& step) {
    std::size_t whole = 0, longer = 0;
    double most = 1.0;
    for (std::size_t i = 1; i + 1 < step.size(); ++i) {
        const auto [slow, fast] = std::minmax(step[i - 1], step[i + 1]);
        if (slow * view.rows[i].weight < far_from_noise || fast > steady * slow) continue;
        const double ratio = 2.0 * step[i] / (slow + fast);
        if (ratio < like) continue;
        const double chord = std::sqrt(space.square(view.rows[i - 1].at, view.rows[i + 2].at));
        if (chord < step[i - 1] + step[i] + step[i + 1] - straight * slow) continue;
        ++longer;
        if (ratio > most_lost || std::abs(ratio - std::round(ratio)) > is_multiple) continue;
        ++whole;
        most = std::max(most, std::round(ratio));
    }
    const bool single =
        whole >= least_places && static_cast<double>(whole) >= mostly * static_cast<double>(longer);
    return single ? most : 1.0;
}

/// The least distance that is a jump; infinite: none.
double jump_from(const std::vector<double>& step) {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (step.size() < rows_for_jumps) return none;
    std::vector<double> largest = step;
    const std::size_t most = std::min(most_jumps, step.size() / rows_a_jump + 1);
    std::partial_sort(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(most) + 1,
                      largest.end(), std::greater<>());
    double from = none;
    for (std::size_t k = 0; k < most; ++k)
        if (largest[k] > far_longer * largest[k + 1]) from = largest[k];
    // A rapid move has several long distances one after the other.
    for (std::size_t i = 1; i < step.size(); ++i)
        if (step[i - 1] >= from && step[i] >= from) return none;
    return from;
}

}  // namespace

std::vector<std::string> mark_missing_rows(LogView& view) {
    if (view.ends) return {};
    const Space space(view.axes);
    std::vector<double> step;
    for (std::size_t i = 1; i < view.rows.size(); ++i)
        step.push_back(std::sqrt(space.square(view.rows[i - 1].at, view.rows[i].at)));
    const Sampling sampling = sampling_of(view, space, step);
    view.even = sampling.even;
    view.lost = lost_in_a_row(view, space, step);
    const double from = sampling.dense ? jump_from(step) : std::numeric_limits<double>::infinity();
    std::vector<double> others(3, 0.0);
    std::vector<std::size_t> jumps;
    for (std::size_t i = 0; i < step.size(); ++i) {
        const bool jump = step[i] >= from;
        if (jump)
            jumps.push_back(i);
        else if (!view.rows[i].cut)
            others.push_back(step[i]);
        view.rows[i].cut = view.rows[i].cut || jump;
    }
    std::nth_element(others.begin(), others.begin() + 2, others.end(), std::greater<>());
    view.spacing = view.lost * others[2];
    std::vector<std::string> notes;
    for (std::size_t k = 0; k < std::min(told_jumps, jumps.size()); ++k)
        notes.push_back(fmt::format(
            "rows are missing after line {} of the log ({:.3g} mm to the next row): what the "
            "control does there is not judged",
            view.rows[jumps[k]].line, step[jumps[k]]));
    if (jumps.size() > told_jumps)
        notes.push_back(fmt::format("rows are missing at {} further places of the log",
                                    jumps.size() - told_jumps));
    return notes;
}

}  // namespace trunnion::choices
