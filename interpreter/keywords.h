// Macro words, which a control also takes shortened to two or more letters.
#pragma once

#include <cstdint>

#include "interpreter/code.h"

namespace trunnion::interpreter {

enum class Keyword : std::uint8_t {
    none,
    if_,
    while_,
    do_,
    end,
    go_to,
    then,
    popen,
    pclos,
    dprnt,
    bprnt,
    setvn
};

/// The statement word at `p` (at least two of its letters), or none. Moves `p` past it.
Keyword read_keyword(const char*& p, const char* end);

/// The function at `p`, moved past it; false when there is none. `round_increment` is never given.
bool read_function(const char*& p, const char* end, OpCode& function);

enum class Precedence : std::uint8_t { none, comparison, sum, product };

/// The operator at `p` (symbol or word), moved past it; Precedence::none when there is none.
Precedence read_operator(const char*& p, const char* end, OpCode& op);

/// Canonical spelling of an operator or function, or nullptr.
const char* spelling(OpCode code);
Precedence precedence(OpCode code);

}  // namespace trunnion::interpreter
