// Terms of an effect that deviate from its textbook form: fitted if the readings require them, else
// held at 0.
#pragma once

#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// Input of a fit, without the catalogue.
struct FitInputs {
    const setup::Setup& setup;
    const records::ReadingTable& table;
    const emulator::Replay& replay;
    const std::vector<std::string>& effects;
};

/// Fits with all terms (fit_base), then without the unusual terms of an effect
/// (EffectParameter::usual) if omitting them is not significant (F test at 0.001). A term held at 0
/// becomes a key of the catalogue with the value 0. `notes` gets a sentence for each effect that is
/// fitted with or held without these terms.
BaseModel fit_needed_terms(const FitInputs& in, effects::Catalogue& catalogue,
                           std::vector<std::string>& notes);

}  // namespace trunnion::identification
