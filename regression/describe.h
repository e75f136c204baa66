// Clusters and gaps as differences with positions, source lines, sentences and fingerprints.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "interpreter/program_source.h"
#include "regression/comparison.h"
#include "regression/explained_cluster.h"
#include "regression/path_compare.h"
#include "regression/path_recorder.h"
#include "regression/program_lines.h"

namespace trunnion::regression {

/// The source lines of one side: its main program and the files that it called.
class SourceLines {
  public:
    explicit SourceLines(const interpreter::ProgramText& main);
    /// Sets block and context from program and line.
    void show(ComparePlace& place);
    const std::string& main_name() const { return name_; }

  private:
    const ProgramLines* lines_of(const std::string& program);

    std::string name_;
    std::map<std::string, interpreter::ProgramText> texts_;
    std::map<std::string, std::optional<ProgramLines>> lines_;
};

struct DescribedPath {
    const PathRecord& path;
    SourceLines& lines;
};
/// Two paths and what they were compared by.
struct DescribedPaths {
    DescribedPath a, b;
    PathSpace space;
    const Tolerances& tolerances;
};
/// Adds a path comparison to `result`: differences, worst place, table, picture.
void describe_paths(const PathComparison& found, const std::vector<ExplainedCluster>& clusters,
                    const DescribedPaths& paths, Comparison& result);

struct DescribedKeys {
    const KeyedLines& keys;
    SourceLines& lines;
};
/// Adds the gaps of a layer of lines or blocks to `result`, at most `most` of them.
void describe_gaps(DescribedKeys a, DescribedKeys b, std::size_t most, Comparison& result);

/// Sets the fingerprint of every difference, from its kind, its source lines without N numbers, and
/// the number of earlier occurrences. It does not change when lines are added or removed elsewhere.
void add_fingerprints(Comparison& result);

}  // namespace trunnion::regression
