// Sides from which axes came before their first motion, where the table does not tell them.
#pragma once

#include "identification/base_model.h"

namespace trunnion::identification {

/// Tries both sides of every axis and session that the table leaves open and that the effects
/// (those of the fit and those of the setup) see, one after the other until none changes, and
/// leaves the replay with those that fit best. Returns a note for each: the side taken, and by how
/// much the other fits worse (difference of the weighted squares; below 4 the readings do not
/// tell).
std::vector<std::string> choose_sides(const setup::Setup& setup, const records::ReadingTable& table,
                                      emulator::Replay& replay, const effects::Catalogue& catalogue,
                                      const std::vector<std::string>& effects);

}  // namespace trunnion::identification
