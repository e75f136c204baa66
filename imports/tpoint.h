// A pointing run of a telescope in azimuth and altitude, in the form of TPOINT: caption, options
// (: ALTAZ), a line about site and weather, lines of star and telescope, END; ! begins a comment.
#pragma once

#include <string>
#include <vector>

#include "imports/import.h"

namespace trunnion::imports {

/// True for a text whose first lines have an option of such a run.
bool is_tpoint(std::string_view text);

/// Lines of a table: angles that the telescope's encoders read as commanded, those of the star as
/// actual, in degrees, in the axes of the setup. Each keeps the number of its line.
class TpointTable {
  public:
    /// Throws InputError (line) for a mount of another kind, for a machine of other axes than two
    /// that carry the line of sight, and for a line without four numbers.
    TpointTable(const ImportFile& file, const setup::Setup& setup);
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
