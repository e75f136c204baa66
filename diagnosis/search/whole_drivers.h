// A course of time with all that it does: poses follow each other in time, so that part of it looks
// like errors of the axes at these poses.
#pragma once

#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// Adds a driver as it is, not orthogonal to the textbook effects. It is not offered.
void add_whole(Design& design, ColumnGroup driver);

/// A driver of the search is orthogonal to the textbook effects: a gap that needs it has those in
/// the model that do the rest of its work. Takes the whole driver in its place, and keeps the
/// effects that are worth their prior beside it, where that is more likely.
Model with_whole_drivers(Design& design, const SearchSetting& setting, Model model);

}  // namespace trunnion::diagnosis
