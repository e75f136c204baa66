// A setup as an object of Python.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::python {

struct LoadedSetup {
    setup::Setup setup;
    std::vector<std::string> notes;  ///< derived values and unknown keys, one line each
};

}  // namespace trunnion::python
