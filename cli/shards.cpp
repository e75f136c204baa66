#include "cli/shards.h"

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/notes.h"
#include "cli/options.h"

namespace trunnion::cli {

std::optional<regression::Shard> shard_of(const std::string& option) {
    if (!option.empty()) return regression::parse_shard(option);
    const auto shard = regression::shard_of_environment();
    if (shard)
        print_notes({fmt::format("shard {}/{} from the environment (--shard 1/1 runs everything)",
                                 shard->index, shard->count)});
    return shard;
}

std::string shard_path(std::string path, const regression::Shard& shard) {
    if (const std::size_t at = path.find("{i}"); at != std::string::npos)
        path.replace(at, 3, std::to_string(shard.index));
    return path;
}

}  // namespace trunnion::cli
