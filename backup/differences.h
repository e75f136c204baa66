// What differs between two backups: values by their names, programs by theirs.
#pragma once

#include "backup/control_files.h"

namespace trunnion::backup {

struct BackupDifference {
    std::string file, name, a, b;  ///< a or b empty: only in the other
    std::string meaning;           ///< of a parameter, where it is known; of a variable, by SETVN
};

/// Parameters by number and axis letter ("1320 X"), offsets, variables, programs by O number or
/// name. Programs are compared without blanks and line ends; `a` and `b` hold how many lines they
/// have.
std::vector<BackupDifference> diff_backups(const ControlBackup& a, const ControlBackup& b);

/// "1320 axis 1" as "1320 X", by 1020 of the backup that the values come from.
void name_axes(std::vector<BackupValue>& values);

}  // namespace trunnion::backup
