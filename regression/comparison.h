// The result of a comparison: plain values from which every report format is written.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/read_file.h"

namespace trunnion::regression {

/// The layers, from the text to its result.
enum class Layer : std::uint8_t { text, words, blocks, path, functions, axes, effects };
constexpr std::array<const char*, 7> layer_names{"text",      "words", "blocks", "path",
                                                 "functions", "axes",  "effects"};
constexpr const char* name_of(Layer layer) {
    return layer_names[static_cast<std::size_t>(layer)];
}

/// A position in one of the programs: line from 1 (0: none), its block and its neighbours.
struct ComparePlace {
    std::string program;
    int line = 0;
    int last_line = 0;  ///< end of the difference, >= line
    std::string block;
    std::vector<std::string> context;  ///< surrounding lines; the line of the position is at
                                       ///< `context_at`
    int context_at = 0;
};

enum class DifferenceKind : std::uint8_t {
    moved,
    path,
    only_a,
    only_b,
    reordered,
    feed,
    spindle,
    coolant,
    tool,
    time,
    value,
    alarm,
    text,
    function
};
constexpr std::array<const char*, 14> difference_names{
    "moved",   "path", "only-in-a", "only-in-b", "reordered", "feed", "spindle",
    "coolant", "tool", "time",      "value",     "alarm",     "text", "function"};
constexpr const char* name_of(DifferenceKind kind) {
    return difference_names[static_cast<std::size_t>(kind)];
}

/// One cluster: the same change in `count` places, of which the first is shown.
struct Difference {
    DifferenceKind kind = DifferenceKind::path;
    std::string what;   ///< one sentence
    std::string cause;  ///< known cause: "H2 instead of H3"; also part of `what`
    ComparePlace a, b;
    double position_mm = 0.0;
    double direction_deg = 0.0;
    std::array<double, 3> shift_mm{};  ///< B minus A (moved)
    double value_a = 0.0, value_b = 0.0;
    int tool = 0;
    std::uint64_t count = 1;
    std::string fingerprint;  ///< unchanged when lines are added or removed elsewhere
    bool expected = false;    ///< listed in the suite with `reason`
    std::string reason;
};

/// One line of the table: a tool and the results of its passes.
struct ToolRow {
    int tool = 0;
    std::uint64_t passes_a = 0, passes_b = 0;
    std::uint64_t equal = 0, moved = 0, changed = 0, reordered = 0, only_a = 0, only_b = 0;
    double cut_a_mm = 0.0, cut_b_mm = 0.0;
    double rapid_a_mm = 0.0, rapid_b_mm = 0.0;
    double cut_a_s = 0.0, cut_b_s = 0.0;
    std::array<double, 2> feed_a{}, feed_b{};        ///< smallest and largest, mm/min
    std::array<double, 2> spindle_a{}, spindle_b{};  ///< rpm

    /// False when both sides only retract.
    bool says_something() const {
        return cut_a_mm > 0.0 || cut_b_mm > 0.0 ||
               moved + changed + reordered + only_a + only_b > 0;
    }
};

struct LayerVerdict {
    Layer layer = Layer::path;
    bool equal = false;
};

/// Both paths as polylines of tips (mm, table frame), thinned out, and the differing parts, for the
/// picture.
struct ComparePicture {
    using Point = std::array<double, 3>;
    using Line = std::vector<Point>;
    struct Mark {
        std::size_t difference = 0;  ///< index in Comparison::differences
        Line a, b;                   ///< its first place on each side
    };
    /// A place where both differ, with the surrounding paths in full detail.
    struct Closeup {
        std::size_t difference = 0;
        bool first = false, worst = false;  ///< first difference; largest distance of all
        Point place_mm{};                   ///< on A, or on B where A has nothing
        Point other_mm{};                   ///< the nearest point of the other path
        Point right{}, up{};                ///< unit vectors: along the path, towards the other
                                            ///< path
        Point axis_a{}, axis_b{};           ///< unit vectors from tip to spindle
        Line a, b;
        double apart_mm() const;
    };
    std::vector<Line> cuts_a, cuts_b, rapids_a, rapids_b;
    std::vector<Mark> marks;
    std::vector<Closeup> closeups;
    bool empty() const { return cuts_a.empty() && cuts_b.empty(); }
};

enum class CompareStatus : std::uint8_t { equal, differs, alarm, bad_input, limit };
constexpr std::array<const char*, 5> status_names{"equal", "differs", "alarm", "bad-input",
                                                  "limit"};

/// Two programs, or one case of a suite.
struct Comparison {
    std::string name;  ///< of the case; the relative path in folders
    std::string a, b;  ///< files
    std::string setup, setup_b;
    CompareStatus status = CompareStatus::equal;
    bool equal = true;  ///< no differences except expected ones
    Layer by = Layer::path;
    std::string verdict;  ///< one line
    std::vector<LayerVerdict> layers;
    std::uint64_t compared = 0;
    double position_mm = 0.0, direction_deg = 0.0;  ///< largest of all deviations compared
    ComparePlace worst_a, worst_b;
    std::vector<Difference> differences;  ///< in the order of A
    std::uint64_t differences_left_out = 0;
    std::vector<ToolRow> tools;
    double time_a_s = 0.0, time_b_s = 0.0;
    std::string alarm_a, alarm_b;  ///< "PS0010 IMPROPER G-CODE" or empty
    std::vector<std::string> notes;
    ComparePicture picture;
};

/// Index of the difference to report first: an alarm, then machining that is missing, added or done
/// with another tool, then the largest distance. Without such a ranking the first one.
std::size_t gravest_difference(const Comparison& comparison);
/// Sort key of programs, most severe first: that of its most severe difference. A program that
/// could not be compared comes before all others.
double gravity_of(const Comparison& comparison);

/// An intended difference in one case (empty name: any case), by fingerprint.
struct ExpectedDifference {
    std::string case_name, fingerprint, reason;
};

/// Folders and suites: the cases in order.
struct CompareReport {
    std::string suite;  ///< name of the suite file or folders; empty for two single files
    bool single = true;
    std::vector<Comparison> cases;
    std::vector<ExpectedDifference> expected = {};  ///< what the suite lists
    std::vector<FileRead> inputs = {};              ///< files that it was made from
};

/// Those of `expected` that no case shows any more and that should be removed from the suite.
std::vector<ExpectedDifference> no_longer_occurring(const CompareReport& report);

/// 0 equal, 1 differs, 2 bad input, 3 alarm, 4 limit: the most severe of all cases; an alarm
/// precedes a difference.
int exit_code(const CompareReport& report);
/// One line: the verdict of the single case, or the number of equal cases.
std::string verdict_of(const CompareReport& report);

}  // namespace trunnion::regression
