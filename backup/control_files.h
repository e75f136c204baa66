// The files a Fanuc control writes to a USB stick: read, apply to the stores, write back.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "offsets/stores.h"

namespace trunnion::backup {

/// The text files of one backup by name (upper case, e.g. "CNC-PARA.TXT"), bytes as read. A file
/// that is not changed is written back byte for byte, whatever its line ends (LF, CRLF, LF CR CR).
struct ControlBackup {
    std::string folder;
    std::map<std::string, std::string> files;
};

/// Names that are read: parameters, work offsets, tool offsets, macro variables.
extern const std::vector<std::string> backup_file_names;

/// Reads the known files of a folder. Throws InputError when there is none of them.
ControlBackup read_backup(const std::string& folder);
void write_backup(const ControlBackup& backup, const std::string& folder);

/// One value of a backup, named as a user would: "19700", "1320 axis 1", "G54 X", "H1 geometry",
/// "#500". `line` from 1 in its file; `begin`, `size` delimit the value's text.
struct BackupValue {
    std::string file;
    std::string name;
    std::string text;
    int line = 0;
    std::size_t begin = 0, size = 0;

    enum class Kind : unsigned char { parameter, work_offset, tool_offset, variable };
    Kind kind = Kind::parameter;
    int number =
        0;        ///< parameter, variable or tool number; work offset: 0 EXT, 1-6, 100 + P of G54.1
    int sub = 0;  ///< axis number, letter of the axis, or 10..13 of G10 L
    bool inch = false;  ///< an 'I' value: inches in the file, mm in the stores
};

/// Every value, file by file, in file order. Throws InputError (path, line, column) for a line of
/// another form than docs/backup_files.md describes.
std::vector<BackupValue> list_values(const ControlBackup& backup);

/// Puts the values into the stores. Throws InputError when 19680 names a mechanical type without a
/// pivot (19700-19702 absent for tables).
void apply_backup(const ControlBackup& backup, offsets::Stores& stores);
/// Rewrites, in the files' own form, those values that differ from the stores.
void update_backup(ControlBackup& backup, const offsets::Stores& stores);

struct BackupDifference {
    std::string file, name, a, b;  ///< a or b empty: only in the other
};
std::vector<BackupDifference> diff_backups(const ControlBackup& a, const ControlBackup& b);

}  // namespace trunnion::backup
