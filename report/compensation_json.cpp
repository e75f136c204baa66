#include "report/compensation_json.h"

#include <nlohmann/json.hpp>

#include "base/units.h"
#include "report/json_values.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const compensation::CompensatedProgram::Worst& worst) {
    return {{"tip_um", um_from_mm(worst.tip_mm)},
            {"turned_urad", urad_from_rad(worst.turned_rad)},
            {"kept_urad", urad_from_rad(worst.kept_rad)}};
}

}  // namespace

std::string compensation_json(const compensation::CompensatedProgram& result,
                              const std::vector<FileRead>& inputs) {
    Json json{{"schema", "trunnion.compensate/1"}, {"blocks", result.blocks.size()},
              {"before", json_of(result.before)},  {"after", json_of(result.after)},
              {"in_gap", json_of(result.in_gap)},  {"notes", result.notes}};
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

}  // namespace trunnion::report
