// Static findings on a program: what shows without running it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "interpreter/block_words.h"
#include "interpreter/dialect.h"
#include "interpreter/program_source.h"

namespace trunnion::check {

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

/// Carries out the words of blocks in order, as a run does.
class Trial {
  public:
    virtual ~Trial() = default;
    /// The alarm that stops the run here, or nothing.
    virtual std::optional<Alarm> run(const interpreter::BlockWords& block) = 0;
    /// The alarm of the words alone, whatever the program did before, or nothing.
    virtual std::optional<Alarm> read(const interpreter::BlockWords& block) = 0;
    /// The end of the program: what still waits goes out.
    virtual std::optional<Alarm> end() = 0;
};

struct CheckOptions {
    interpreter::Dialect dialect;
    /// Does the control have this G code (434 is G43.4)? Not checked when empty.
    std::function<bool(int code10)> knows_g;
    /// Is program O`number` known outside the file? Not checked when empty.
    std::function<bool(int o_number)> finds_program;
    /// Is the program `<name>` known outside the file? Not known when empty.
    std::function<bool(const std::string& name)> finds_named;
    /// Does this G or M code (434 is G43.4), or T with 0, call a program? Nothing does when empty.
    std::function<bool(char letter, int code10)> calls_program;
    /// "PS0007 ILLEGAL USE OF DECIMAL POINT". Only the number when empty.
    std::function<std::string(int alarm)> alarm_text;
    /// The alarm of reading or writing variable #number from #1000 on, 0: none. Not checked when
    /// empty.
    std::function<int(int number, bool writes)> variable_alarm;
    /// A control that carries out blocks one after another. Not checked when empty.
    std::function<std::unique_ptr<Trial>()> start_trial;
    bool arc_centres_are_places = false;  ///< BNC: I J K are no way from the start
    double arc_tolerance_mm = 0.02;  ///< radius at the arc's end against its start (parameter 3410)
};

/// All findings on one file, by line. Only what can be told for sure: computed values, positions
/// behind jumps and machine data are left to a run.
std::vector<Finding> check_program(const interpreter::ProgramText& program,
                                   const CheckOptions& options);

}  // namespace trunnion::check
