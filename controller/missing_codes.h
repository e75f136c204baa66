// G codes of options that a Fanuc mill may have and this control has not: a refusal names them.
#pragma once

namespace trunnion::controller {

/// "NURBS interpolation" for 62 (G6.2); nullptr for a code that is no such option.
const char* missing_option(int code10);

}  // namespace trunnion::controller
