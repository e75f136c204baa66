// The files that a Fanuc control writes to a USB stick: read, apply to the stores, write back.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_files.h"
#include "offsets/stores.h"

namespace trunnion::backup {

/// The text files of one backup by name (upper case, e.g. "CNC-PARA.TXT"), bytes as read. An
/// unchanged file is written back byte for byte, whatever its line ends (LF, CRLF, LF CR CR).
struct ControlBackup {
    std::string folder;
    std::map<std::string, std::string> files = {};
    std::map<std::string, std::string> names = {};  ///< upper case -> as on disk
};

/// How the emulator treats a file or a parameter of a backup.
enum class Standing : unsigned char { obeyed, known, ignored };
const char* text_of(Standing standing);

/// Names of the files with values, parameters first.
extern const std::vector<std::string> backup_file_names;

/// Reads the files of a folder written by a control, values and programs. Throws InputError when
/// none of them has values.
ControlBackup read_backup(const std::string& folder);
/// Adds these files to `files`, and copies of every other file of the folder that they come from.
void add_backup_files(const ControlBackup& backup, const std::string& folder, OutputFiles& files);

constexpr int other_path = 1000;

/// One value of a backup with its usual name: "19700", "1320 axis 1", "G54 X", "H1 geometry",
/// "#500". `line` from 1 in its file; `begin`, `size` delimit the text of the value.
struct BackupValue {
    std::string file;
    std::string name;
    std::string text;
    int line = 0;
    std::size_t begin = 0, size = 0;

    enum class Kind : unsigned char { parameter, work_offset, tool_offset, variable };
    Kind kind = Kind::parameter;
    int number =
        0;  ///< parameter, variable or tool number; work offset: 0 EXT, 1-6, 100 + P of G54.1
    /// Axis number; index of a further path, spindle or group times `other_path`; letter of the
    /// axis; or 10..13 of G10 L.
    int sub = 0;
    bool inch = false;      ///< inch in the file, mm in the stores
    bool assigned = false;  ///< "#500=1.5", where a vacant variable is "#0"
    bool for_axis = false;  ///< item A of a parameter: `sub` is an axis number
};

/// Every value, file by file, in file order. Throws InputError (path, line, column) for a line
/// whose form is not described in docs/backup_files.md.
std::vector<BackupValue> list_values(const ControlBackup& backup);

/// Writes the values to the stores. Throws InputError when 19680 names a mechanical type without a
/// pivot (19700-19702 absent for tables).
void apply_backup(const ControlBackup& backup, offsets::Stores& stores);
/// Rewrites, in the form of the file, those values that differ from the stores. Returns how many of
/// each file.
std::map<std::string, int> update_backup(ControlBackup& backup, const offsets::Stores& stores);

}  // namespace trunnion::backup
