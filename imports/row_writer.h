// Readings of an import in sequence: numbers the rows, keeps the clock, records their source.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "imports/columns.h"
#include "imports/import.h"
#include "records/readings.h"

namespace trunnion::imports {

/// Rows are converted to text at once: a servo log of a million rows is never held as a table of
/// readings.
class RowWriter {
  public:
    /// `columns`: optional columns used by this import (source, if given session, and the
    /// instrument if the setup has any, are added). `setup` must outlive the writer.
    RowWriter(const setup::Setup& setup, const std::string& kind, std::vector<std::string> columns,
              bool directions, bool degrees);
    /// Columns of these axes only: the file tells nothing about the others. Call it before all
    /// else.
    void keep_axes(const std::vector<Axis>& axes);
    /// Adds a last column that readings do not have: the block of a program. Call it before the
    /// first row.
    void add_column(const std::string& name);

    /// The following rows belong to this file: to the session named by `session=`, with
    /// `session=each` after the file, and to the [[instrument]] named by `instrument=`; throws
    /// InputError when the setup has none of the told name. A clock that restarts at zero continues
    /// one minute after the last row.
    void begin_file(const std::string& path, const Facts& facts);
    void begin_file(const TextTable& table, const Facts& facts) { begin_file(table.path(), facts); }
    /// Times of this file are seconds since 1970: a pause of four hours starts a new session named
    /// after its day, unless the file or `--with session=` gives a name.
    void name_days() { dated_ = true; }
    /// Times of the following rows are an order only: the table says so in its head.
    void invent_times();
    /// The values of the following rows depend on this part of the setup ("chain", "target S1"):
    /// the table says in its head what it was.
    void declare(const std::string& part);
    /// Another program run in the same file: its clock may restart.
    void begin_run() { begins_ = true; }
    /// `row.time_s` is the time in the file; throws InputError when it decreases within a session.
    /// `line`: in the file, 0 for a generated row; `more`: text in the added column.
    void add(records::Reading row, int line, const std::string& more = "");
    int count() const { return index_; }
    const std::string& session() const { return last_session_; }  ///< of the last row
    std::string take() { return std::move(text_); }

  private:
    const setup::Setup& setup_;
    std::set<std::string> declared_;
    records::ReadingTable head_;
    records::ReadingWriter writer_;
    std::string text_, path_, name_, session_, last_session_, instrument_;
    std::map<std::string, std::string> sessions_;  ///< of files, with `session=each`
    int index_ = 0;
    std::string session_of(const std::string& path);
    std::string instrument_of(const Facts& facts) const;
    std::string day_of_row(double time_s);

    bool begins_ = false, dated_ = false, has_column_ = false;
    std::string day_;  ///< session of the day
    double day_s_ = 0.0;
    double shift_s_ = 0.0, last_s_ = 0.0;
    double last_file_s_ = 0.0;  ///< the same by the clock of the file
    AxisPositions last_at_;
};

}  // namespace trunnion::imports
