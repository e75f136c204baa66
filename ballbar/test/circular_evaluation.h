// Planar circular tests after ISO 230-4: parameters, and the contributing errors of two linear
// axes.
#pragma once

#include <string>
#include <vector>

#include "ballbar/test/ballbar_tests.h"
#include "geometry/fits.h"
#include "records/readings.h"

namespace trunnion::ballbar::test {

/// Readings of a pass are reduced to this number of means: one each half a degree.
constexpr std::size_t points_per_pass = 720;

/// One direction of travel on one circle. Angles counter-clockwise in the plane from its first axis
/// (XY from X, YZ from Y, ZX from Z).
struct CircularPass {
    std::string name;
    bool ccw = true;
    double feed_mm_min = 0.0;
    std::vector<double> angle_rad;
    std::vector<double> radial_mm;  ///< reading, including set-up eccentricity
    std::vector<AxisSample> samples;
    CircleFit circle;  ///< least-squares circle of the measured path about the pivot
};

/// Both directions of one plane and feed.
struct CircularTest {
    BallbarTestKind plane = BallbarTestKind::xy;
    double radius_mm = 100.0;  ///< nominal
    double arc_rad = 0.0;      ///< arc covered
    std::vector<CircularPass> passes;
    Vector2 center_M_mm = Vector2::Zero();  ///< of the commanded circle, along the plane's axes
    CircleFit circle;                       ///< of all passes together
};

/// Parameters of ISO 230-4 in um. Centre: least squares (a common one for comparisons of both
/// directions). Parameters of a direction that was not measured are 0, and `bidirectional` is
/// false.
struct CircularFigures {
    double circularity_ccw_um = 0.0;  ///< G: largest minus smallest radius
    double circularity_cw_um = 0.0;
    bool bidirectional = false;
    double bidirectional_circularity_um = 0.0;  ///< G(b): both paths with a common centre
    double mean_radial_deviation_um = 0.0;      ///< D: mean radius - nominal radius
    double radial_deviation_max_um = 0.0;       ///< F max, F min: radius - nominal radius
    double radial_deviation_min_um = 0.0;
    double hysteresis_um = 0.0;  ///< H: largest difference of the two paths at the same angle
    double hysteresis_at_rad = 0.0;
};

/// One line of the diagnosis table.
struct CircularCause {
    std::string name;    ///< "backlash X", "squareness XY", ...
    std::string effect;  ///< the catalogue's name: "X.backlash"
    double value = 0.0;
    double sigma = 0.0;
    std::string unit;
    double share_um = 0.0;     ///< peak-to-peak value of its trace about the trace's own circle
    double share = 0.0;        ///< fraction of the sum of all traces
    int rank = 0;              ///< 1: largest
    bool significant = false;  ///< |value| > 3 sigma
    std::string note;          ///< e.g. fitted decay length or pitch
};

struct CircularDiagnosis {
    std::vector<CircularCause> causes;  ///< by rank
    std::vector<std::string> not_separable;
    double residual_um = 0.0;  ///< rms of the unexplained remainder
};

/// The planar tests among the readings, by plane and feed, in order of appearance.
std::vector<CircularTest> circular_tests(const records::ReadingTable& table, double radius_mm);

/// Radius of the measured path about the pivot found by `circle`, minus the nominal radius.
std::vector<double> centred_radial_mm(const CircularPass& pass, const CircleFit& circle,
                                      double radius_mm);

CircularFigures circular_figures(const CircularTest& test);

/// Axes of a plane, first and second.
std::pair<Axis, Axis> axes_of_plane(BallbarTestKind plane);
std::string plane_name(BallbarTestKind plane);  ///< "XY"

}  // namespace trunnion::ballbar::test
