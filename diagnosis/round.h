// One round of the pipeline: rows and noise as they are believed, and the search among models.
#pragma once

#include "diagnosis/groups/key_search.h"
#include "diagnosis/search/search.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

/// Rows, noise and columns of one round.
struct Round {
    std::vector<bool> used;
    NoiseBelief noise;
    Eigen::VectorXd sigma_mm;
    bool over_sessions = false;  ///< may the machine have changed between sessions?
    /// Of the variance of points: shared by stops, and as rotations (diagnosis/added_noise.h).
    double shared_by_stops = 0.0, turned_by_stops = 0.0;
};

/// The noise told by repeats beside `residual_mm`, or stated, or assumed.
NoiseBelief belief_of(const Prepared& prepared, const Eigen::VectorXd& residual_mm,
                      const Round& round);

/// Lets these device rows count for nothing, although they are used: they are not spoiled.
void pass_over(const Prepared& prepared, const std::vector<std::size_t>& rows, Round& round);
/// Leaves these device rows out of a round.
void leave_out(const Prepared& prepared, const std::vector<std::size_t>& rows, Round& round);

struct Searched {
    Design design;
    SearchSetting setting;
    Model model;
};

/// All groups, and the model that the search finds; a later round starts from the earlier model.
/// `go_on`: asked at each step; false ends the search.
Searched search_of(const Prepared& prepared, const Round& round, KeySearch& keys,
                   const Searched* earlier, const std::function<bool()>& go_on);

/// What a model leaves of the readings, mm.
Eigen::VectorXd rest_of(const Prepared& prepared, Design& design, const Model& model);

}  // namespace trunnion::diagnosis
