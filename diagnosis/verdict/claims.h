// Claims of the chosen model: share, probability and rivals of each cause.
#pragma once

#include "diagnosis/verdict/contenders.h"

namespace trunnion::diagnosis {

/// Sizes of all parts, in whitened squares.
struct Sizes {
    double floor = 1.0;          ///< variance of the noise of one reading
    double whole = 0.0;          ///< E: all causes together, residual beyond noise, drivers, zeros
    std::vector<double> square;  ///< |c_k|^2 of each member
    std::vector<double> along;   ///< c_k . sum of all causes; of a change: of all changes, because
                                 ///< an error that became smaller is no correction of another
    Eigen::MatrixXd parts;       ///< rows x members
    Eigen::VectorXd remainder;   ///< whitened residual of the model, rows
};
/// `large` marks zeros that are part of the gap.
Sizes sizes_of(Design& design, const Model& model, double floor, const std::vector<bool>& large);

/// The error motion of a cause, in whatever form.
effects::EffectKind motion_of(const ColumnGroup& group);

/// Name of a rival: the spindle side drifts in a form of its own. No setup contains it.
inline constexpr const char* machine_drift = "machine.drift";
/// Name of a rival: the table is mistaken. No setup contains it.
inline constexpr const char* mistaken_readings = "readings.mistaken";
inline constexpr const char* rounded_readings = "readings.rounded";

struct Claim {
    std::size_t position = 0;  ///< in the model's members
    std::string name;
    double share = 0.0, own = 0.0;
    double rms = 0.0;  ///< of the readings, in sigma
    double probability = 0.0;
    std::vector<std::string> rivals;
    std::vector<std::size_t> rival_groups;
    bool interpolates = true;  ///< a table that predicts left-out positions
    bool second_part = false;  ///< the smaller part of an error that stands in two claims
};
/// Names a rival once.
void add_rival(const std::string& name, Claim& claim);

/// Evidence of left-out readings about one member.
struct Support {
    Saving saving;  ///< reduction of the loss by including it
};

/// What left-out readings say about a model.
struct HeldOutEvidence {
    const std::vector<Support>& support;  ///< of each member
    const Challenged& found;
    const Folds& folds;
    const std::vector<bool>& interpolates;  ///< members that hold between their places
    double explained;  ///< H, the part of the gap that they confirm: no probability is above it
    double variance;   ///< of one reading, under which the models are weighed
};

/// Causes that explain nearly as much as a driver or a large zero in its place, most likely first,
/// and the probability of none of them, nor of nothing, as far as the number of blocks allows it.
struct Instead {
    std::vector<std::string> rivals;
    double probability = 1.0;
};
Instead instead_of(Design& design, const Model& model, std::size_t position, double blocks);

/// Causes above the background, largest share first.
std::vector<Claim> claims_of(const Searching& search, const Model& model, const Sizes& sizes,
                             const HeldOutEvidence& heldout);

}  // namespace trunnion::diagnosis
