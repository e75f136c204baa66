// Meaning of the program's exit code (docs/formats.md).
#pragma once

namespace trunnion::inline base {

enum ExitCode : int {
    exit_done = 0,       ///< done, equal, nothing found
    exit_differs = 1,    ///< differs, findings, or a gap above the given limit
    exit_bad_input = 2,  ///< bad input or usage; output that cannot be written
    exit_alarm = 3,      ///< an NC alarm
    exit_limit = 4,      ///< a limit was reached (also memory), or Ctrl-C
    exit_internal = 5
};

}  // namespace trunnion::inline base
