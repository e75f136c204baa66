// A place where two paths differ, drawn from near.
#pragma once

#include <string>

#include "regression/comparison.h"
#include "report/svg.h"

namespace trunnion::report {

/// 1, 2 or 5 times a power of ten, not above a quarter of `span`.
double round_length(double span);
/// A scale bar from its left end; `length_mm` is written above it.
void draw_bar(Svg& svg, Point2 from, double length_px, double length_mm);
/// With a head at `to`; a disc in a ring where it points at the reader.
void draw_arrow(Svg& svg, Point2 from, Point2 to, const SvgStyle& style);

/// True where a picture `span_mm` wide shows less of it than a reader can see.
bool is_small(const regression::ComparePicture::Closeup& closeup, double span_mm);

/// A figure with both paths, the distance between them and the tool axes, seen across the plane in
/// which they differ: right is along the path, up is from A towards B (or from B where A has
/// nothing).
std::string closeup_html(const regression::ComparePicture::Closeup& closeup);

}  // namespace trunnion::report
