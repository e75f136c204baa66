// Points as a function of one quantity, as a picture with axes.
#pragma once

#include <string>
#include <vector>

#include "report/svg.h"

namespace trunnion::report {

struct ScatterSeries {
    std::string name;  ///< in the legend; empty: not listed
    std::vector<Point2> points;
};

struct Scatter {
    std::string title, description;  ///< of the picture
    std::string x_label, y_label;    ///< with units
    std::vector<ScatterSeries> series;
};

/// At most 1500 marks a series; of more points only every second, third, ... is drawn, as the
/// legend says.
std::string scatter_svg(const Scatter& scatter);

}  // namespace trunnion::report
