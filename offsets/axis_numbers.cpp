#include "offsets/axis_numbers.h"

#include <algorithm>

namespace trunnion::offsets {

std::optional<Axis> axis_of_number(const Parameters& parameters, int number,
                                   const std::vector<Axis>& order) {
    const auto names = parameters.entry.find(1020);
    if (names != parameters.entry.end()) {
        const auto name = names->second.by_axis.find(number);
        if (name != names->second.by_axis.end())
            return axis_of(static_cast<char>(static_cast<int>(name->second)));
    }
    const auto count = order.empty() ? axis_count : order.size();
    if (number < 1 || static_cast<std::size_t>(number) > count) return std::nullopt;
    const auto index = static_cast<std::size_t>(number - 1);
    return order.empty() ? all_axes[index] : order[index];
}

int number_of_axis(Axis axis, const std::vector<Axis>& order) {
    if (order.empty()) return static_cast<int>(index_of(axis)) + 1;
    const auto at = std::find(order.begin(), order.end(), axis);
    return at == order.end() ? 0 : static_cast<int>(at - order.begin()) + 1;
}

int number_of_named_axis(const Parameters& parameters, Axis axis, const std::vector<Axis>& order) {
    const auto names = parameters.entry.find(1020);
    if (names != parameters.entry.end())
        for (const auto& [number, code] : names->second.by_axis)
            if (static_cast<int>(code) == letter_of(axis)) return number;
    return number_of_axis(axis, order);
}

std::optional<double> value_of_axis(const Parameters& parameters, int parameter, int number) {
    const auto it = parameters.entry.find(parameter);
    if (it == parameters.entry.end()) return std::nullopt;
    const auto own = it->second.by_axis.find(number);
    if (own != it->second.by_axis.end()) return own->second;
    return it->second.by_axis.empty() ? std::optional(it->second.value) : std::nullopt;
}

ParallelAxes parallel_axes(const Parameters& parameters, const std::vector<Axis>& order) {
    ParallelAxes out;
    const auto given = parameters.entry.find(1022);
    if (given == parameters.entry.end()) return out;
    for (const auto& [number, value] : given->second.by_axis) {
        const auto axis = axis_of_number(parameters, number, order);
        if (!axis || index_of(*axis) < index_of(Axis::U) || value < 5.0 || value > 7.0) continue;
        out.beside[index_of(*axis) - index_of(Axis::U)] = static_cast<signed char>(value - 5.0);
    }
    return out;
}

}  // namespace trunnion::offsets
