// The search for the best model that does without a cause (contender_search.cpp).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "diagnosis/verdict/contenders.h"

namespace trunnion::diagnosis {

/// Which groups a model must do without.
using Excluded = std::function<bool(const ColumnGroup&)>;

/// The chosen model with what every contender is compared with.
struct Standing {
    Model model;
    double weight;
    BlockLoss loss;  ///< of left-out readings
    Standing(FoldColumns& columns, Model chosen);
};

/// Squared loss of left-out readings, all members fitted.
BlockLoss loss_of(FoldColumns& columns, const Model& model);

/// Name of a member that is a cause, else empty.
std::string cause_of_member(const Design& design, const Model& model, std::size_t position);
/// True for a jump of the machine, which no setup can contain.
bool is_jump(const Design& design, std::size_t group);
/// True for a cause of textbook forms alone, or a play, of which a driver by direction is the same.
bool is_beside_drivers(const Design& design, const Model& model, const std::string& cause);

/// A model against the chosen one, on left-out readings with all members of both.
Contender against(FoldColumns& rows, const Standing& chosen, Model model);
/// The best model without a cause, with up to two members more.
Contender best_without(const Searching& search, const Standing& chosen, FoldColumns& rows,
                       const Excluded& excluded);

/// The best model without a cause: by the search; with a jump or a course of time in its place; of
/// a scale, with a ripple that the places do not resolve; or, of a bow about machine zero, the one
/// that takes its slope for squareness.
Contender contender_of(const Searching& search, const Standing& chosen, FoldColumns& rows,
                       const std::string& cause);
/// The contender with the visit that it misses most taken for spoiled, if that is more likely: what
/// a single visit tells is not certain.
Contender or_spoiled(const Searching& search, const Standing& chosen, FoldColumns& rows,
                     Contender contender);

}  // namespace trunnion::diagnosis
