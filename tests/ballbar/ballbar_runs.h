// Runs of the ballbar's NC programs on the emulated control, for the tests of this room.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "ballbar/test/ballbar_procedure.h"
#include "interpreter/program_folders.h"
#include "emulator/run.h"

namespace trunnion::ballbar_test {

inline Setup load(const std::string& name) {
    std::vector<std::string> notes;
    return load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/" + name, notes);
}

inline Machine without_errors(Machine machine) {
    machine.errors = {};
    return machine;
}

/// A control that knows where the axes nominally are: bc_table.toml is wrong about it on purpose.
inline void tell_the_pivots(Setup& setup) {
    for (int number = 19700; number <= 19705; ++number) setup.stores.parameters.entry.erase(number);
    const std::string why =
        derive_pivot_parameters(without_errors(setup.machine), setup.stores.parameters);
    REQUIRE(why.empty());
}

inline RunLog run(const Setup& setup, const std::string& text, double trace_step_mm = 0.0) {
    const auto owner = std::make_shared<std::string>(text);
    const ProgramText program{"O8200.nc", *owner, owner};
    ProgramFolders folders({});
    folders.add_file(program);
    RunOptions options;
    options.trace = trace_step_mm > 0.0;
    options.trace_step_mm = trace_step_mm;
    return run_program(setup, folders, program, options);
}

inline void require_no_alarm(const RunLog& log) {
    if (const auto& alarm = log.result.alarm)
        FAIL(alarm->number << " " << alarm->text << " line " << alarm->where.line << " "
                           << alarm->block);
    for (const std::string& note : log.notes)
        CHECK(note.find("out of its range") == std::string::npos);
}

inline std::string test_program(const Setup& setup, bool inside = false) {
    return ballbar_program(without_errors(setup.machine), stated_program_data(setup, inside));
}

}  // namespace trunnion::ballbar_test
