// Evaluation of the passes of a real machine.
#pragma once

#include <optional>

#include "ballbar/test/ballbar_procedure.h"

namespace trunnion::ballbar::test {

/// Evaluates passes of a real machine, each against the nominal machine; `after` is a second
/// measurement with the new values. Circles alone give their ISO 230-4 parameters and no location
/// errors. Throws InputError when no row belongs to a pass.
BallbarResult evaluate_ballbar(const setup::Setup& stated, const records::ReadingTable& before,
                               const std::optional<records::ReadingTable>& after);

}  // namespace trunnion::ballbar::test
