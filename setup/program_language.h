// The language in which a generated program is written for a control.
#pragma once

#include "setup/setup.h"

namespace trunnion::setup {

/// `isnc` and `bnc` are the two dialects of a Hurco.
enum class ProgramLanguage : unsigned char { fanuc, isnc, bnc };

inline ProgramLanguage language_of(const Setup& setup) {
    if (setup.dialect.family != interpreter::DialectFamily::hurco) return ProgramLanguage::fanuc;
    return setup.hurco.bnc ? ProgramLanguage::bnc : ProgramLanguage::isnc;
}

inline bool is_hurco(ProgramLanguage language) {
    return language != ProgramLanguage::fanuc;
}

/// Millimetres, and in BNC arcs of several quadrants, which its posts ask for at the start.
inline const char* start_codes(ProgramLanguage language) {
    return language == ProgramLanguage::bnc ? "G71G75" : "G21";
}

}  // namespace trunnion::setup
