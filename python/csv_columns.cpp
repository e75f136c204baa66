#include "python/csv_columns.h"

#include <algorithm>
#include <limits>

#include "base/numbers.h"
#include "records/table_line.h"

namespace trunnion::python {
namespace {

std::vector<records::TableCell> cells_of(std::string_view line) {
    std::vector<records::TableCell> cells;
    records::TableLine{line, 0, {}}.split(',', cells);
    return cells;
}

}  // namespace

void CsvColumns::name_columns(std::string_view line) {
    for (const records::TableCell& cell : cells_of(line)) {
        const std::string name = cell.plain();
        const bool words = std::find(words_.begin(), words_.end(), name) != words_.end();
        columns_.push_back({name, words, {}, {}});
    }
}

void CsvColumns::add_line(std::string_view line) {
    const std::vector<records::TableCell> cells = cells_of(line);
    for (std::size_t j = 0; j < columns_.size(); ++j) {
        CsvColumn& column = columns_[j];
        if (column.words)
            column.word.push_back(cells.at(j).plain());
        else
            column.number.push_back(
                parse_number(cells.at(j).text).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
}

void CsvColumns::add(std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = records::take_line(text);
        if (line.empty() || line.front() == '#') continue;
        if (columns_.empty())
            name_columns(line);
        else
            add_line(line);
    }
}

}  // namespace trunnion::python
