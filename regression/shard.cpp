#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "base/alarm.h"
#include "regression/suite.h"

namespace trunnion::regression {

namespace {

std::optional<int> number_of(std::string_view text) {
    int n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return n;
}

std::optional<int> variable(const char* name) {
    const char* value = name != nullptr ? std::getenv(name) : nullptr;
    return value != nullptr ? number_of(value) : std::nullopt;
}

/// A launcher that divides a job into processes. `first`: variable with the lowest index; `step`:
/// variable with the distance between two indices.
struct Launcher {
    const char *index, *count, *first, *step;
};
constexpr Launcher launchers[] = {
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
     "SLURM_ARRAY_TASK_STEP"},
    {"JOB_COMPLETION_INDEX", "JOB_COMPLETIONS", nullptr,
     nullptr},  // the count comes from the job's own env
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", nullptr, nullptr},
    {"PMI_RANK", "PMI_SIZE", nullptr, nullptr},
    {"PMIX_RANK", "SLURM_NTASKS", nullptr, nullptr}};

/// Index and, if available, count from the environment.
struct Found {
    int index = 1;
    std::optional<int> count;
};

std::optional<Found> find_in_environment() {
    for (const Launcher& l : launchers) {
        const auto index = variable(l.index);
        if (!index) continue;
        const int first = variable(l.first).value_or(l.first != nullptr ? 1 : 0);
        const int step = std::max(1, variable(l.step).value_or(1));
        return Found{(*index - first) / step + 1, variable(l.count)};
    }
    return std::nullopt;
}

Shard checked(int index, int count, const std::string& text) {
    if (count < 1 || index < 1 || index > count)
        throw InputError(fmt::format("--shard {}: {} of {} is no shard", text, index, count));
    return {index, count};
}

}  // namespace

std::optional<Shard> shard_of_environment() {
    const auto found = find_in_environment();
    if (!found || !found->count || *found->count < 2) return std::nullopt;
    return checked(found->index, *found->count, "from the environment");
}

Shard parse_shard(const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::string_view parts(text);
    const int index = number_of(parts.substr(0, slash)).value_or(0);
    const int given = slash < text.size() ? number_of(parts.substr(slash + 1)).value_or(0) : 0;
    if (slash > 0 && slash < text.size()) return checked(index, given, text);
    if (text != "env" && given < 1) throw InputError("--shard " + text + ": give i/n, /n or env");
    const auto found = find_in_environment();
    if (!found)
        throw InputError("--shard " + text +
                         ": the environment names no shard (Slurm array, Kubernetes indexed job, "
                         "MPI launcher)");
    const int count = given > 0 ? given : found->count.value_or(0);
    if (count == 0) throw InputError("--shard env: the environment does not say how many; give /n");
    return checked(found->index, count, text);
}

}  // namespace trunnion::regression
