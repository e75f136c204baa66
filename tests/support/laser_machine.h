// A table machine with a retroreflector in the spindle, for readings of a laser.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion {

inline setup::Setup laser_machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w C B b X Y Z t\"\n"
        "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.4 }\n",
        "s.toml", notes);
}

}  // namespace trunnion
