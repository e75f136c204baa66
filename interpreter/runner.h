// State of a program run: frames, positions, the cache of compiled blocks. Internal to the
// interpreter (runner_*.cpp).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "interpreter/arguments.h"
#include "interpreter/block_cache.h"
#include "interpreter/block_parser.h"
#include "interpreter/evaluate.h"
#include "interpreter/interpreter.h"
#include "interpreter/plain_block.h"
#include "interpreter/program_files.h"

namespace trunnion::interpreter {

/// The next block: its position, and its number in the cache if known.
struct Place {
    std::uint64_t byte = 0;
    int line = 0;  ///< 0: no position
    int block = -1;
};

/// A running program: the main program or a called one.
struct Frame {
    Section* section = nullptr;
    Locals* locals = nullptr;
    std::array<Place, 4> loops;        ///< [1..3]: the DO block of the active loop
    std::array<int, 4> behind_loop{};  ///< [1..3]: the line after its END
    Place start;                       ///< start of a repeat
    Place back;                        ///< return position in the caller
    int back_link = -1;
    int repeats = 1;  ///< repeats left, including this one
    int macro_depth = 0;
    int sub_depth = 0;
    int modal_limit = 0;  ///< modal calls [0, limit) apply to motion of this program
    bool macro = false;
    bool by_code = false;  ///< called by a G, M or T code: codes do not call programs in it
};

/// G66, G66.1
struct ModalCall {
    Section* section = nullptr;
    Locals locals;
    int repeats = 1;
    bool every_block = false;
};

/// Action that follows the block just returned.
struct Pending {
    enum class Kind : unsigned char { none, subprogram, give_back } kind = Kind::none;
    Section* named = nullptr;  ///< of M98<NAME>; otherwise looked up by number at the call
    int program = 0;
    int repeats = 1;
    int sequence_number = -1;
    bool by_code = false;
    bool outside = false;
};

struct Interpreter::State {
    State(ProgramSource& source, InterpreterOptions options, SystemVariables& system, Print print);

    void start(Section& section);
    const BlockWords* step();

    // runner.cpp: blocks in order
    bool first_reading(bool& give);
    bool resolve();
    void flush_cache();
    bool run(const Block& block, Code& code, int index);
    bool give_out(const Block& block, const Code& code);
    bool program_block(const Block& block, Code& code, int index);
    void end_of_section();
    bool limit_hit() { return lines + files.lines_searched() >= look_up_at && look_up_limits(); }
    bool look_up_limits();

    // runner_statements.cpp
    void statements(const Block& block, Code& code, int index);
    void assign(const Block& block, const Code& code, const Item& item);
    void go_to(const Block& block, Code& code, Item& item, bool cached);
    void leave_branch(const Block& block, Item& item, bool cached);
    void while_do(const Block& block, Item& item, int index);
    void end_loop(const Item& item);
    void jump(const TextPlace& place);
    int new_link(const TextPlace& place);
    void follow(int link);
    void print_line(const Code& code, const Item* item, const Item* last);
    void set_names(const Code& code, const Item& item);
    std::string comment_of(const Block& block, const Code& code) const;

    // runner_calls.cpp
    bool special_words(const Block& block, const Code& code, std::size_t first);
    void macro_call(std::size_t at, Section* named, bool modal, bool every_block);
    bool subprogram_words(std::size_t at, Section* named, bool outside);
    Section* take_name(const Block& block, const Code& code);
    bool return_words(std::size_t at);
    bool code_call(std::size_t at, const CodeCalls::Call& call);
    bool tool_call(std::size_t at);
    void cancel_modals();
    bool macro_file_value(const Block& block, const Code& code);
    bool call_every_block();
    void call_after_motion();
    void perform_pending();
    void call_subprogram(const Pending& call);
    void push(Section& section, int repeats, bool macro, bool by_code);
    void start_macro(Section& section, int repeats, bool by_code);
    void give_back(int sequence_number, int repeats);
    TextPlace target_of_return(const Frame& caller, int sequence_number);
    void repeat();
    Section& called(int number, bool outside, int column);
    double take(char letter, double otherwise);
    std::pair<double, double> take_program_and_repeats();
    void remove(std::size_t at);
    bool give_or(Pending call);
    ArgumentRules argument_rules() const;

    double value(const Code& code, const Item& item) const {
        return item.a.count == 0
                   ? item.value
                   : evaluate(code.ops.data() + item.a.first, item.a.count, memory, rules);
    }
    Frame& frame() { return frames.back(); }
    std::string_view text() const { return frames.back().section->file->text.text; }

    InterpreterOptions options;
    ProgramFiles files;
    Memory memory;
    Print print;
    EvaluationRules rules;
    ParseOptions parse;
    VariableNames names;
    SpecialCodes special;

    BlockCache cache;
    std::size_t cache_misses = 0;  ///< since it is full
    Code scratch;                  ///< blocks executed for the first time
    std::vector<Frame> frames;
    std::vector<Locals> levels;    ///< by macro depth
    std::vector<Locals> repeated;  ///< arguments of a macro call with L, by macro depth
    std::vector<ModalCall> modals;
    std::size_t modal_count = 0;

    BlockWords words;
    Place at;            ///< the next block
    int link_from = -1;  ///< cache link that leads to it and is still open
    Place current;       ///< the running block
    Pending pending;
    bool moved = false;
    bool ended = true;
    bool limit = false;
    MainEnd main_end = MainEnd::other;
    std::uint64_t executed = 0;
    std::uint64_t lines = 0;       ///< lines executed, including empty ones
    std::uint64_t look_up_at = 0;  ///< number of lines at which limits are checked next
    int sequence_number = 0;
};

}  // namespace trunnion::interpreter
