// The first stage: readings beside their simulation, with everything that later stages only read.
#pragma once

#include "diagnosis/noise.h"
#include "identification/unknown_sides.h"

namespace trunnion::diagnosis {

/// Rows cut into groups that share errors or neighbourhood: the readings of one pose, a sixth of a
/// pass (and of a servo log where there are fewer than five). A fold leaves out whole groups.
struct Folds {
    static constexpr int count = 5;
    std::vector<int> group;  ///< by device row
    std::vector<int> fold;   ///< by group
};
Folds make_folds(const std::vector<NoiseBlock>& blocks, std::size_t rows);

/// Never changed after prepare(), but for the residual when large effects bend the readings, and
/// for sides that the table leaves open.
struct Prepared {
    Prepared(const setup::Setup& setup, const records::ReadingTable& table);
    const records::ReadingTable& table;
    emulator::Replay replay;
    effects::Catalogue catalogue;
    std::vector<identification::FoundSide> base_sides;  ///< that the base model sees
    std::vector<std::size_t> open_sides;  ///< of Replay::unknown_sides: those that it does not see
    std::vector<identification::FoundSide>
        sides;                       ///< that base and causes see, as the fit takes them
    identification::BaseModel base;  ///< location, set-up; residual in mm
    std::vector<NoiseBlock> blocks;
    Folds folds;
};

/// Throws InputError: too few readings, values of another machine.
Prepared prepare(const setup::Setup& setup, const records::ReadingTable& table);
/// Throws InputError for held-out readings that cannot be of this machine.
void refuse_poor_holdout(const Prepared& prepared, const records::ReadingTable& holdout);

/// Throws InputError when there is nothing to compare.
void refuse_one_session(const Prepared& prepared);

/// Is the effect one that the simulation has already?
bool modelled(const Prepared& prepared, const effects::Effect& effect);

}  // namespace trunnion::diagnosis
