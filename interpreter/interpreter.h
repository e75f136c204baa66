// Runs the language: flow, macro calls, variables, expressions. Knows no machine.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "interpreter/block_words.h"
#include "interpreter/dialect.h"
#include "interpreter/program_source.h"
#include "interpreter/variables.h"

namespace trunnion::interpreter {

/// Codes that call programs by parameters 6050-6089 and 6001#5 (docs/backup_files.md).
struct CodeCalls {
    struct Call {
        int program = 0;
        bool with_arguments = true;  ///< G65-like; false: M98-like
        bool modal = false;          ///< G66-like
    };
    std::map<int, Call> g;  ///< key: G code * 10 (G43.4 is 434)
    std::map<int, Call> m;
    bool t_calls_9000 = false;
};

struct InterpreterOptions {
    Dialect dialect;
    CodeCalls calls;
    std::vector<bool> skip_switches = std::vector<bool>(10, false);  ///< [1] also serves '/'
    int increment_digits = 3;         ///< least input increment 1e-3 (IS-B): ROUND inside a word
    bool asin_0_to_minus_90 = false;  ///< parameter 6004#0 = 1: ASIN -90..90, ATAN[a]/[b]
                                      ///< -180..180; 0: 270..90 and 0..360
    std::uint64_t max_blocks = 0;     ///< 0: no limit; reached: stop with `limit`. Lines without a
                                      ///< block count a little, see runner.cpp
    /// Asked every few thousand lines with the number of blocks; false: stop with `limit`.
    std::function<bool(std::uint64_t blocks)> go_on;
    bool whole_arguments_as_written = true;  ///< parameter 3401#0 = 1: G65 A10 passes 10.; 0: ten
                                             ///< least increments
    bool print_suppresses_blanks = false;    ///< parameter 6001#1 (PRT)
    bool main_m99_ends = true;  ///< M99 in the main program: end here instead of running for ever
};

/// One program run, block by block.
///
///     Interpreter nc(source, options, system, print);
///     nc.open(text);                     // or nc.open(o_number)
///     while (const BlockWords* words = nc.next()) control.execute(*words);
///
/// `next` does all flow (GOTO, WHILE, IF, G65-G67, M98, M99, M198, mapped codes, assignments,
/// DPRNT) and returns only blocks that hold words for the control, or nullptr at the end of the
/// program. Faults are thrown as Alarm with place. The returned block is valid until the next call.
class Interpreter {
  public:
    using Print = std::function<void(std::string_view)>;  ///< what DPRNT and BPRNT put out

    Interpreter(ProgramSource& source, InterpreterOptions options, SystemVariables& system,
                Print print);
    ~Interpreter();
    Interpreter(Interpreter&&) noexcept;

    void open(const ProgramText& program);
    void open(int o_number);

    const BlockWords* next();

    /// The control tells that the block just returned commanded motion: G66 calls follow it.
    void block_moved();
    /// M02 or M30 was executed: `next` returns nullptr from now on.
    void end_program();

    /// Local (#1-#33 of the running level) and common variables; vacant when never set.
    double variable(int number) const;
    void set_variable(int number, double value);
    /// All numbers of common variables that are not vacant, rising.
    std::vector<int> used_common_variables() const;

    /// The place and text of the block that runs now.
    SourceRef where() const;
    std::string block_text() const;
    /// Name of the running program's file; the reference lasts as long as this interpreter.
    const std::string& program_name() const;
    /// O number of the running program (#4115), sequence number in force (#4114).
    int program_number() const;
    int sequence_number() const;
    std::uint64_t blocks_executed() const;
    /// Digits behind the point of the least input increment (G20 on IS-B: 4): ROUND inside a word.
    void set_increment_digits(int digits);
    bool limit_reached() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trunnion::interpreter
