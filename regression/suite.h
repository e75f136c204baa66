// Many comparisons at once: folders and suite files, run on all cores or as one shard of many.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// One comparison to make.
struct SuiteCase {
    std::string name;
    std::string a;               ///< older program; empty: only B is there
    std::string b;               ///< newer program; empty: only A is there
    std::string golden;          ///< instead of `a`: numbers written by --update
    std::string setup, setup_b;  ///< files; empty: the default one
    CompareOptions options;
};

struct Suite {
    std::string name;
    std::vector<SuiteCase> cases;
    std::vector<ExpectedDifference> expected;
};

/// The NC programs below a folder, as relative paths: files with one of the usual endings, or named
/// by their O number. Throws InputError when it is no folder.
std::set<std::string> programs_below(const std::string& folder);

/// Every NC program below two folders, by relative path. Throws InputError when one is no folder.
Suite suite_of_folders(const std::string& a, const std::string& b, const SuiteCase& like);

/// Reads a suite file (docs/compare.md); paths in it are relative to its folder. `like` holds what
/// the command line gives: tolerances, setups.
Suite read_suite(const std::string& path, const SuiteCase& like);

/// Shard `index` (from 1) of `count`.
struct Shard {
    int index = 1, count = 1;
};
/// "2/5", or "/5" and "env" with the index (and count) of a Slurm array, a Kubernetes indexed job
/// or an MPI launcher in the environment. Throws InputError.
Shard parse_shard(const std::string& text);
/// What the environment says, when it says anything with a count above one.
std::optional<Shard> shard_of_environment();

struct SuiteRun {
    CompareReport report;             ///< the shard's cases
    std::vector<std::size_t> places;  ///< their numbers in the suite
};
/// Loads setups by path ("" is the default one).
using SetupLoader = setup::Setup (*)(const std::string& path);
/// Who looks on while a suite runs; both may be empty, both are called from any thread.
struct SuiteWatch {
    std::function<void(std::size_t done, std::size_t total)> progress;
    std::function<bool()> stop;  ///< true: what has not begun is left, and says so
};
/// The same results whatever the number of threads.
SuiteRun run_suite(const Suite& suite, Shard shard, SetupLoader load, unsigned threads,
                   const SuiteWatch& watch = {});

/// Golden files (path, text) of the cases that differ from theirs or have none.
std::map<std::string, std::string> updated_goldens(const Suite& suite, const std::string& reason,
                                                   SetupLoader load);

}  // namespace trunnion::regression
