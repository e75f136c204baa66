#include "choices/store_table.h"

namespace trunnion::choices {

namespace {

using setup::Setup;

const char* unit_of(Axis axis) {
    return is_rotary(axis) ? "deg" : "mm";
}

std::vector<Axis> axes_of(const Setup& setup) {
    std::vector<Axis> out;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (is_letter(axis)) out.push_back(axis.axis);
    return out;
}

/// One number for each axis of an offset vector.
Store vector_store(const std::string& name, const std::string& what, const std::vector<Axis>& axes,
                   const std::function<offsets::OffsetVector&(Setup&)>& in) {
    Store out{name, what, {}};
    for (const Axis axis : axes)
        out.numbers.push_back({name + '.' + letter_of(axis), unit_of(axis),
                               [in, axis](Setup& s) -> double& { return in(s)[axis]; }});
    return out;
}

void add_work_offsets(const Setup& setup, const std::vector<Axis>& axes, std::vector<Store>& out) {
    for (std::size_t k = 0; k < setup.stores.work.standard.size(); ++k) {
        const std::string name = "G" + std::to_string(54 + k);
        out.push_back(vector_store(
            name, "work offset " + name,
            axes, [k](Setup & s) -> auto& { return s.stores.work.standard[k]; }));
    }
    for (std::size_t k = 0; k < setup.stores.work.additional.size(); ++k) {
        if (setup.stores.work.additional[k] == offsets::OffsetVector{}) continue;
        const std::string name = "G54.1P" + std::to_string(k + 1);
        out.push_back(vector_store(
            name, "work offset " + name,
            axes, [k](Setup & s) -> auto& { return s.stores.work.additional[k]; }));
    }
    out.push_back(vector_store(
        "external", "external work offset", axes,
        [](Setup & s) -> auto& { return s.stores.work.external; }));
}

Store tool_store(std::size_t number, bool length) {
    const std::string name = 'H' + std::to_string(number);
    if (length)
        return {name,
                "length of offset " + std::to_string(number),
                {{name, "mm", [number](Setup& s) -> double& {
                      return s.stores.tools.tool[number].length_geometry_mm;
                  }}}};
    const std::string radius = 'D' + std::to_string(number);
    return {radius,
            "radius of offset " + std::to_string(number),
            {{radius, "mm", [number](Setup& s) -> double& {
                  return s.stores.tools.tool[number].radius_geometry_mm;
              }}}};
}

void add_tools(const Setup& setup, std::vector<Store>& out) {
    for (std::size_t n = 1; n < setup.stores.tools.tool.size(); ++n) {
        const offsets::ToolOffset& tool = setup.stores.tools.tool[n];
        if (tool.length_mm() == 0.0 && tool.radius_mm() == 0.0) continue;
        out.push_back(tool_store(n, true));
        out.push_back(tool_store(n, false));
    }
}

/// A parameter as a number; `otherwise`: value of an absent parameter.
StoredNumber parameter(int number, double otherwise) {
    return {
        std::to_string(number), "mm", [number, otherwise](Setup& s) -> double& {
            auto& entry = s.stores.parameters.entry;
            return entry.try_emplace(number, offsets::Parameter{otherwise, {}}).first->second.value;
        }};
}

StoredNumber axis_parameter(int number, Axis axis, int axis_number) {
    return {std::to_string(number) + '.' + letter_of(axis), unit_of(axis),
            [number, axis_number](Setup& s) -> double& {
                offsets::Parameter& p = s.stores.parameters.entry[number];
                return p.by_axis.try_emplace(axis_number, p.value).first->second;
            }};
}

void add_reference_positions(const std::vector<Axis>& axes, std::vector<Store>& out) {
    for (int number = 1240; number <= 1243; ++number) {
        Store store{std::to_string(number),
                    "reference position " + std::to_string(number - 1239) + " of G28 and G30",
                    {}};
        for (std::size_t k = 0; k < axes.size(); ++k)
            store.numbers.push_back(axis_parameter(number, axes[k], static_cast<int>(k) + 1));
        out.push_back(std::move(store));
    }
}

void add_pivot(const Setup& setup, std::vector<Store>& out) {
    struct Row {
        const char *name, *what;
        int first, last;
    };
    constexpr Row rows[] = {
        {"19700-19702", "place of the table's rotary axis", 19700, 19702},
        {"19703-19705", "second rotary axis of the table against the first", 19703, 19705},
        {"19709-19711", "rotary axis of the tool against the spindle", 19709, 19711},
        {"19712-19714", "second rotary axis of the tool against the first", 19712, 19714}};
    for (const Row& row : rows) {
        Store store{row.name, row.what, {}};
        for (int n = row.first; n <= row.last; ++n)
            if (setup.stores.parameters.find(n)) store.numbers.push_back(parameter(n, 0.0));
        if (!store.numbers.empty()) out.push_back(std::move(store));
    }
}

}  // namespace

std::vector<Store> store_table(const Setup& setup) {
    const std::vector<Axis> axes = axes_of(setup);
    std::vector<Store> out;
    add_work_offsets(setup, axes, out);
    add_tools(setup, out);
    add_pivot(setup, out);
    add_reference_positions(axes, out);
    out.push_back({"5114", "retreat of G73", {parameter(5114, 1.0)}});
    out.push_back({"5115", "clearance of G83", {parameter(5115, 1.0)}});
    return out;
}

}  // namespace trunnion::choices
