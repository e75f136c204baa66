// What each file of this room puts into the Python module.
#pragma once

#include <pybind11/pybind11.h>

namespace trunnion::python {

/// InputError and Alarm become exceptions that know their place.
void add_errors(pybind11::module_& m);
void add_setups(pybind11::module_& m);
void add_readings(pybind11::module_& m);
void add_runs(pybind11::module_& m);
/// predict, identify and diagnose.
void add_fits(pybind11::module_& m);
void add_comparisons(pybind11::module_& m);

/// Work that holds no Python object: other threads of Python go on meanwhile.
using WithoutLock = pybind11::call_guard<pybind11::gil_scoped_release>;

}  // namespace trunnion::python
