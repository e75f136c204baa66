// Both paths of a comparison seen from the side, from above and from the front, as SVG.
#pragma once

#include <string>

#include "regression/comparison.h"

namespace trunnion::report {

/// Three views in one drawing and its legend; empty when nothing was drawn. The cuts and what
/// differs near them set the scale; rapids are faint and end at the frame.
std::string picture_html(const regression::Comparison& comparison);

}  // namespace trunnion::report
