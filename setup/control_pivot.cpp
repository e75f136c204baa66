#include "setup/control_pivot.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/alarm.h"
#include "offsets/control_position.h"
#include "offsets/pivot_parameters.h"

namespace trunnion::setup {

namespace {

constexpr double half_increment_mm = 0.0005;

std::string point_text(const Vector3& p) {
    return fmt::format("X{:.4f} Y{:.4f} Z{:.4f}", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
}

/// The point of the line (b, v) nearest to the line (a, u), which must not be parallel to it.
Vector3 nearest_on_second(const Vector3& a, const Vector3& u, const Vector3& b, const Vector3& v) {
    const Vector3 across = u.cross(v);
    return b + (b - a).cross(u).dot(across) / across.squaredNorm() * v;
}

double largest_difference(const PivotAgreement& p) {
    double most = (p.parameters_mm - p.g54_mm).cwiseAbs().maxCoeff();
    if (p.measured_mm)
        for (const Vector3& other : {p.parameters_mm, p.g54_mm})
            most = std::max(most, (*p.measured_mm - other).cwiseAbs().maxCoeff());
    return most;
}

}  // namespace

double PivotAgreement::apart_mm() const {
    double most = (parameters_mm - g54_mm).norm();
    if (measured_mm)
        for (const Vector3& other : {parameters_mm, g54_mm})
            most = std::max(most, (*measured_mm - other).norm());
    return most;
}

bool PivotAgreement::agrees() const {
    return largest_difference(*this) <= half_increment_mm;
}

PivotAgreement compare_pivots(const offsets::Stores& stores,
                              const std::optional<Vector3>& measured_mm, const std::string& path) {
    const auto pivot = offsets::decode_pivot(stores.parameters);
    if (!pivot || pivot->unit != offsets::MechanicalUnit::table_table)
        throw InputError("19680 is not the type of a machine with both rotary axes in the table",
                         {path});
    PivotAgreement out;
    out.parameters_mm =
        nearest_on_second(pivot->table_point_mm, pivot->first.line,
                          pivot->table_point_mm + pivot->table_offset_mm, pivot->second.line);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        out.g54_mm[static_cast<Eigen::Index>(index_of(axis))] =
            stores.work.standard[0][axis] + stores.work.external[axis];
    out.measured_mm = measured_mm;
    return out;
}

std::string text_of(const PivotAgreement& agreement) {
    const std::string measured =
        agreement.measured_mm ? ", measured " + point_text(*agreement.measured_mm) : "";
    return fmt::format("pivot: 19700-19705 {}, G54 {}{}: {}, {:.4f} mm apart",
                       point_text(agreement.parameters_mm), point_text(agreement.g54_mm), measured,
                       agreement.agrees() ? "they agree" : "they differ", agreement.apart_mm());
}

}  // namespace trunnion::setup
