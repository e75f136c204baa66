// Ctrl-C while work without Python's lock goes on.
#pragma once

namespace trunnion::python {

/// Throws pybind11::error_already_set (KeyboardInterrupt) when Ctrl-C came. Takes the lock for a
/// moment; only the main thread of Python is told.
void stop_on_ctrl_c();

}  // namespace trunnion::python
