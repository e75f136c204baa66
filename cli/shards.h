// The shard of a command, and the name of its part.
#pragma once

#include <optional>
#include <string>

#include "regression/suite.h"

namespace trunnion::cli {

/// From --shard, else from the environment of a job array (with a note), else none. Throws
/// InputError.
std::optional<regression::Shard> shard_of(const std::string& option);

/// Replaces `{i}` in a file name by the number of the shard.
std::string shard_path(std::string path, const regression::Shard& shard);

}  // namespace trunnion::cli
