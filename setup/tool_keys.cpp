#include "setup/tool_keys.h"

#include "setup/toml_text.h"

namespace trunnion::setup {

namespace {

constexpr double highest_tool = 99999999.0;  ///< T has eight digits

PhysicalTool read_tool(const TomlFile& file, const TomlValue& table) {
    PhysicalTool tool;
    const TomlValue *length = file.table(table).find("length_mm"),
                    *diameter = table.find("diameter_mm");
    if (!length || !diameter) file.fail(table, "a tool has length_mm and diameter_mm");
    tool.length_mm = file.positive(*length);
    tool.diameter_mm = file.positive(*diameter);
    if (const TomlValue* runout = table.find("runout_mm")) {
        const std::vector<double> xy = file.numbers(*runout);
        if (xy.size() != 2) file.fail(*runout, "runout_mm is two numbers, x and y in S");
        tool.runout_x_mm = xy[0];
        tool.runout_y_mm = xy[1];
    }
    return tool;
}

}  // namespace

void read_physical_tools(const TomlFile& file, Setup& setup) {
    const TomlValue* tools = file.root().find("tools");
    if (!tools) return;
    for (const auto& [key, value] : file.table(*tools).entries) {
        value.used = true;
        const auto n = parse_number(key);
        if (!n || *n < 1 || *n > highest_tool || *n != static_cast<int>(*n))
            file.fail(value, "'" + key + "' is no T code");
        setup.tools[static_cast<int>(*n)] = read_tool(file, value);
    }
}

std::string physical_tools_text(const PhysicalTools& tools) {
    std::string out = tools.empty() ? "" : "\n[tools]\n";
    for (const auto& [number, tool] : tools) {
        out += std::to_string(number) + " = { length_mm = " + toml_number(tool.length_mm) +
               ", diameter_mm = " + toml_number(tool.diameter_mm);
        if (tool.runout_x_mm != 0.0 || tool.runout_y_mm != 0.0)
            out += ", runout_mm = " + toml_numbers(std::array{tool.runout_x_mm, tool.runout_y_mm});
        out += " }\n";
    }
    return out;
}

}  // namespace trunnion::setup
