// A text file of any dialect as tables: separator, decimal mark, names and units of the columns.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imports/cells.h"
#include "imports/column_names.h"

namespace trunnion::imports {

/// Rows are split on demand: a log of a million rows remains a text.
class TextTable {
  public:
    /// One line of the file.
    struct Line {
        std::string_view text;
        int number = 0;
    };
    /// What a line above the table says behind its key, and where.
    struct HeadEntry {
        std::string value;
        Line line;
    };
    using Head = std::map<std::string, HeadEntry>;

    /// The first table at or after lines[begin]; it ends before a text line that is not one of its
    /// rows. `told`: comma-separated column names if no line has them. Throws InputError (with
    /// position) for lines without a table and for unclosed quotes. After the first table there may
    /// be none; it then has no rows.
    TextTable(const std::vector<Line>& lines, std::size_t begin, std::string path, Dialect dialect,
              const std::string& told = "");

    const std::string& path() const { return path_; }
    const std::vector<TextColumn>& columns() const { return columns_; }
    const Head& head() const { return head_; }  ///< `Feed: 1000` ..
    /// What the lines above an earlier table of the file said; not the direction of a heading whose
    /// section ended.
    void inherit(const Head& above, const std::vector<Line>& lines);
    /// True if a line between the table before and this one says it.
    bool says_itself(const std::string& key) const;
    const Dialect& dialect() const { return dialect_; }
    /// "; between the columns, decimal comma"
    std::string dialect_words() const;

    /// The headings above the table, the nearest first: "### Data", "## Results".
    const std::vector<Line>& headings() const { return headings_; }

    std::size_t size() const { return rows_.size(); }
    std::size_t end() const { return end_; }  ///< index of the first line after the table
    /// Cells of row `i`; throws InputError when their number differs from the header.
    void read(std::size_t i, std::vector<records::TableCell>& cells) const;
    records::TableLine line(std::size_t i) const { return whole(rows_[i]); }
    records::TableLine header_line() const { return whole(header_); }
    records::TableLine head_line(const HeadEntry& entry) const { return whole(entry.line); }
    /// The cell as a number, with decimal comma if the file uses it. Throws InputError with its
    /// position.
    double number(std::size_t i, const records::TableCell& cell, std::string_view what) const;
    std::optional<double> find_number(std::string_view text) const {
        return dialect_.find_number(text);
    }
    bool has_numbers(std::size_t column) const;
    [[noreturn]] void fail(std::size_t i, std::size_t column, const std::string& message) const;

  private:
    records::TableLine whole(const Line& line) const { return {line.text, line.number, path_}; }
    std::vector<records::TableCell> cells(const Line& line) const {
        return cells_of(whole(line), dialect_.separator);
    }
    std::vector<records::TableCell> header_cells(const Line& line, std::size_t width) const;
    std::size_t rows_behind(const std::vector<Line>& lines, std::size_t header) const;
    std::size_t find_header(const std::vector<Line>& lines, std::size_t begin) const;
    std::size_t widest(const std::vector<Line>& lines) const;
    bool is_units(const Line& line) const;
    std::size_t first_told_row(const std::vector<Line>& lines, std::size_t begin,
                               const std::string& told);
    bool leads_to_header(const std::vector<Line>& lines, std::size_t at) const;
    bool row_follows(const std::vector<Line>& lines, std::size_t at) const;
    std::size_t read_header(const std::vector<Line>& lines, std::size_t begin, std::size_t at);
    void read_head(const std::vector<Line>& lines, std::size_t begin, std::size_t end);
    void take_rows(const std::vector<Line>& lines, std::size_t begin);
    void take_units(const std::vector<records::TableCell>& names);
    void take_units_of_first_row();
    bool fits(const std::vector<records::TableCell>& row) const;

    std::string path_;
    Dialect dialect_;
    std::vector<TextColumn> columns_;
    Head head_;
    std::vector<Line> headings_;
    std::vector<Line> rows_;
    Line header_;
    int first_line_ = 0;  ///< number of the first line of its head
    std::size_t end_ = 0;
};

}  // namespace trunnion::imports
