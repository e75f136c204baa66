// M codes that mean something else on a control of another family: one row a difference.
#pragma once

#include <span>

#include "controller/control_state.h"

namespace trunnion {

struct DialectCode {
    DialectFamily family;
    int m_code;
    void (*handler)(ControlState& c);
    const char* text;
    const char* source;
};

std::span<const DialectCode> dialect_codes();
/// The row of an M code in the dialect in force, or nullptr.
const DialectCode* find_dialect_code(const ControlState& c, int m_code);

}  // namespace trunnion
