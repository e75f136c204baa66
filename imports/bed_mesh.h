// The height map of a printer's bed in its configuration ([bed_mesh default]) as a table of points.
#pragma once

#include <string>
#include <vector>

#include "imports/import.h"

namespace trunnion::imports {

/// A section [bed_mesh NAME] with points.
bool is_bed_mesh(std::string_view text);

/// Lines of a table: nominal x, y and z = 0, and the measured z. Each keeps the number of the line
/// of its point. Lines of saved values may be marked by #*#.
class BedMeshTable {
  public:
    /// Throws InputError (line) for rows or columns that are missing, and for limits that are not
    /// told.
    explicit BedMeshTable(const ImportFile& file);
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
