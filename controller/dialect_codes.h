// M codes whose meaning differs on a control of another family: one row a difference.
#pragma once

#include "controller/mover.h"
#include "interpreter/dialect.h"

namespace trunnion::controller {

struct DialectCode {
    int m_code;
    bool after_motion;
    /// nullptr: outputs and chip conveyor, passed on by the emulator.
    void (*act)(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
    const char* text;
    const char* source;
};

/// The row of an M code in a dialect, or nullptr.
const DialectCode* find_dialect_code(interpreter::DialectFamily family, int m_code);

}  // namespace trunnion::controller
