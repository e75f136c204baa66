// Macro variables: the interface between the language and whoever owns a number range.
#pragma once

#include <limits>

namespace trunnion::interpreter {

/// The value of a vacant variable (#0). Vacant is not 0: it is a NaN that no arithmetic produces,
/// because every NaN result is an alarm.
constexpr double vacant = std::numeric_limits<double>::quiet_NaN();
constexpr bool is_vacant(double value) {
    return value != value;
}

/// System variables (#1000 and above, where the control has them). The language keeps #1-#33 by
/// level, #100-#199, #500-#999 and #98000-#98499 itself and asks this for the rest.
class SystemVariables {
  public:
    virtual ~SystemVariables() = default;
    /// Value of #number; throws Alarm(115 ILLEGAL VARIABLE NUMBER) when the control has no such
    /// one.
    virtual double get(int number) = 0;
    /// Assignment #number = value. #3000 = n throws the program's own alarm (text from `comment`,
    /// the comment in the same block), #3006 = n a stop.
    virtual void set(int number, double value, const char* comment) = 0;
    /// PRM[number], PRM[number, bit], PRM[number]/[axis]: `bit` and `axis` -1 when absent.
    virtual double parameter(int number, int bit, int axis) = 0;
};

}  // namespace trunnion::interpreter
