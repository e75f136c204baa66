// Static findings on a program: what shows without running it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "interpreter/dialect.h"
#include "interpreter/program_source.h"

namespace trunnion {

enum class Severity : unsigned char { error, warning };

struct Finding {
    std::string rule;  ///< one of check_rules()
    Severity severity = Severity::error;
    std::string path;
    int line = 0, column = 0;  ///< from 1
    std::string text;          ///< one line
    std::string remedy;
};

struct CheckRule {
    const char* name;
    const char* description;
};
const std::vector<CheckRule>& check_rules();

struct CheckOptions {
    Dialect dialect;
    /// Does the control have this G code (434 is G43.4)? Not checked when empty.
    std::function<bool(int code10)> knows_g;
    /// Is program O`number` known outside the file? Not checked when empty.
    std::function<bool(int o_number)> finds_program;
    /// Is the program `<name>` known outside the file? Not known when empty.
    std::function<bool(const std::string& name)> finds_named;
    double arc_tolerance_mm = 0.02;  ///< radius at the arc's end against its start (parameter 3410)
};

/// All findings on one file, by line. Only what can be told for sure: computed values, positions
/// behind jumps and machine data are left to a run.
std::vector<Finding> check_program(const ProgramText& program, const CheckOptions& options);

}  // namespace trunnion
