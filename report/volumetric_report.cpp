#include "report/volumetric_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "base/rounded.h"
#include "base/units.h"
#include "report/json_values.h"
#include "report/paragraph.h"

namespace trunnion::report {
namespace {

std::string list_of(const AxisNames& names, const std::vector<Axis>& axes) {
    std::string out;
    for (const Axis axis : axes) out += (out.empty() ? "" : " ") + names[axis];
    return out;
}

}  // namespace

std::string cause_name(const volumetric::VolumetricMap& map,
                       const volumetric::VolumetricPoint& point) {
    return map.causes.empty() ? "" : map.causes[point.worst].name;
}

std::string place_text(const AxisNames& names, const std::vector<Axis>& axes,
                       const AxisPositions& q) {
    std::string out;
    for (const Axis axis : axes) {
        const bool number = names[axis].size() > 1;  // separates J1 30 from J130
        out += fmt::format("{}{}{}{:.6g}", out.empty() ? "" : " ", names[axis], number ? " " : "",
                           names.is_rotary(axis) ? deg_from_rad(q[axis]) : q[axis]);
    }
    return out;
}

std::string volumetric_csv(const volumetric::VolumetricMap& map) {
    std::string out;
    for (const Axis axis : map.axes) out += map.names.column(axis) + ',';
    out += "tip_x_mm,tip_y_mm,tip_z_mm,error_x_mm,error_y_mm,error_z_mm,error_mm,cause\n";
    for (const volumetric::VolumetricPoint& point : map.points) {
        for (const Axis axis : map.axes)
            out += (map.names.is_rotary(axis) ? shortest_degrees(point.at[axis])
                                              : shortest(point.at[axis])) +
                   ',';
        for (const double v : point.tip_W_mm) out += shortest(v) + ',';
        for (const double v : point.error_W_mm) out += shortest(v) + ',';
        out += shortest(point.error_W_mm.norm()) + ',' + cause_name(map, point) + '\n';
    }
    return out;
}

std::string volumetric_json(const volumetric::VolumetricMap& map,
                            const std::vector<FileRead>& inputs) {
    using Json = nlohmann::ordered_json;
    const volumetric::VolumetricPoint& worst = map.points[map.worst];
    Json at = Json::object(), causes = Json::array();
    for (const Axis axis : map.axes) {
        const double q = worst.at[axis];
        at[map.names[axis]] = map.names.is_rotary(axis) ? deg_from_rad(q) : q;
    }
    for (const volumetric::VolumetricCause& cause : map.causes)
        causes.push_back({{"name", cause.name},
                          {"rms_um", um_from_mm(cause.rms_mm)},
                          {"largest_um", um_from_mm(cause.largest_mm)},
                          {"share", cause.share}});
    const Vector3& e = worst.error_W_mm;
    Json json{{"schema", "trunnion.volumetric/1"},
              {"machine", map.machine},
              {"tool_mm", map.length_mm},
              {"poses", map.points.size()},
              {"rms_um", um_from_mm(map.rms_mm)},
              {"worst",
               {{"at", at},
                {"error_mm", {e.x(), e.y(), e.z()}},
                {"error_um", um_from_mm(e.norm())},
                {"cause", cause_name(map, worst)}}},
              {"causes", causes}};
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

std::string volumetric_text(const volumetric::VolumetricMap& map) {
    const volumetric::VolumetricPoint& worst = map.points[map.worst];
    std::string out =
        paragraph(fmt::format("{} poses: rms {}, largest {} at {} (mostly {})", map.points.size(),
                              length_words(um_from_mm(map.rms_mm)),
                              length_words(um_from_mm(worst.error_W_mm.norm())),
                              place_text(map.names, map.axes, worst.at),
                              map.causes.empty() ? "nothing" : cause_name(map, worst)),
                  0);
    if (!map.assumed.empty())
        out += fmt::format("no travel in the setup, +-200 mm or +-180 degrees assumed: {}\n",
                           list_of(map.names, map.assumed));
    if (!map.clamped.empty())
        out += fmt::format("travel beyond a table of errors, held at its last value there: {}\n",
                           list_of(map.names, map.clamped));
    if (!map.causes.empty()) out += "cause                rms µm  largest µm   share\n";
    for (const volumetric::VolumetricCause& cause : map.causes)
        out += fmt::format("{:18} {:>8} {:>11} {:6.1f} %\n", cause.name,
                           three_digits(um_from_mm(cause.rms_mm), 3),
                           three_digits(um_from_mm(cause.largest_mm), 3), 100.0 * cause.share);
    return out;
}

}  // namespace trunnion::report
