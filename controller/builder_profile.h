// G and M codes and variables that the machine builder added to the control.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "controller/g_codes.h"

namespace trunnion::controller {

/// The codes are accepted without effect on positions: axis words in the block of a G code without
/// a motion code (G0 to G3 ..) are its own and move nothing. A G or M code that moves something
/// needs a program that it calls (parameters 6050-6089).
struct BuilderProfile {
    std::vector<GCode> g_codes;
    std::vector<int> m_codes;                    ///< act before the motion of their block
    std::vector<int> m_codes_after;              ///< act after the motion
    std::vector<std::pair<int, int>> variables;  ///< first and last number: readable and writable

    void add_g_code(int code10) {
        g_codes.push_back({code10, ModalGroup::one_shot, Phase::reading, Action::builder,
                           "a code of the machine builder"});
    }
};

}  // namespace trunnion::controller
