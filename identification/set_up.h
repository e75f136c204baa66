// Quantities of the set-up that readings tell anew: names, places in a setup, derivatives.
#pragma once

#include <string>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Where one such quantity stands in a setup.
struct SetUpQuantity {
    enum class Kind : unsigned char {
        none,
        artefact,        ///< its centre in W
        target_on_tool,  ///< its place in S, beside the declared one
        cup,
        length,  ///< of the ballbar
        stylus,  ///< the ball of a longer one beside its place straight below
        long_cup,
        instrument,
        zero  ///< of a test of a laser or autocollimator
    };
    Kind kind = Kind::none;
    int index = 0;      ///< of the artefact, the instrument or the test
    int component = 0;  ///< x y z; of an instrument x y z, a b c of its pose, then its scale
    double extension_mm = 0.0;  ///< of a longer stylus or cup
    /// Of a session after the first: the setup has one place for each, so that value stands in its
    /// `zeros`, at `slot`.
    int session = 0, slot = 0;
};

struct FreeQuantity {
    std::string name, unit;  ///< "S1.x_mm", "cup.z_mm", "stylus+60.x_mm", "tracker.a_rad"
    double typical = 0.1;    ///< in `unit`
    SetUpQuantity place;
};

/// Those that the setup leaves free and that the rows of the replay depend on; where the replay has
/// several sessions each anew for each of them ("S1.x_mm.tuesday").
std::vector<FreeQuantity> free_quantities(const setup::Setup& setup,
                                          const emulator::Replay& replay);
/// Room in the setup for the values of tests and later sessions; each begins at the setup's own, or
/// at those of its [[session]].
void begin_sessions(setup::Setup& setup, const emulator::Replay& replay);
/// What a fit of several sessions found, as [[session]] entries of the setup.
void keep_sessions(setup::Setup& fitted, const emulator::Replay& replay);
/// The number itself.
double& number_of(setup::Setup& setup, const SetUpQuantity& quantity);
/// d reading / d quantity of device row i, from what its gradient says about machine and tool.
double set_up_derivative(const SetUpQuantity& quantity, const emulator::Replay& replay,
                         std::size_t i, const kinematics::Perturbation& gradient);
/// Difference to the quantities of the replay's setup, which are those of the file.
emulator::ReplayOffsets offsets_to(const emulator::Replay& replay, const setup::Setup& fitted);

}  // namespace trunnion::identification
