#include "regression/effects_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace trunnion::regression {

namespace {

using Values = std::map<std::string, double>;

constexpr const char* left_active = "left active: ";

/// What the last block leaves in force, so that the next program starts somewhere else.
void add_left_active(const ControlSnapshot& s, Values& v) {
    const auto add = [&v](const std::string& name, double value) {
        if (std::abs(value) > 1e-6) v[left_active + name] = value;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const char letter = "XYZ"[k];
        add(fmt::format("G92 {}", letter), s.preset_mm[k]);
        add(fmt::format("G52 {}", letter), s.local_mm[k]);
        add(fmt::format("scale of {}", letter), s.scale[k] - 1.0);
    }
    for (std::size_t k = 0; k < 3; ++k)
        add(fmt::format("tilted plane, normal {}", "XYZ"[k]), s.feature[3 * k + 2]);
    add("rotation G68 R", s.rotation_deg);
    add("G54.2 P", s.fixture_number);
    add("#3003", s.overrides[0]);
    add("#3004", s.overrides[1]);
}

/// The stores as named values, without default values.
Values values_of(const RecordedRun& run) {
    Values v;
    const auto add = [&](const std::string& name, double value) {
        if (value != 0.0) v[name] = value;
    };
    const auto add_vector = [&](const std::string& name, const offsets::OffsetVector& offset) {
        for (const Axis axis : all_axes) add(name + " " + letter_of(axis), offset[axis]);
    };
    add_left_active(run.last_state, v);
    for (const auto& [number, value] : run.variables) v[fmt::format("#{}", number)] = value;
    add_vector("external offset", run.stores.work.external);
    for (std::size_t k = 0; k < run.stores.work.standard.size(); ++k)
        add_vector(fmt::format("G{}", 54 + k), run.stores.work.standard[k]);
    for (std::size_t k = 0; k < run.stores.work.additional.size(); ++k)
        add_vector(fmt::format("G54.1 P{}", k + 1), run.stores.work.additional[k]);
    for (std::size_t k = 0; k < run.stores.fixture.set.size(); ++k) {
        add_vector(fmt::format("fixture offset {}", k + 1), run.stores.fixture.set[k].offset);
        add_vector(fmt::format("fixture offset {} at", k + 1),
                   run.stores.fixture.set[k].reference_angles);
    }
    for (std::size_t k = 0; k < run.stores.tools.tool.size(); ++k) {
        const offsets::ToolOffset& t = run.stores.tools.tool[k];
        add(fmt::format("tool offset {} length", k), t.length_geometry_mm);
        add(fmt::format("tool offset {} length wear", k), t.length_wear_mm);
        add(fmt::format("tool offset {} radius", k), t.radius_geometry_mm);
        add(fmt::format("tool offset {} radius wear", k), t.radius_wear_mm);
    }
    for (const auto& [number, parameter] : run.stores.parameters.entry) {
        v[fmt::format("parameter {}", number)] = parameter.value;
        for (const auto& [axis, value] : parameter.by_axis)
            v[fmt::format("parameter {} axis {}", number, axis)] = value;
    }
    return v;
}

void add_value(Comparison& result, const std::string& what) {
    Difference d;
    d.kind = DifferenceKind::value;
    d.what = what;
    d.a.program = result.a;
    d.b.program = result.b;
    result.differences.push_back(std::move(d));
}

std::string value_text(const Values& values, const std::string& name) {
    const auto found = values.find(name);
    if (found == values.end()) return name.starts_with("#") ? "vacant" : "0";
    return fmt::format("{:.10g}", found->second);
}

void compare_values(const Values& a, const Values& b, const Tolerances& t, Comparison& result) {
    std::set<std::string> names;
    for (const auto& [name, value] : a) names.insert(name);
    for (const auto& [name, value] : b) names.insert(name);
    for (const std::string& name : names) {
        ++result.compared;
        const auto in_a = a.find(name), in_b = b.find(name);
        if (in_a != a.end() && in_b != b.end() &&
            std::abs(in_a->second - in_b->second) <= t.position_mm)
            continue;
        add_value(result,
                  fmt::format("{}: {} -> {}", name, value_text(a, name), value_text(b, name)));
    }
}

std::string quoted(bool there, const std::string& line) {
    if (!there) return "nothing";
    return "'" + line + "'";
}

void compare_printed(const std::string& a, const std::string& b, Comparison& result) {
    std::istringstream lines_a(a), lines_b(b);
    std::string line_a, line_b;
    for (int n = 1;; ++n) {
        const bool more_a = static_cast<bool>(std::getline(lines_a, line_a));
        const bool more_b = static_cast<bool>(std::getline(lines_b, line_b));
        if (!more_a && !more_b) return;
        ++result.compared;
        if (more_a && more_b && line_a == line_b) continue;
        add_value(result, fmt::format("printed line {}: {} -> {}", n, quoted(more_a, line_a),
                                      quoted(more_b, line_b)));
        if (more_a != more_b) return;
    }
}

}  // namespace

void compare_times(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                   Comparison& result) {
    const double time_a = a.result.time_s, time_b = b.result.time_s;
    if (std::abs(time_a - time_b) <= tolerances.time_ratio * std::max(time_a, time_b)) return;
    Difference d;
    d.kind = DifferenceKind::time;
    d.what = fmt::format("cycle time {:.2f} -> {:.2f} s", time_a, time_b);
    d.value_a = time_a;
    d.value_b = time_b;
    d.a.program = result.a;
    d.b.program = result.b;
    result.differences.push_back(std::move(d));
}

void compare_leftovers(const RecordedRun& a, const RecordedRun& b, bool stores,
                       const Tolerances& tolerances, Comparison& result) {
    Values in_a = values_of(a), in_b = values_of(b);
    if (!stores)
        for (Values* values : {&in_a, &in_b})
            std::erase_if(*values, [](const auto& v) {
                return !v.first.starts_with("#") && !v.first.starts_with(left_active);
            });
    for (int number = 100; number < 200; ++number) {
        const std::string name = fmt::format("#{}", number);
        if (in_a.contains(name) == in_b.contains(name)) continue;
        in_a.erase(name);
        in_b.erase(name);
    }
    compare_values(in_a, in_b, tolerances, result);
    compare_printed(a.printed, b.printed, result);
}

void compare_effects(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                     Comparison& result) {
    compare_values(values_of(a), values_of(b), tolerances, result);
    compare_printed(a.printed, b.printed, result);
    compare_times(a, b, tolerances, result);
}

}  // namespace trunnion::regression
