// Polar plots in the ballbar convention: deviation from a nominal circle, magnified.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trunnion::report {

/// One pass. Angle counter-clockwise, 0 to the right.
struct PolarTrace {
    std::string name;
    std::vector<double> angle_rad;  ///< in measured order
    std::vector<double> radial_um;  ///< deviation from the nominal circle
    double feed_in_rad = 0.0;       ///< arc before the first reading; 0: the start is not drawn
};

/// A list with heading next to the plot: names and values.
struct PolarSection {
    std::string head;
    std::vector<std::pair<std::string, std::string>> rows;
};

struct PolarPlot {
    std::string title, subtitle;
    std::string right, top, left, bottom;  ///< labels at 0, 90, 180, 270 deg
    std::vector<PolarTrace> traces;
    std::vector<double> fitted_um;  ///< mean, cos, sin: the fitted circle; empty for none
    std::vector<PolarSection> sections;
};

/// um per division: 1, 2 or 5 times a power of ten, so that all values are within four divisions of
/// the nominal circle; at least 0.5, the noise level of a ballbar.
double um_per_division(const PolarPlot& plot);

/// Mean, cosine and sine component of all traces together: an eccentric circle, drawn magnified.
std::vector<double> fit_eccentric_circle(const std::vector<PolarTrace>& traces);

std::string polar_svg(const PolarPlot& plot);

}  // namespace trunnion::report
