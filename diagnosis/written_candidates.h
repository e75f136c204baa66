// Forms of a found model that a setup may be written with, and what they leave of left-out
// readings.
#pragma once

#include <functional>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

using TakesMember = std::function<bool(GroupKind, std::size_t group)>;

/// The model with those of its members that `takes` accepts.
Model only(const Outcome& f, Model model, const TakesMember& takes);

/// Which members contribute to a prediction: causes, and zeros. What is to be written is judged
/// beside all zeros; the gap contains the large ones.
enum class Zeros : unsigned char { all, small };

/// Loss of left-out readings with the members of a model that predict.
BlockLoss loss_of(const Outcome& f, const Model& model, const Folds& folds);
/// The same on left-out paths, beside what the other paths leave open of the set-up.
BlockLoss loss_on_paths(const Outcome& f, const Model& model, const Folds& paths);
/// Whitened left-out residuals of all rows.
Eigen::VectorXd residual_of(const Outcome& f, const Model& model, const Folds& folds,
                            Zeros zeros = Zeros::small);

/// A changed model, tuned, without members that are many times the usual size only there: without
/// what was taken out, the readings do not tell how large they are.
Model without_enormous(const Outcome& f, Model model);

struct WrittenCandidate {
    Model model;
    bool found = true;  ///< false: with forms that the search did not choose
};

/// The found model without the parts that do not predict, the most complete one first.
/// `paths`: parts of the readings that are left out as a whole.
std::vector<WrittenCandidate> candidates_of(const Outcome& f, const Folds& paths);

}  // namespace trunnion::diagnosis
