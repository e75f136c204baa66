// Ctrl-C during work without Python's lock.
#pragma once

namespace trunnion::python {

/// Throws pybind11::error_already_set (KeyboardInterrupt) after Ctrl-C. Takes the lock for a
/// moment; only Python's main thread gets the signal.
void stop_on_ctrl_c();

}  // namespace trunnion::python
