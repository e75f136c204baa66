// The straight line that an error in free form has by itself (line_of_form.cpp).
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/verdict/claims.h"

namespace trunnion::diagnosis {

/// The table of positioning beside the scale of an axis (positions in the model), which holds the
/// line of the form, too; none for other members.
std::optional<std::size_t> form_of_line(const Design& design, const Model& model,
                                        std::size_t position);

/// Limits the probability of the scale of an axis beside a table of its positioning. Tables are
/// orthogonal to the line, so the scale holds the line of the form, too, and the sigma of the
/// readings says nothing of which one it is. Of a form of that size and length the line scatters as
/// its process does; a scale, beforehand as likely as not, must stand out of that. Else the form
/// is its rival; a scale that is not claimed is one of the form, too.
void doubt_lines_of_forms(Design& design, const Model& model, std::vector<Claim>& claims);

}  // namespace trunnion::diagnosis
