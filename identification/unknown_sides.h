// Side from which an axis arrived before its first motion, estimated when the table does not give
// it.
#pragma once

#include "identification/keys.h"

namespace trunnion::identification {

/// A side not given by the table, estimated from the readings.
struct FoundSide {
    std::size_t open = 0;  ///< index in Replay::unknown_sides
    std::string axis;      ///< axis name, with the session if there are several: "C of day2"
    signed char side = 1;  ///< the side that fits better
    double worse = 0.0;    ///< increase of the weighted sum of squares for the other side
    bool told() const;     ///< significant at two sigma or more
    double value() const;  ///< expectation of the side, with equal prior odds; -1 to 1
    double sigma() const;
};
/// One sentence: the side assumed, and whether the readings determine it.
std::string to_string(const FoundSide& found);

/// Names of the axes (with the session if there are several) whose side before their first motion
/// the table does not give, and on whose side an effect of the setup depends: a prediction takes +.
/// Empty without such axes.
std::string sides_taken_as_plus(const setup::Setup& setup, const records::ReadingTable& table);

/// The effect with every linear parameter at its typical size and the keys in `values`.
std::shared_ptr<const emulator::EffectModel> usual_model(const effects::Effect& effect,
                                                         std::vector<double> values);
/// True when the model's readings differ between the two sides.
bool sees_side(const emulator::Replay& replay, std::size_t open,
               const emulator::EffectModel& model);

/// Tries both sides of every axis and session that the table does not give and that an effect of
/// the fit or of the setup depends on, one after the other until none changes. Sets the replay to
/// the sides that fit best. Each trial is a full fit.
std::vector<FoundSide> choose_sides(const setup::Setup& setup, const records::ReadingTable& table,
                                    emulator::Replay& replay, const effects::Catalogue& catalogue,
                                    const std::vector<std::string>& effects);

/// The same for the sides in `open` and for effects fitted beside the base by linear least squares.
/// Sides without influence on any of the effects are unchanged and not returned.
std::vector<FoundSide> choose_sides_beside(const BaseModel& base,
                                           const records::ReadingTable& table,
                                           const std::vector<KeyedEffect>& effects,
                                           const std::vector<std::size_t>& open,
                                           emulator::Replay& replay);

}  // namespace trunnion::identification
