#include "choices/shift_twins.h"

#include <algorithm>
#include <cmath>

namespace trunnion::choices {

namespace {

using setup::Setup;

constexpr double twin_shift = 0.013, twin_step = 0.017;  ///< mm or deg: another one for each axis
constexpr double equal_shift = 1e-6;                     ///< mm or deg: rounding of sums
const std::string external_name = "external", zero_name = "machine zero";

/// The axes of a store's numbers: "G54.X"; those of any shift for others.
std::vector<Axis> axes_of_numbers(const GapCause& store) {
    std::vector<Axis> out;
    for (const FittedNumber& number : store.numbers) {
        const std::size_t point = number.name.rfind('.');
        if (point == std::string::npos || point + 2 != number.name.size()) continue;
        if (const auto axis = axis_of(number.name.back())) out.push_back(*axis);
    }
    if (out.empty()) out = {Axis::X, Axis::Y, Axis::Z};
    return out;
}

/// All nodes of `b` are as far from those of `a`: the start is not commanded.
bool is_whole_shift(const ControlPath& a, const ControlPath& b) {
    if (a.nodes.size() != b.nodes.size() || a.nodes.size() < 2) return false;
    const auto apart = [&](std::size_t node, std::size_t axis) {
        return b.nodes[node].at.value[axis] - a.nodes[node].at.value[axis];
    };
    for (std::size_t node = 2; node < a.nodes.size(); ++node)
        for (std::size_t axis = 0; axis < axis_count; ++axis)
            if (std::abs(apart(node, axis) - apart(1, axis)) > equal_shift) return false;
    return true;
}

/// The first move is shifted in each of the axes.
bool shifts_each(const ControlPath& a, const ControlPath& b, const std::vector<Axis>& axes) {
    return a.nodes.size() > 1 && b.nodes.size() > 1 &&
           std::all_of(axes.begin(), axes.end(), [&](Axis axis) {
               return std::abs(a.nodes[1].at[axis] - b.nodes[1].at[axis]) > equal_shift;
           });
}

std::vector<std::string> names_of(const ShiftTwins& twins) {
    std::vector<std::string> out;
    if (twins.local) out.emplace_back("G52");
    if (twins.preset) out.emplace_back("G92");
    if (twins.zero) out.push_back(zero_name);
    return out;
}

bool is_named(const std::vector<GapCause>& causes, const std::string& name) {
    return std::any_of(causes.begin(), causes.end(), [&](const GapCause& cause) {
        return cause.name == name ||
               std::find(cause.rivals.begin(), cause.rivals.end(), name) != cause.rivals.end();
    });
}

/// Stores that together shift the whole path.
void share_with_zero(const ControlPath& before, const ControlPath& after,
                     std::vector<GapCause>& causes) {
    const bool stores = std::none_of(causes.begin(), causes.end(),
                                     [](const GapCause& cause) { return cause.numbers.empty(); });
    if (!stores || !is_whole_shift(before, after)) return;
    for (GapCause& cause : causes) {
        cause.probability *= 0.5;
        cause.rivals.push_back(zero_name);
    }
}

}  // namespace

ShiftTwins twins_of_external(const Comparer& comparer, const FittedControl& control,
                             const std::vector<Axis>& axes) {
    const auto path_with = [&](offsets::OffsetVector offsets::WorkOffsets::*store) {
        Setup other = control.setup;
        double by = twin_shift;
        for (const Axis axis : axes) {
            (other.stores.work.*store)[axis] += by;
            by += twin_step;
        }
        return comparer.path(other);
    };
    using offsets::WorkOffsets;
    const ControlPath path = path_with(&WorkOffsets::external);
    if (same_way(path, control.run.path)) return {};
    return {same_way(path_with(&WorkOffsets::local), path),
            same_way(path_with(&WorkOffsets::preset), path),
            is_whole_shift(control.run.path, path) && shifts_each(control.run.path, path, axes)};
}

void share_with_twins(const Comparer& comparer, const Setup& start, const GapSearch& found,
                      std::vector<GapCause>& causes) {
    if (causes.empty()) return;
    if (!is_named(causes, external_name))
        return share_with_zero(comparer.path(start), found.run.path, causes);
    const std::vector<GapCause> before = causes;
    for (GapCause& cause : causes) {
        const auto at = std::find(cause.rivals.begin(), cause.rivals.end(), external_name);
        const bool own = cause.name == external_name;
        if (!own && at == cause.rivals.end()) continue;
        std::vector<std::string> names =
            names_of(twins_of_external(comparer, {found.setup, found.run}, axes_of_numbers(cause)));
        std::erase_if(names, [&](const std::string& name) { return is_named(before, name); });
        if (own) cause.probability /= 1.0 + static_cast<double>(names.size());
        cause.rivals.insert(own ? cause.rivals.begin() : at + 1, names.begin(), names.end());
    }
}

}  // namespace trunnion::choices
