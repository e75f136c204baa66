// A run of a setup's control compared with a log: path, pairs, and their distances.
#pragma once

#include <optional>

#include "choices/pairing.h"

namespace trunnion::choices {

struct ComparedRun {
    ControlPath path;
    std::vector<Pair> pairs;
    std::vector<double> losses;  ///< one for each row of the log: squares in units of its sigma
    double loss = 0.0;           ///< their sum
};

/// Repeated comparison of one program with one log.
class Comparer {
  public:
    Comparer(const LogView& log, const interpreter::ProgramText& program,
             interpreter::ProgramSource& programs, PathOptions options)
        : log_(log), program_(program), programs_(programs), options_(options) {}

    const LogView& log() const { return log_; }
    /// The same program with other positions in the log, which must outlive the result.
    Comparer on(const LogView& log) const {
        PathOptions options = options_;
        if (!log.ends && !log.begins_within && !log.from_zero)
            options.start = offsets::axis_positions_of(log.rows.front().at);
        return {log, program_, programs_, options};
    }
    /// The same log with another program, which must outlive the result.
    Comparer of(const interpreter::ProgramText& program) const {
        return {log_, program, programs_, options_};
    }
    const interpreter::ProgramText& program() const { return program_; }
    ControlPath path(const setup::Setup& setup) const {
        return path_of(setup, program_, programs_, options_);
    }
    /// With four points a move, however far a curve is from these.
    ControlPath outline(const setup::Setup& setup) const;
    ComparedRun compared(ControlPath path) const;
    ComparedRun run(const setup::Setup& setup) const { return compared(path(setup)); }

  private:
    const LogView& log_;
    const interpreter::ProgramText& program_;
    interpreter::ProgramSource& programs_;
    PathOptions options_;
};

/// True when the axes move on the same path, within 1e-7 mm and deg.
bool same_way(const ControlPath& a, const ControlPath& b);

/// Tells which other controls move as this one does. The points of long curves take most of the
/// time of a run: there outlines are compared, and no more points are asked of a control with the
/// same.
class SameWay {
  public:
    SameWay(const Comparer& comparer, const setup::Setup& setup, const ControlPath& path);
    /// The path of another control; nothing if it moves on this one's.
    std::optional<ControlPath> other(const setup::Setup& setup) const;
    /// False if its outline is this one's, without a look at more.
    bool may_differ(const setup::Setup& setup) const;

  private:
    const Comparer& comparer_;
    const ControlPath& path_;
    std::optional<ControlPath> outline_;  ///< only of long curves
};

double sum_of(const std::vector<double>& values);

}  // namespace trunnion::choices
