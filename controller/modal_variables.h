// Variables that show modal state: #4001 to #4599.
#pragma once

#include <functional>
#include <optional>

#include "controller/modal.h"

namespace trunnion::controller {

/// Position in the program, for #4114 and #4115.
struct ProgramPlace {
    std::function<int()> sequence_number, program_number;  ///< empty: 0
};

/// #4001-#4130 previous block, #4201.. running block, #4401.. interrupted block. All three are
/// equal here, because a macro statement runs after the blocks before it are complete. Empty for
/// any other number. #3005 tells inch input, #3008 is 0: the program was not restarted.
std::optional<double> modal_variable(int number, const Modal& modal, const ProgramPlace& place);

}  // namespace trunnion::controller
