// The first stage: readings with their simulation, and all constant data of later stages.
#pragma once

#include <map>

#include "diagnosis/prepare/noise.h"
#include "identification/unknown_sides.h"

namespace trunnion::diagnosis {

/// Groups of rows that share errors or are neighbours: the readings of one pose, or a sixth of a
/// pass (and of a servo log if there are fewer than five). A fold leaves out whole groups; of few
/// poses every one is a fold.
struct Folds {
    static constexpr int count = 5;  ///< of many groups
    std::vector<int> group;          ///< group of each device row
    std::vector<int> fold;           ///< fold of each group
};
Folds make_folds(const std::vector<NoiseBlock>& blocks, std::size_t rows);
/// Makes one group of all targets that an instrument reads at one position of the axes: left out
/// one by one, each would be predicted by the others.
void join_targets(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                  const records::ReadingTable& table, Folds& folds);

/// Fewer allow no diagnosis.
inline constexpr std::size_t least_readings = 12;

/// Constant after prepare(), except for the residual of nonlinear readings, for sides not given by
/// the table, and for sigmas to which noise is added (diagnosis/added_noise.h).
struct Prepared {
    Prepared(const setup::Setup& setup, const records::ReadingTable& table);
    const records::ReadingTable& table;
    emulator::Replay replay;
    effects::Catalogue catalogue;
    effects::Catalogue only_rivals;  ///< what no setup contains; it may stand in a claim's place
    std::vector<identification::FoundSide> base_sides;  ///< sides that influence the base model
    std::vector<std::size_t> open_sides;  ///< indices in Replay::unknown_sides: those without
                                          ///< influence on it
    std::vector<identification::FoundSide>
        sides;                        ///< sides that influence base or causes, as used in the fit
    identification::BaseModel base;   ///< location errors and set-up; residual in mm
    Eigen::VectorXd stated_sigma_mm;  ///< of each device row, without what was found to add to it
    std::map<records::Device, double> added_mm;  ///< what was found (diagnosis/added_noise.h)
    double added(records::Device device) const {
        const auto found = added_mm.find(device);
        return found == added_mm.end() ? 0.0 : found->second;
    }
    std::vector<NoiseBlock> blocks;
    std::vector<Eigen::Index> cycle;  ///< of a laser test (diagnosis/prepare/cycles.h); else empty
    Eigen::VectorXd rounding_mm;      ///< deviation of each device row by its last digit, mm or rad
    Folds folds;
};

/// Throws InputError for too few readings, or values of another machine.
Prepared prepare(const setup::Setup& setup, const records::ReadingTable& table);
/// True when an axis went one way only, never back: time is then the position.
bool is_one_sweep(const emulator::Replay& replay, const std::vector<Axis>& axes);
/// True where no axis turns back more than once (one cycle of ISO 230-2): the order of the readings
/// is the position of the axis and its side.
bool is_one_cycle(const emulator::Replay& replay, const std::vector<Axis>& axes);

/// Subtracts from the readings of each laser or autocollimator test and session their mean,
/// weighted by sigma: the zero of a test is free.
void free_zeros(const emulator::Replay& replay, const Eigen::VectorXd& sigma_mm,
                Eigen::VectorXd& left_mm);

/// Throws InputError for held-out readings that cannot belong to this machine.
void refuse_poor_holdout(const Prepared& prepared, const records::ReadingTable& holdout);

/// Throws InputError when there is only one session.
void refuse_one_session(const Prepared& prepared);

/// True when the simulation already contains the effect.
bool modelled(const Prepared& prepared, const effects::Effect& effect);
/// False for what is modelled, and for a drift in readings without a clock: it has no course there.
bool is_searched(const Prepared& prepared, const effects::Effect& effect);

}  // namespace trunnion::diagnosis
