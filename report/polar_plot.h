// Polar plots in the ballbar convention: deviation from a nominal circle, magnified.
#pragma once

#include <string>
#include <vector>

namespace trunnion {

/// One pass. Angle counter-clockwise, 0 to the right.
struct PolarTrace {
    std::string name;
    std::vector<double> angle_rad;
    std::vector<double> radial_um;  ///< deviation from the nominal circle
};

struct PolarPlot {
    std::string title;
    std::string right, top;  ///< axis names at 0 and 90 deg
    std::vector<PolarTrace> traces;
    std::vector<double> fitted_um;      ///< mean, cos, sin: the fitted circle; empty for none
    std::vector<std::string> captions;  ///< figures, one line each
};

/// um per division: 1, 2 or 5 times a power of ten, so that everything stays within four divisions
/// of the nominal circle.
double um_per_division(const PolarPlot& plot);

/// Mean, cosine and sine part of all traces together: an eccentric circle, drawn magnified.
std::vector<double> fit_eccentric_circle(const std::vector<PolarTrace>& traces);

std::string polar_svg(const PolarPlot& plot);

}  // namespace trunnion
