// Which shard of a job a command does, and what its part is called.
#pragma once

#include <optional>
#include <string>

#include "regression/suite.h"

namespace trunnion::cli {

/// What --shard says, else the environment of a job array (a note says so), else none. Throws
/// InputError.
std::optional<regression::Shard> shard_of(const std::string& option);

/// `{i}` in a file name is the number of the shard.
std::string shard_path(std::string path, const regression::Shard& shard);

}  // namespace trunnion::cli
