// A CSV table that arrives in pieces, as columns of numbers and of words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trunnion::python {

/// One column: of numbers, or of words.
struct CsvColumn {
    std::string name;
    bool words = false;
    std::vector<double> number;     ///< NaN: an empty cell
    std::vector<std::string> word;  ///< of a column of words
};

/// The table in the format of run and predict: lines starting with # are skipped, the next line
/// names the columns.
class CsvColumns {
  public:
    /// Names of the columns that contain words in any case.
    explicit CsvColumns(std::vector<std::string> words) : words_(std::move(words)) {}
    /// Adds whole lines.
    void add(std::string_view text);
    const std::vector<CsvColumn>& columns() const { return columns_; }

  private:
    void add_line(std::string_view line);
    void name_columns(std::string_view line);

    std::vector<std::string> words_;
    std::vector<CsvColumn> columns_;
};

}  // namespace trunnion::python
