// Shipped machines with the programs that measure them: what ships, and what the diagnosis plans.
#pragma once

#include <catch2/catch.hpp>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "diagnosis/advice/measurements.h"
#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion::measured {

inline std::string source_folder() {
    return TRUNNION_SOURCE_DIR;
}

/// What runs: an O number of the program folders or a text.
struct Program {
    std::string name;
    emulator::ProgramChoice choice;
    std::vector<std::string> folders;
};

/// A shipped machine: its file in machines/, the shipped programs that measure it and their folder
/// in programs/.
struct Shipped {
    const char *file, *folder;
    std::vector<int> numbers;
};

inline const std::vector<Shipped>& shipped_machines() {
    static const std::vector<Shipped> list{
        {"bc_table.toml", "ballbar/bc", {8001, 8002, 8003, 8004, 8200, 8300}},
        {"ac_trunnion.toml", "ballbar", {8200, 8300}},
        {"head_table.toml", "", {}},
        {"head_head.toml", "", {}},
        {"mill_xy_table.toml", "", {}}};
    return list;
}

inline std::string file_text(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(source_folder() + "/" + path).rdbuf();
    return text.str();
}

/// The file of a shipped machine; the mill's with the target of the laser.
inline std::string setup_text(const Shipped& machine) {
    const std::string text = file_text(std::string("machines/") + machine.file);
    return machine.file == std::string("mill_xy_table.toml")
               ? text + "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
               : text;
}

inline setup::Setup setup_of(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "measured.toml", notes);
}

/// Shipped programs first, then those that the diagnosis would write for the machine; for one
/// without rotary axes a program of the tests.
inline std::vector<Program> programs_of(const Shipped& machine, const setup::Setup& setup) {
    const std::string shared = source_folder() + "/programs";
    std::vector<std::string> folders{shared, shared + "/pivot"};
    if (*machine.folder) folders.insert(folders.begin(), shared + "/" + machine.folder);
    std::vector<Program> list;
    for (const int number : machine.numbers)
        list.push_back({"O" + std::to_string(number), number, folders});
    const auto add = [&](const std::string& name, const std::string& text) {
        const auto owner = std::make_shared<std::string>(text);
        list.push_back({name, interpreter::ProgramText{name, *owner, owner}, {shared}});
    };
    for (const diagnosis::Measurement& planned : diagnosis::ready_measurements(setup, 0.0))
        add(planned.name, planned.program);
    if (list.empty()) add("mill.nc", file_text("tests/support/mill.nc"));
    return list;
}

/// Readings of a machine as `setup` has it, effects included.
inline records::ReadingTable run_of(const setup::Setup& setup, const Program& program,
                                    std::uint64_t seed = 1) {
    interpreter::ProgramFolders folders(program.folders);
    emulator::RunOptions options;
    options.seed = seed;
    options.effects = effects::active_models(setup);
    emulator::RunLog log = emulator::run_program(setup, folders, program.choice, options);
    INFO(program.name << ": " << (log.result.alarm ? log.result.alarm->text : ""));
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

}  // namespace trunnion::measured
