// Commanded and read axis positions in the columns of a log.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/columns.h"
#include "imports/facts.h"
#include "imports/time_column.h"

namespace trunnion::imports {

/// The columns of one axis.
struct AxisColumns {
    Axis axis = Axis::X;
    bool rotary = false;
    std::string name;
    std::size_t missing = 0;
    std::optional<NumberColumn> commanded, actual, error, velocity, acceleration;
    double error_sign = 1.0;
    std::optional<double> last_rad;  ///< commanded position of the row before, and whole turns
    double turns_rad = 0.0;          ///< added to it after steps from 360 to 0 deg
    bool rolled_over = false;

    bool read() const { return (commanded && actual) || (commanded && error); }
    const std::optional<NumberColumn>& place() const { return commanded ? commanded : actual; }
};

/// The column with the block of a row, as a line of the program or an N number.
struct BlockColumnFound {
    std::size_t column = 0;
    bool is_line = false;
};
/// By its name: line, N, block, sequence number; empty if there is none.
std::optional<BlockColumnFound> find_block_column(const TextTable& table);

struct LogColumns {
    std::vector<AxisColumns> axes;
    std::vector<std::string> unused;
    std::vector<std::string> taken_as_actual;  ///< "J5 pos" next to "J5 target"
    bool units_assumed = false;
    bool of_motor = false;  ///< names of a motor stand for the axis that the user gave
    std::optional<BlockColumnFound> block;
    std::optional<std::size_t> session;

    /// True for positions only, with the blocks of a program: no axis has both commanded and actual
    /// positions.
    bool places_only() const;
};

/// From the column names and the facts axis, unit and sign. Throws InputError (header line) when no
/// axis has both positions, or when the sign of an error is not given. With `blocks` a column may
/// give the blocks of a program; positions alone are then sufficient.
LogColumns log_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                       const TimeColumn& time, bool blocks = false);

/// Values of one axis in one line: mm or rad.
struct LogEntry {
    double commanded = 0.0, error = 0.0;  ///< error: read - commanded
};
/// Empty when one of the two is missing. The error of a rotary axis is below half a turn.
std::optional<LogEntry> log_entry(const TextTable& table, std::size_t row,
                                  const std::vector<records::TableCell>& cells,
                                  const AxisColumns& axis);
/// A commanded position. A control that shows a rotary axis from 0 to 360 deg steps back by a turn
/// while the axis goes on: a step of a turn, within 60 deg, is taken as such.
double without_roll_over(AxisColumns& axis, double commanded);
/// A number; empty when it is missing.
std::optional<double> number_or_none(const TextTable& table, std::size_t row,
                                     const std::vector<records::TableCell>& cells,
                                     const std::optional<NumberColumn>& column);
/// "X, B (with commanded speed)": the axes that were read.
std::string axes_words(const LogColumns& log);
/// Units assumed, missing values, unused columns.
std::vector<std::string> log_notes(const TextTable& table, const LogColumns& log);

}  // namespace trunnion::imports
