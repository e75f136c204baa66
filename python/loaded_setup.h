// A setup as Python holds it.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::python {

struct LoadedSetup {
    setup::Setup setup;
    std::vector<std::string> notes;  ///< what was derived or is not known, a line each
};

}  // namespace trunnion::python
