// Differences between two backups: values and programs by name.
#pragma once

#include "backup/control_files.h"

namespace trunnion::backup {

struct BackupDifference {
    std::string file, name, a, b;  ///< a or b empty: only in the other backup
    std::string meaning;           ///< of a parameter, if known; of a variable, by SETVN; of a
                                   ///< program or another file also where it differs
};

/// Parameters by number and axis letter ("1320 X"), offsets, variables and their names, programs by
/// O number or name, then the other files of both folders. Programs are compared without blanks and
/// line ends; `a` and `b` are their numbers of lines.
std::vector<BackupDifference> diff_backups(const ControlBackup& a, const ControlBackup& b);

/// Renames "1320 axis 1" to "1320 X", using 1020 of the backup that the values come from.
void name_axes(std::vector<BackupValue>& values);

}  // namespace trunnion::backup
