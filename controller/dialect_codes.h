// M codes that mean something else on a control of another family: one row a difference.
#pragma once

#include "controller/mover.h"
#include "interpreter/dialect.h"

namespace trunnion::controller {

struct DialectCode {
    interpreter::DialectFamily family;
    int m_code;
    void (*act)(Modal& modal, Frames& frames, Mover& mover);
    const char* text;
    const char* source;
};

/// The row of an M code in a dialect, or nullptr.
const DialectCode* find_dialect_code(interpreter::DialectFamily family, int m_code);

}  // namespace trunnion::controller
