// Executes the language: control flow, macro calls, variables, expressions. Independent of the
// machine.
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

/// G, M and T codes that call programs (parameters 6050-6089 and 6001#5, docs/backup_files.md).
struct CodeCalls {
    struct Call {
        int program = 0;
        bool with_arguments = true;  ///< true: like G65; false: like M98
        bool modal = false;          ///< like G66
    };
    std::map<int, Call> g;  ///< key: G code * 10 (G43.4 is 434)
    std::map<int, Call> m;
    bool t_calls_9000 = false;
};

struct InterpreterOptions {
    Dialect dialect;
    CodeCalls calls;
    std::vector<bool> skip_switches = std::vector<bool>(10, false);  ///< [1] is also the switch of
                                                                     ///< '/'
    int increment_digits = 3;         ///< least input increment 1e-3 (IS-B), for ROUND in a word
    bool asin_0_to_minus_90 = false;  ///< parameter 6004#0 = 1: ASIN -90..90, ATAN[a]/[b]
                                      ///< -180..180; 0: 270..90 and 0..360
    std::uint64_t max_blocks = 0;     ///< 0: no limit; otherwise the run stops with `limit`. Lines
                                      ///< without a block count a fraction, see runner.cpp
    /// Called every few thousand lines with the number of blocks; when it returns false the run
    /// stops with `limit`.
    std::function<bool(std::uint64_t blocks)> go_on;
    bool whole_arguments_as_written = true;  ///< parameter 3401#0 = 1: G65 A10 passes 10.; 0: ten
                                             ///< least increments
    bool print_suppresses_blanks = false;    ///< parameter 6001#1 (PRT)
    bool main_m99_ends = true;  ///< M99 in the main program: true ends the program, false repeats
                                ///< it for ever
};

/// How the main program ended.
enum class MainEnd : unsigned char {
    other,       ///< by M02, M30, an alarm or a limit
    returned,    ///< M99: a control starts it again
    out_of_text  ///< neither M02, M30 nor M99
};

/// One program run, block by block.
///
///     Interpreter nc(source, options, system, print);
///     nc.open(text);                     // or nc.open(o_number)
///     while (const BlockWords* words = nc.next()) control.execute(*words);
///
/// `next` executes the control flow (GOTO, WHILE, IF, G65-G67, M98, M99, M198, mapped codes,
/// assignments, DPRNT) and returns only blocks with words for the control, or nullptr at the end of
/// the program. Errors are thrown as Alarm with position. The returned block is valid until the
/// next call.
class Interpreter {
  public:
    using Print = std::function<void(std::string_view)>;  ///< output of DPRNT and BPRNT

    Interpreter(ProgramSource& source, InterpreterOptions options, SystemVariables& system,
                Print print);
    ~Interpreter();
    Interpreter(Interpreter&&) noexcept;

    void open(const ProgramText& program);
    void open(int o_number);

    const BlockWords* next();

    /// To be called when the block just returned commanded motion: G66 calls follow it.
    void block_moved();
    /// To be called when M02 or M30 was executed: `next` then returns nullptr.
    void end_program();

    /// Local (#1-#33 of the current level) and common variables; vacant when never set.
    double variable(int number) const;
    void set_variable(int number, double value);
    /// Numbers of all common variables that are not vacant, ascending.
    std::vector<int> used_common_variables() const;

    /// Position and text of the current block.
    SourceRef where() const;
    std::string block_text() const;
    /// File name of the running program; the reference is valid as long as this interpreter.
    const std::string& program_name() const;
    /// O number of the running program (#4115) and current sequence number (#4114).
    int program_number() const;
    int sequence_number() const;
    std::uint64_t blocks_executed() const;
    /// Decimal places of the least input increment (G20 on IS-B: 4), for ROUND in a word.
    void set_increment_digits(int digits);
    bool limit_reached() const;
    MainEnd main_end() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trunnion::interpreter
