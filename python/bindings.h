// Contribution of each file of this room (*.cpp) to the Python module.
#pragma once

#include <pybind11/pybind11.h>

namespace trunnion::python {

/// Converts InputError and Alarm to exceptions with their position.
void add_errors(pybind11::module_& m);
void add_setups(pybind11::module_& m);
void add_readings(pybind11::module_& m);
void add_runs(pybind11::module_& m);
/// predict, identify and diagnose.
void add_fits(pybind11::module_& m);
void add_comparisons(pybind11::module_& m);

/// Work without Python objects: other Python threads continue meanwhile.
using WithoutLock = pybind11::call_guard<pybind11::gil_scoped_release>;

}  // namespace trunnion::python
