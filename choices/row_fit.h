// How well the rows of a log fit: their scatter, what noise may do, and which rows a cause reaches.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "choices/compared_run.h"
#include "choices/log_view.h"

namespace trunnion::choices {

/// Block of each row: the one given by the log, else the one of the control at that point.
std::vector<int> blocks_of(const LogView& log, const ComparedRun& run);

/// Scatter of the samples about the path, from one row of a block to the next: a constant
/// difference is none. Nothing without enough such rows.
std::optional<double> scatter_about(const LogView& view, const ComparedRun& run,
                                    const std::vector<int>& blocks);

/// Part of the rows with a visible gap that an explanation brings down to noise. An exact cause
/// spoils no row: such a row counts as several.
double reached(const std::vector<double>& before, const std::vector<double>& after,
               double row_limit);

/// The same of blocks: a block without a visible gap that is clearly wrong with the explanation
/// counts as several. In a log of samples it may have few rows.
double reached_blocks(const std::vector<double>& before, const std::vector<double>& after,
                      const std::vector<int>& blocks, double row_limit);

/// Rows are clearly wrong with the explanation, one that was right or more than one in a hundred:
/// it is not the whole truth.
bool stays_wrong(const std::vector<double>& before, const std::vector<double>& after,
                 double row_limit);

/// Loss of a row that noise may have. Noise that nobody stated may be larger than the printed
/// increment: then it is what the rows scatter from one to the next beside the explanation (a log
/// of few rows a block; a dense one has shown it), at least the rounding of a control to its least
/// increment.
double row_limit_of(const LogOfProgram& log, const ComparedRun& base, const ComparedRun& explained,
                    const std::vector<int>& blocks, double gap);

/// Loss of a row beside a cause where something small stays in most rows or most blocks: axes that
/// have backlash or lag at corners, in a log of actual positions. That is no part of the cause; it
/// may be as large as usual there, a small part of the gap, and 0.03 mm. At least `row_limit`.
double beside_remainder(const LogOfProgram& log, const ComparedRun& base,
                        const ComparedRun& explained, const std::vector<int>& blocks,
                        double row_limit);

/// No axis of a row is farther than half the printed increment, and the log has no other noise:
/// printing alone may do that, alike in all rows at rest.
bool is_rounding(const LogView& view, const ComparedRun& run);
/// The same of the rows that fit better with other losses: these show nothing that printing may not
/// have done.
bool is_rounding(const LogView& view, const ComparedRun& run, const std::vector<double>& other);

/// "its lengths are inches", "X and Y are exchanged": another meaning of the columns under which
/// the log agrees; empty: none. `loss`: with the meaning that was read.
std::string agreeing_columns(const Comparer& comparer, const setup::Setup& setup, double loss);

}  // namespace trunnion::choices
