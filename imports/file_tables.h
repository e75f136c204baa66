// The tables of a file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "imports/text_table.h"

namespace trunnion::imports {

/// All tables of a file in order; head lines of a table also apply to the following ones. `told`:
/// as for TextTable. Throws InputError (with position) for a text without a table. The text must
/// outlive them. `notes` gets a line for text after the last table.
std::vector<TextTable> tables_of(std::string_view text, const std::string& path,
                                 const std::string& told, std::vector<std::string>& notes);
/// The same of lines that keep their numbers.
std::vector<TextTable> tables_of(const std::vector<TextTable::Line>& lines, const std::string& path,
                                 const std::string& told, std::vector<std::string>& notes);

/// Lines that an import makes of a file which is no table, each with the number of its line there.
class MadeTable {
  public:
    void add(std::string text, int number) { lines_.push_back({std::move(text), number}); }
    /// They refer to this value.
    std::vector<TextTable::Line> lines() const;

  private:
    struct OwnLine {
        std::string text;
        int number = 0;
    };
    std::vector<OwnLine> lines_;
};

}  // namespace trunnion::imports
