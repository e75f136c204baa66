#include "pivot/pivot_readings.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "base/units.h"

namespace trunnion::pivot {

namespace {

Vector3 linear(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

std::string_view function_of(PositioningMode mode) {
    switch (mode) {
        case PositioningMode::dpp: return "DPP";
        case PositioningMode::rtdfo: return "RTDFO";
        case PositioningMode::rtcp: return "RTCP";
        case PositioningMode::tw: return "TW";
        default: return {};
    }
}

/// Rows of one measured sphere.
struct Finding {
    std::vector<const records::Reading*> rows;
    const records::Reading& row() const { return *rows.front(); }
};

bool same_finding(const records::Reading& a, const records::Reading& b, Axis first, Axis second) {
    return a.test == b.test && a.mode == b.mode && a.device == b.device && a.feature == b.feature &&
           std::abs(a.commanded[first] - b.commanded[first]) < 1e-6 &&
           std::abs(a.commanded[second] - b.commanded[second]) < 1e-6;
}

std::vector<Finding> findings_of(const records::ReadingTable& table, Axis first, Axis second) {
    std::vector<Finding> findings;
    bool apart = true;
    for (const records::Reading& row : table.rows) {
        // A move of a rotary axis ends a measurement; moves between its touches do not.
        if (!findings.empty() &&
            (std::abs(row.commanded[first] - findings.back().row().commanded[first]) > 1e-6 ||
             std::abs(row.commanded[second] - findings.back().row().commanded[second]) > 1e-6))
            apart = true;
        if (row.device != records::Device::sphere && row.device != records::Device::touch) continue;
        if (!row.value_mm) continue;
        if (apart || findings.empty() || !same_finding(findings.back().row(), row, first, second))
            findings.emplace_back();
        findings.back().rows.push_back(&row);
        apart = false;
    }
    return findings;
}

/// Least squares of dir . e = value.
Vector3 by_components(const Finding& finding) {
    Matrix3 a = Matrix3::Zero();
    Vector3 b = Vector3::Zero();
    for (const records::Reading* row : finding.rows) {
        a += row->direction_M * row->direction_M.transpose();
        b += row->direction_M * *row->value_mm;
    }
    return a.ldlt().solve(b);
}

/// Expected centre from the targets: target = centre + k dir, with a common k.
Vector3 expected_centre(const Finding& finding) {
    Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (const records::Reading* row : finding.rows)
        for (int i = 0; i < 3; ++i) {
            Eigen::Vector4d line = Eigen::Vector4d::Zero();
            line(i) = 1.0;
            line(3) = row->direction_M(i);
            a += line * line.transpose();
            b += line * linear(row->commanded)(i);
        }
    return a.ldlt().solve(b).head<3>();
}

/// Centre of a sphere of known radius through the contacts, by Gauss-Newton.
Vector3 found_centre(const Finding& finding, double radius_mm, Vector3 centre) {
    for (int pass = 0; pass < 20; ++pass) {
        Matrix3 a = Matrix3::Zero();
        Vector3 b = Vector3::Zero();
        for (const records::Reading* row : finding.rows) {
            const Vector3 away =
                linear(row->commanded) + *row->value_mm * row->direction_M - centre;
            const Vector3 unit = away.normalized();
            a += unit * unit.transpose();
            b += unit * (away.norm() - radius_mm);
        }
        const Vector3 step = a.ldlt().solve(b);
        centre += step;
        if (step.norm() < 1e-12) break;
    }
    return centre;
}

void check_directions(const records::ReadingTable& table, const Finding& finding) {
    Matrix3 spread = Matrix3::Zero();
    for (const records::Reading* row : finding.rows)
        spread += row->direction_M * row->direction_M.transpose();
    if (finding.rows.size() < (finding.row().device == records::Device::touch ? 4U : 3U) ||
        std::abs(spread.determinant()) < 1e-6)
        throw InputError("the rows of this sphere do not have three independent directions",
                         records::place_of(table, finding.row()));
}

}  // namespace

PivotPrints pivot_readings(const records::ReadingTable& table, Axis first, Axis second,
                           double radii_mm, const Vector3& tip_S_mm) {
    PivotPrints out;
    if (const auto date = table.comment.find("date"); date != table.comment.end())
        out.date = date->second;
    std::map<std::string, int> number_of_map;
    std::map<int, PivotMap> maps;
    for (const Finding& finding : findings_of(table, first, second)) {
        const records::Reading& row = finding.row();
        const std::string function(function_of(row.mode));
        const bool zero = row.test.starts_with("zero") || function.empty();
        check_directions(table, finding);
        const bool touches = row.device == records::Device::touch;
        const Vector3 expected = touches ? expected_centre(finding) : linear(row.commanded);
        const Vector3 error = touches
                                  ? Vector3(found_centre(finding, radii_mm, expected) - expected)
                                  : by_components(finding);
        if (zero) {
            out.spheres_mm[function] = expected + error + tip_S_mm;
            ++out.zeroings;
            continue;
        }
        // One map for each test and function: "dpp_map1" and "rtcp_map1" are the same map.
        std::string name = row.test;
        if (const std::size_t at = name.find("map"); at != std::string::npos) name.erase(0, at);
        const int number =
            number_of_map.try_emplace(name, static_cast<int>(number_of_map.size()) + 1)
                .first->second;
        PivotMap& map = maps[number];
        map.number = number;
        if (map.arcs.empty() || map.arcs.back().function != function)
            map.arcs.push_back({function, find_pivot_function(function)->group, {}, {}, {}, {}});
        map.arcs.back().points.push_back(
            {deg_from_rad(row.commanded[first]), deg_from_rad(row.commanded[second]), error});
    }
    for (auto& [number, map] : maps) {
        name_map(map, first, second);
        out.maps.push_back(std::move(map));
    }
    if (out.maps.empty())
        throw InputError(
            "no sphere or touch rows with a mode (dpp, rtdfo, rtcp, tw): the positioning function "
            "is unknown",
            {table.path});
    return out;
}

}  // namespace trunnion::pivot
