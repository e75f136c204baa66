// The program of a command or a script: a file, or an O number in the program folders.
#pragma once

#include <string>
#include <vector>

#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion::inputs {

/// Search folders of programs: the given ones, that of the program, then those shipped with the
/// product.
struct ProgramAndFolders {
    emulator::ProgramChoice program;
    interpreter::ProgramFolders folders;
};

/// `folders`, then the folder of the file `path`, then the shipped ones.
interpreter::ProgramFolders folders_beside(const std::string& path,
                                           std::vector<std::string> folders);
/// `folders`, then the file's own folder, then the shipped ones; the file itself has priority over
/// all of them.
interpreter::ProgramFolders folders_of_file(const interpreter::ProgramText& program,
                                            std::vector<std::string> folders);

/// Throws InputError when neither the file nor the O number exists.
ProgramAndFolders open_program(const std::string& name, std::vector<std::string> folders);

}  // namespace trunnion::inputs
