// Runs of the ballbar's NC programs on the emulated control, for the tests of this room.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "ballbar/test/ballbar_procedure.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion::ballbar_test {

inline setup::Setup load(const std::string& name) {
    std::vector<std::string> notes;
    return setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/" + name, notes);
}

inline kinematics::Machine without_errors(kinematics::Machine machine) {
    machine.errors = {};
    return machine;
}

/// A control that knows where the axes nominally are: bc_table.toml is wrong about it on purpose.
inline void tell_the_pivots(setup::Setup& setup) {
    for (int number = 19700; number <= 19705; ++number) setup.stores.parameters.entry.erase(number);
    const std::string why =
        setup::derive_pivot_parameters(without_errors(setup.machine), setup.stores.parameters);
    REQUIRE(why.empty());
}

inline emulator::RunLog run(const setup::Setup& setup, const std::string& text,
                            double trace_step_mm = 0.0) {
    const auto owner = std::make_shared<std::string>(text);
    const interpreter::ProgramText program{"O8200.nc", *owner, owner};
    interpreter::ProgramFolders folders({});
    folders.add_file(program);
    emulator::RunOptions options;
    options.trace = trace_step_mm > 0.0;
    options.trace_step_mm = trace_step_mm;
    return emulator::run_program(setup, folders, program, options);
}

inline void require_no_alarm(const emulator::RunLog& log) {
    if (const auto& alarm = log.result.alarm)
        FAIL(alarm->number << " " << alarm->text << " line " << alarm->where.line << " "
                           << alarm->block);
    for (const std::string& note : log.notes)
        CHECK(note.find("out of its range") == std::string::npos);
}

inline std::string test_program(const setup::Setup& setup, bool inside = false) {
    return ballbar::test::ballbar_program(without_errors(setup.machine),
                                          ballbar::test::stated_program_data(setup, inside));
}

}  // namespace trunnion::ballbar_test
