// The setup written by a diagnosis: the found causes that predict.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Whitened left-out residuals of all rows, with the set-up alone and with the written causes.
struct LeftOutPair {
    Eigen::VectorXd before, after;
};
struct Written {
    Model causes;            ///< the written causes, with the drivers fitted beside them
    Model model;             ///< the same with small errors of all axes (background.h)
    setup::Setup setup;      ///< the re-identified setup with the causes
    double part = 0.0;       ///< H of what is written: part of the excess on left-out blocks
    LeftOutPair blocks;      ///< the folds of the verdict
    LeftOutPair paths;       ///< whole paths left out (path_folds)
    bool only_here = false;  ///< a better model was refused because it fails on left-out paths
    std::vector<std::string> background;  ///< names of these errors
};

/// The causes that predict left-out readings significantly better than the set-up alone in their
/// written form: without drivers and large zeros, without tables that fail between their positions
/// (of a laser or autocollimator that read at no others, such a table holds at these alone) and
/// without searched forms that do not help on whole left-out paths. There, what was found with
/// tables must leave at most half of the gap, anything else do no harm. If there are none, or if
/// they remove less than half of the excess on left-out readings: the re-identified setup without
/// causes.
Written written_setup(const Outcome& found);

/// Part of the excess of separate readings that the causes remove: those that are written, or all
/// that were found, whichever is more. A setup without a cause says nothing of it.
double confirmed_part(const Outcome& found, const Written& written,
                      const records::ReadingTable& holdout);

/// What is written without members whose claims are rather one of their rivals, or nothing, or with
/// what the best model has in their place, as long as left-out readings do not miss them: what they
/// do at these readings others undo, and elsewhere nothing does.
Written without_unlikely(const Outcome& found, Written written, const std::vector<Claim>& claims);

}  // namespace trunnion::diagnosis
