// Sides from which axes came before their first motion, where the table does not tell them.
#pragma once

#include "identification/keys.h"

namespace trunnion::identification {

/// A side that the table leaves open, as the readings answer.
struct FoundSide {
    std::size_t open = 0;  ///< index in Replay::unknown_sides
    std::string axis;      ///< its name, with the session where there are several: "C of day2"
    signed char side = 1;  ///< that fits better
    double worse = 0.0;    ///< what the other side leaves more, in weighted squares
    bool told() const;     ///< by two sigma or more
    double value() const;  ///< mean of the side by equal odds beforehand, -1 to 1
    double sigma() const;
};
/// One sentence: the side taken, and whether the readings tell it.
std::string to_string(const FoundSide& found);

/// The effect with every linear parameter at its usual size, keys as in `values`.
std::shared_ptr<const emulator::EffectModel> usual_model(const effects::Effect& effect,
                                                         std::vector<double> values);
/// Does the model read otherwise on the other side?
bool sees_side(const emulator::Replay& replay, std::size_t open,
               const emulator::EffectModel& model);

/// Tries both sides of every axis and session that the table leaves open and that the effects
/// (those of the fit and those of the setup) see, one after the other until none changes, and
/// leaves the replay with those that fit best. Each trial is a fit of its own.
std::vector<FoundSide> choose_sides(const setup::Setup& setup, const records::ReadingTable& table,
                                    emulator::Replay& replay, const effects::Catalogue& catalogue,
                                    const std::vector<std::string>& effects);

/// The same for sides in `open` and effects that are fitted beside the base, by linear least
/// squares. Sides that none of the effects sees stay as they are and are not returned.
std::vector<FoundSide> choose_sides_beside(const BaseModel& base,
                                           const records::ReadingTable& table,
                                           const std::vector<KeyedEffect>& effects,
                                           const std::vector<std::size_t>& open,
                                           emulator::Replay& replay);

}  // namespace trunnion::identification
