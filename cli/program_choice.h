// The program a command works on: a file, or an O number in the program folders.
#pragma once

#include <string>
#include <vector>

#include "interpreter/program_folders.h"
#include "emulator/run.h"

namespace trunnion {

/// Folders searched for programs: those given, the program's own, then what ships with the product.
struct ProgramAndFolders {
    ProgramChoice program;
    ProgramFolders folders;
};

/// `folders`, then the file's own, then what ships; the file itself before all of them.
ProgramFolders folders_of_file(const ProgramText& program, std::vector<std::string> folders);

/// Throws InputError when there is no such file and no such O number.
ProgramAndFolders open_program(const std::string& name, std::vector<std::string> folders);

}  // namespace trunnion
