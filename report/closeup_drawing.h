// Close-up drawing of a place where two paths differ.
#pragma once

#include <string>

#include "regression/comparison.h"
#include "report/svg.h"

namespace trunnion::report {

/// 1, 2 or 5 times a power of ten, not above a quarter of `span`.
double round_length(double span);
/// A scale bar starting at its left end, with `length_mm` above it.
void draw_bar(Svg& svg, Point2 from, double length_px, double length_mm);
/// An arrow with its head at `to`; a disc in a ring if it points at the viewer.
void draw_arrow(Svg& svg, Point2 from, Point2 to, const SvgStyle& style);

/// True when the close-up is too small to be visible in a picture `span_mm` wide.
bool is_small(const regression::ComparePicture::Closeup& closeup, double span_mm);

/// A figure of both paths, their distance and the tool axes, seen perpendicular to the plane in
/// which they differ: right is along the path, up is from A towards B (or from B where A has
/// nothing).
std::string closeup_html(const regression::ComparePicture::Closeup& closeup);

}  // namespace trunnion::report
