// Programs of a backup, and where two versions of one differ.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backup/control_files.h"

namespace trunnion::backup {

/// One line that is not blank. Lines are compared by `key`, the text without blanks.
struct ProgramLine {
    std::string text, key;
    bool operator==(const ProgramLine& other) const { return key == other.key; }
};
std::vector<ProgramLine> lines_of(std::string_view text);

/// File, and O number or name behind its folder.
using ProgramKey = std::pair<std::string, std::string>;
/// Programs of ALL-PROG.TXT and ALL-FLDR.TXT; without a name, the lines in front of the first.
std::map<ProgramKey, std::vector<ProgramLine>> programs_of(const ControlBackup& backup);

/// "2 lines out, 1 in; first at line 3: G1X2. | G1X3."; lines that only moved count as out and in.
std::string line_difference(const std::vector<ProgramLine>& a, const std::vector<ProgramLine>& b);

}  // namespace trunnion::backup
