// Macro variables: the interface between the language and the owner of a number range.
#pragma once

#include <limits>

namespace trunnion::interpreter {

/// The value of a vacant variable (#0). Vacant is not 0 but a NaN; arithmetic never produces it,
/// because every NaN result raises an alarm.
constexpr double vacant = std::numeric_limits<double>::quiet_NaN();
constexpr bool is_vacant(double value) {
    return value != value;
}

/// System variables (#1000 and above, as far as the control has them). The language owns #1-#33 by
/// level, #100-#199, #500-#999 and #98000-#98499; all others are accessed here.
class SystemVariables {
  public:
    virtual ~SystemVariables() = default;
    /// Value of #number; throws Alarm(115 ILLEGAL VARIABLE NUMBER) when the control does not have
    /// it.
    virtual double get(int number) = 0;
    /// Assignment #number = value. #3000 = n throws the program's own alarm (text from `comment`,
    /// the comment of the block), #3006 = n a stop.
    virtual void set(int number, double value, const char* comment) = 0;
    /// PRM[number], PRM[number, bit], PRM[number]/[axis]: `bit` and `axis` are -1 when absent.
    virtual double parameter(int number, int bit, int axis) = 0;
};

}  // namespace trunnion::interpreter
