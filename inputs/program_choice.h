// The program a command or a script works on: a file, or an O number in the program folders.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion::inputs {

/// Folders searched for programs: those given, the program's own, then what ships with the product.
struct ProgramAndFolders {
    emulator::ProgramChoice program;
    interpreter::ProgramFolders folders;
};

/// `folders`, then the file's own, then what ships; the file itself before all of them.
interpreter::ProgramFolders folders_of_file(const interpreter::ProgramText& program,
                                            std::vector<std::string> folders);

/// Throws InputError when there is no such file and no such O number.
ProgramAndFolders open_program(const std::string& name, std::vector<std::string> folders);

}  // namespace trunnion::inputs
