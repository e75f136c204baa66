// Many comparisons at once (suite_*.cpp), on all cores or as one of several shards (shard.cpp).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// One comparison.
struct SuiteCase {
    std::string name;
    std::string a;               ///< older program; empty: only B exists
    std::string b;               ///< newer program; empty: only A exists
    std::string golden;          ///< instead of `a`: numbers written by --update
    std::string setup, setup_b;  ///< files; empty: the default setup
    CompareOptions options;
};

struct Suite {
    std::string name;
    std::vector<SuiteCase> cases;
    std::vector<ExpectedDifference> expected;
};

/// The NC programs below a folder, as relative paths: files with a usual extension, or named by
/// their O number. Throws InputError when it is not a folder.
std::set<std::string> programs_below(const std::string& folder);

/// Every NC program below two folders, by relative path. Throws InputError when one is not a
/// folder.
Suite suite_of_folders(const std::string& a, const std::string& b, const SuiteCase& like);

/// Reads a suite file (docs/compare.md); its paths are relative to its folder. `like`: tolerances
/// and setups of the command line.
Suite read_suite(const std::string& path, const SuiteCase& like);

/// Shard `index` (from 1) of `count`.
struct Shard {
    int index = 1, count = 1;
};
/// "2/5"; or "/5" or "env" with index (and count) of a Slurm array, a Kubernetes indexed job or an
/// MPI launcher in the environment. Throws InputError.
Shard parse_shard(const std::string& text);
/// The shard given by the environment, if its count is above one.
std::optional<Shard> shard_of_environment();

struct SuiteRun {
    CompareReport report;             ///< the cases of the shard
    std::vector<std::size_t> places;  ///< their numbers in the suite
};
/// Loads a setup by path ("" is the default).
using SetupLoader = setup::Setup (*)(const std::string& path);
/// Callbacks while a suite runs; both may be empty, and both are called from any thread.
struct SuiteWatch {
    std::function<void(std::size_t done, std::size_t total)> progress;
    /// Not empty: what ended the work; cases not yet started are skipped and marked so.
    std::function<std::string()> stop;
};
/// The results do not depend on the number of threads.
SuiteRun run_suite(const Suite& suite, Shard shard, SetupLoader load, unsigned threads,
                   const SuiteWatch& watch = {});

/// Golden files (path, text) of the cases that differ from their golden or have none.
std::map<std::string, std::string> updated_goldens(const Suite& suite, const std::string& reason,
                                                   SetupLoader load);

}  // namespace trunnion::regression
