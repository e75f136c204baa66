// Variables that show modal state: #4001 to #4599.
#pragma once

#include <functional>
#include <optional>

#include "controller/modal.h"

namespace trunnion::controller {

/// Where the language stands: #4114 and #4115.
struct ProgramPlace {
    std::function<int()> sequence_number, program_number;  ///< empty: 0
};

/// #4001-#4130 the previous block, #4201.. the running one, #4401.. the interrupted one: the same
/// here, because a macro statement runs when the blocks before it are done. Nothing for another
/// number.
std::optional<double> modal_variable(int number, const Modal& modal, const ProgramPlace& place);

}  // namespace trunnion::controller
