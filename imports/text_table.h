// A text file of any dialect as a table: separator, decimal mark, names and units of the columns.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/table_line.h"

namespace trunnion::imports {

/// One column of the header line. "Pos X [mm]" has the name "Pos X" and the unit "mm".
struct TextColumn {
    std::string name, unit;  ///< unit: as written, empty where the file tells none
    int column = 1;          ///< where the name stands, from 1
};

/// Rows are split when they are asked for: a log of a million rows stays a text.
class TextTable {
  public:
    /// Finds out how the text is written: byte order mark, line ends, separator (tab ; , or
    /// blanks), decimal comma, a row of units below the names. Throws InputError (place) for a text
    /// without a table, a comma that may be a separator and a decimal mark at once, quotes that are
    /// not closed. The text must outlive the table.
    TextTable(std::string_view text, std::string path);

    const std::string& path() const { return path_; }
    const std::vector<TextColumn>& columns() const { return columns_; }
    const std::map<std::string, std::string>& head() const { return head_; }  ///< `Feed: 1000` ..
    char separator() const { return separator_; }
    /// "; between the columns, decimal comma"
    std::string dialect_words() const;

    std::size_t size() const { return rows_.size(); }
    /// Cells of row `i`; throws InputError when it has not as many as the header.
    void read(std::size_t i, std::vector<records::TableCell>& cells) const;
    records::TableLine line(std::size_t i) const { return {rows_[i].text, rows_[i].number, path_}; }
    records::TableLine header_line() const { return {header_.text, header_.number, path_}; }
    /// The cell as a number, decimal comma understood. Throws InputError with its place.
    double number(std::size_t i, const records::TableCell& cell, std::string_view what) const;
    std::optional<double> find_number(std::string_view text) const;
    [[noreturn]] void fail(std::size_t i, std::size_t column, const std::string& message) const;

  private:
    struct Row {
        std::string_view text;
        int number = 0;
    };
    bool numbers_in(const Row& row) const;
    void take_lines(std::string_view text);
    void choose_dialect();
    std::size_t find_header() const;
    void read_header(std::size_t at);
    void read_units();
    void read_head(std::size_t count);

    std::string path_;
    std::vector<TextColumn> columns_;
    std::map<std::string, std::string> head_;
    std::vector<Row> rows_;
    Row header_;
    char separator_ = ',';
    bool decimal_comma_ = false;
};

}  // namespace trunnion::imports
