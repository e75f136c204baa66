#include "report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "base/sha256.h"
#include "base/units.h"
#include "report/json_values.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

const char* status_name(controller::RunStatus status) {
    return status == controller::RunStatus::ok      ? "ok"
           : status == controller::RunStatus::alarm ? "alarm"
                                                    : "limit";
}

Json alarm_json(const std::optional<Alarm>& alarm) {
    if (!alarm) return nullptr;
    return {{"number", alarm->number},         {"text", alarm->text},
            {"program", alarm->where.program}, {"line", alarm->where.line},
            {"column", alarm->where.column},   {"block", alarm->block}};
}

Json position_json(const AxisPositions& q, const std::vector<kinematics::AxisGeometry>& axes) {
    Json out = Json::object();
    for (const kinematics::AxisGeometry& axis : axes) {
        const double value = q[axis.axis];
        out[axis.name] = axis.rotary
                             ? parse_number(shortest_degrees(value)).value_or(deg_from_rad(value))
                             : value;
    }
    return out;
}

/// The hash that was noted when the program was read; made anew for a text that is no file, and for
/// a file that changed between two readings.
std::string hash_of(const interpreter::ProgramText& program, const std::vector<FileRead>& inputs) {
    const auto is_it = [&](const FileRead& file) { return file.path == program.name; };
    if (std::count_if(inputs.begin(), inputs.end(), is_it) != 1) return sha256(program.text);
    return std::find_if(inputs.begin(), inputs.end(), is_it)->sha256;
}

Json programs_json(const std::vector<interpreter::ProgramText>& programs,
                   const std::vector<FileRead>& inputs) {
    Json list = Json::array();
    for (const interpreter::ProgramText& program : programs)
        list.push_back({{"path", program.name}, {"sha256", hash_of(program, inputs)}});
    return list;
}

}  // namespace

std::string run_json(const emulator::RunLog& log, const std::vector<kinematics::AxisGeometry>& axes,
                     const std::vector<interpreter::ProgramText>& programs,
                     const std::vector<FileRead>& inputs) {
    Json variables = Json::object();
    for (const auto& [number, value] : log.variables)
        variables[std::to_string(number)] = std::isfinite(value) ? Json(value) : Json(nullptr);
    const controller::RunResult& r = log.result;
    Json json = {
        {"schema", "trunnion.run/1"},
        {"status", status_name(r.status)},
        {"alarm", alarm_json(r.alarm)},
        {"limit", log.limit == BudgetLimit::none ? Json(nullptr) : Json(name_of(log.limit))},
        {"blocks", r.blocks},
        {"moves", r.moves},
        {"time_s", r.time_s},
        {"path_mm", r.path_mm},
        {"final",
         {{"machine", position_json(r.machine, axes)}, {"work", position_json(r.work, axes)}}},
        {"modal", r.modal},
        {"variables", variables},
        {"programs", programs_json(programs, inputs)},
        {"printed", log.printed}};
    add_inputs(json, inputs);
    return json_text(json, 2) + '\n';
}

std::string run_summary(const emulator::RunLog& log) {
    const controller::RunResult& r = log.result;
    return fmt::format("{}: {} blocks, {} moves, {:.3f} s, {:.3f} mm", status_name(r.status),
                       r.blocks, r.moves, r.time_s, r.path_mm);
}

std::string variables_text(const emulator::RunLog& log) {
    std::string out;
    for (const auto& [number, value] : log.variables)
        out += fmt::format("#{} ={}\n", number, std::isfinite(value) ? " " + shortest(value) : "");
    return out;
}

}  // namespace trunnion::report
