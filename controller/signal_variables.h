// Variables of machine signals and clocks: #1000-#1135, #3000-#3012.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "controller/mover.h"

namespace trunnion::controller {

using Signals = std::map<int, double>;

/// #1000-#1031 single inputs, #1032-#1035 words; #1100.. outputs. Empty for any other number.
std::optional<double> signal_variable(int number, const Signals& signals);
/// Outputs only; false for any other number.
bool set_signal_variable(int number, double value, Signals& signals);

/// #3000 alarm, #3001 timer (ms), #3002 hours, #3003, #3004, #3007 controls, #3006 stop with a
/// message, #3011 date, #3012 time, #3901 and #3902 parts made and required (stored, not counted).
class ClockVariables {
  public:
    /// `clock_s`: start of the run, seconds since 1970.
    explicit ClockVariables(std::int64_t clock_s) : clock_s_(clock_s) {}

    std::optional<double> get(int number, double run_time_s) const;
    /// False when the number is not writable. #3000 throws the program's alarm with `comment`.
    bool set(int number, double value, std::string_view comment, Mover& mover);

  private:
    std::int64_t clock_s_;
    double offset_ms_ = 0.0, offset_h_ = 0.0;  ///< #3001 = value, #3002 = value
    std::array<double, 8> controls_{};         ///< [n] = #3000+n
    std::array<double, 2> parts_{};            ///< #3901, #3902
};

}  // namespace trunnion::controller
