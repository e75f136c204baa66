// Terms of an effect that let it bend away from the textbook's form: fitted where the readings ask
// for them, else held at 0.
#pragma once

#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// What a fit takes, but for the catalogue.
struct FitInputs {
    const setup::Setup& setup;
    const records::ReadingTable& table;
    const emulator::Replay& replay;
    const std::vector<std::string>& effects;
};

/// Fits with all terms (fit_base); then without those terms of an effect that are not usual
/// (EffectParameter::usual), where leaving them out costs no more than chance does (F test at
/// 0.001). What is held at 0 becomes a key of the catalogue with the value 0. `notes` gets a
/// sentence for each effect that bends or is held straight.
BaseModel fit_needed_terms(const FitInputs& in, effects::Catalogue& catalogue,
                           std::vector<std::string>& notes);

}  // namespace trunnion::identification
