// Set-up results in words: a rotated part is not an error of the machine.
#pragma once

#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// One sentence for the observable pose and scale of each instrument in each session: "tuesday: the
/// part was turned by 0.029 deg, shifted by (-0.044, 0.079, 0) mm". One for the zero of an encoder
/// that is five times its uncertainty or more: "X is read 300 µm beside its commanded position in
/// all rows".
std::vector<std::string> set_up_words(const setup::Setup& setup,
                                      const std::vector<FitParameter>& parameters);

}  // namespace trunnion::identification
