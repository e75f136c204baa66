// G, M and T codes that call programs by parameters 6050-6089 and 6001#5.
#pragma once

#include "interpreter/interpreter.h"
#include "offsets/stores.h"

namespace trunnion::controller {

/// 6050-6059: G codes that call O9010-O9019 with arguments (negative: modal, like G66); 6071-6079:
/// M codes that call O9001-O9009 without arguments; 6080-6089: M codes that call O9020-O9029 with
/// arguments; 6001#5: T calls O9000 (docs/backup_files.md).
interpreter::CodeCalls decode_code_calls(const offsets::Parameters& parameters);

}  // namespace trunnion::controller
