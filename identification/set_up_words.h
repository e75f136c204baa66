// What was found about a set-up, in words: a part that was turned is no fault of the machine.
#pragma once

#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// One sentence for each instrument's pose and scale, for each session, with what the readings see
/// of it: "tuesday: the part was turned by 0.029 deg, shifted by (-0.044, 0.079, 0) mm".
std::vector<std::string> set_up_words(const setup::Setup& setup,
                                      const std::vector<FitParameter>& parameters);

}  // namespace trunnion::identification
