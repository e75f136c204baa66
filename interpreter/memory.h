// The variables owned by the language: local variables by level, and common variables.
#pragma once

#include <array>
#include <vector>

#include "interpreter/variables.h"

namespace trunnion::interpreter {

constexpr int local_count = 33;
constexpr int common_count = 1100;

/// Index of a common variable in the store (#100-#199, #500-#999, #98000-#98499), or -1.
constexpr int common_slot(int number, bool has_98000) {
    if (number >= 100 && number <= 199) return number - 100;
    if (number >= 500 && number <= 999) return number - 400;
    if (has_98000 && number >= 98000 && number <= 98499) return number - 97400;
    return -1;
}
constexpr int common_number(int slot) {
    return slot < 100 ? slot + 100 : slot < 600 ? slot + 400 : slot + 97400;
}

/// #1-#33 of one level; [0] is not used.
using Locals = std::array<double, local_count + 1>;

class Memory {
  public:
    Memory(SystemVariables& system, bool has_98000);

    double get(int number) const;
    /// `comment` is passed on to the system variables (#3000 = 1(TEXT)).
    void set(int number, double value, const char* comment = "");

    Locals* locals = nullptr;  ///< of the current level
    std::array<double, common_count> common;
    SystemVariables& system;
    bool has_98000;
};

}  // namespace trunnion::interpreter
