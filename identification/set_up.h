// Free quantities of the set-up: names, locations in a setup, derivatives.
#pragma once

#include <string>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Location of one such quantity in a setup.
struct SetUpQuantity {
    enum class Kind : unsigned char {
        none,
        artefact,        ///< its centre in W
        target_on_tool,  ///< its position in S, relative to the declared one
        cup,
        length,  ///< of the ballbar, mm
        stylus,  ///< ball of a longer stylus, relative to the position straight below
        long_cup,
        instrument,
        zero,    ///< zero of a test of a laser or autocollimator
        encoder  ///< zero of an axis's own encoder, mm or rad
    };
    Kind kind = Kind::none;
    int index = 0;              ///< of artefact, instrument, test or axis
    int component = 0;          ///< x y z; instrument: x y z, a b c of its pose, then its scale
    double extension_mm = 0.0;  ///< of a longer stylus or cup
    /// Later sessions: the setup has one location for each quantity only, so their values are
    /// stored in its `zeros` at `slot`.
    int session = 0, slot = 0;
    std::string session_name = {};  ///< in names of quantities; empty with a single session
};

struct FreeQuantity {
    std::string name, unit;  ///< "S1.x_mm", "cup.z_mm", "stylus+60.x_mm", "tracker.a_rad"
    double typical = 0.1;    ///< in `unit`
    SetUpQuantity place;
    /// `name` without the session, as in [[session]] of a setup file.
    std::string quantity = name;
};

/// Quantities that are free in the setup and used by rows of the replay. With several sessions
/// there is one for each session ("S1.x_mm.tuesday").
std::vector<FreeQuantity> free_quantities(const setup::Setup& setup,
                                          const emulator::Replay& replay);
/// Allocates the values of tests and later sessions in the setup, starting at the setup's own
/// values or at those of its [[session]].
void begin_sessions(setup::Setup& setup, const emulator::Replay& replay);
/// Stores the results of a fit of several sessions as [[session]] entries of the setup.
void keep_sessions(setup::Setup& fitted, const emulator::Replay& replay);
/// Reference to the value.
double& number_of(setup::Setup& setup, const SetUpQuantity& quantity);
/// Derivative of device row i with respect to the quantity, from its gradient by machine and tool.
double set_up_derivative(const SetUpQuantity& quantity, const emulator::Replay& replay,
                         std::size_t i, const kinematics::Perturbation& gradient);
/// Differences from the set-up quantities of the replay's setup, which are those of the file.
emulator::ReplayOffsets offsets_to(const emulator::Replay& replay, const setup::Setup& fitted);

}  // namespace trunnion::identification
