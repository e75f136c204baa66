// Readings of an import in the order taken: numbers them, keeps the clock, remembers their source.
#pragma once

#include <string>
#include <vector>

#include "imports/columns.h"
#include "imports/import.h"
#include "records/readings.h"

namespace trunnion::imports {

/// Rows go to text at once: a servo log of a million rows is never a table of readings.
class RowWriter {
  public:
    /// `columns`: optional columns that rows of this import fill (source and, where it is told,
    /// session are added).
    RowWriter(const setup::Setup& setup, const std::string& kind, std::vector<std::string> columns,
              bool directions, bool degrees);
    /// One more column behind the others, which readings do not know: the block of a program. To be
    /// called before the first row.
    void add_column(const std::string& name);

    /// Rows that follow come from this file. A clock that starts at zero again goes on a minute
    /// after the last row.
    void begin_file(const std::string& path, const Facts& facts);
    void begin_file(const TextTable& table, const Facts& facts) { begin_file(table.path(), facts); }
    /// Times of this file count from 1970: a pause of four hours begins a session, which is named
    /// after its day unless the file or `--with session=` names one.
    void name_days() { dated_ = true; }
    /// A further program in the same file: its clock may begin anew, as that of a file may.
    void begin_run() { begins_ = true; }
    /// `row.time_s` is the file's; throws InputError when it runs back within the session.
    /// `line`: of the file, 0 for a row that no line says; `more`: text in the added column.
    void add(records::Reading row, int line, const std::string& more = "");
    int count() const { return index_; }
    std::string take() { return std::move(text_); }

  private:
    records::ReadingTable head_;
    records::ReadingWriter writer_;
    std::string text_, path_, name_, session_, last_session_;
    int index_ = 0;
    std::string day_of_row(double time_s);

    bool begins_ = false, dated_ = false, has_column_ = false;
    std::string day_;  ///< session of the day
    double day_s_ = 0.0;
    double shift_s_ = 0.0, last_s_ = 0.0;
    double last_file_s_ = 0.0;  ///< the same by the file's clock
    AxisPositions last_at_;
};

}  // namespace trunnion::imports
