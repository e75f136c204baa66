// Macro keywords; a control also accepts them shortened to two or more letters.
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
    else_,
    popen,
    pclos,
    dprnt,
    bprnt,
    setvn
};

/// The statement keyword at `p` (at least two of its letters), or none. Moves `p` past it.
Keyword read_keyword(const char*& p, const char* end);

/// The function at `p`; moves `p` past it. False when there is none. Never returns
/// `round_increment`.
bool read_function(const char*& p, const char* end, OpCode& function);

enum class Precedence : std::uint8_t { none, comparison, sum, product };

/// The operator (symbol or word) at `p`; moves `p` past it. Precedence::none when there is none.
Precedence read_operator(const char*& p, const char* end, OpCode& op);

/// Canonical spelling of an operator or function, or nullptr.
const char* spelling(OpCode code);
Precedence precedence(OpCode code);

}  // namespace trunnion::interpreter
