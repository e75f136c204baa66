#include "python/signals.h"

#include <pybind11/pybind11.h>

namespace trunnion::python {

void stop_on_ctrl_c() {
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}

}  // namespace trunnion::python
