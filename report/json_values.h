// Numbers and vectors as JSON, common to all reports.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/pose.h"

namespace trunnion::report {

/// null for a value that is not finite.
inline nlohmann::ordered_json json_number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// [x, y, z]
inline nlohmann::ordered_json vector_json(const Vector3& v) {
    return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
}

}  // namespace trunnion::report
