// The single-set-up evaluation as published in 2015: sphere of the set-up, circles, planes,
// transformation to the nominal intersection of the axes.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ballbar/test/ballbar_tests.h"
#include "kinematics/errors.h"

namespace trunnion::ballbar::test {

/// The line of a rotary axis in M.
struct AxisLine {
    Vector3 point_mm = Vector3::Zero();
    Vector3 direction = Vector3::UnitZ();  ///< unit vector, on the side of the nominal `direction`
};

struct NamedError {
    kinematics::ErrorName name;
    double value = 0.0;  ///< mm or rad
};

struct PublishedEvaluation {
    Vector3 pivot_offset_mm = Vector3::Zero();  ///< centre pivot - stated position, relative to the
                                                ///< cup
    double length_error_mm = 0.0;               ///< from the radius of the set-up sphere
    double setup_rms_mm = 0.0;
    AxisLine first, second;                ///< as measured, in M with all axes at zero
    std::vector<NamedError> chain;         ///< with the definition of the setup file, at point_mm
    std::vector<NamedError> intersection;  ///< of the line in M at the nominal intersection: as in
                                           ///< the paper's Table 2
    std::vector<std::string> missing;      ///< tests required for missing results
};

/// `rows` as for ballbar_passes(). The published method assumes that the cup position is true and
/// the direction of the bar nominal; its results have a small bias (cosine error).
PublishedEvaluation evaluate_as_published(const kinematics::Machine& nominal,
                                          const BallbarLayout& layout,
                                          const std::vector<records::Reading>& rows);

/// The points of the two nominal axis lines that are nearest to each other (equal when they
/// intersect).
std::pair<Vector3, Vector3> nominal_intersection(const kinematics::AxisGeometry& first,
                                                 const kinematics::AxisGeometry& second);

/// Two positions and two tilts of `line` relative to the nominal axis through `point_mm`. The
/// position is taken in the plane through that point perpendicular to the nominal axis.
std::vector<NamedError> errors_of_line(const AxisLine& line,
                                       const kinematics::AxisGeometry& nominal,
                                       const Vector3& point_mm);

/// Lines of both axes in M, all axes at zero, of a machine with location errors. The second axis is
/// carried by the first, so its line moves with the first one's errors.
std::pair<AxisLine, AxisLine> axis_lines(const kinematics::Machine& machine);

/// Errors in the definition of the setup file for these two lines.
std::vector<NamedError> chain_errors(const AxisLine& first, const AxisLine& second,
                                     const kinematics::Machine& nominal);
/// The same lines as errors in M at the nominal intersection.
std::vector<NamedError> intersection_errors(const AxisLine& first, const AxisLine& second,
                                            const kinematics::Machine& nominal);

}  // namespace trunnion::ballbar::test
