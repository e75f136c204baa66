// System variables (#1000 and above) of the control: read and write of stores, positions, modal
// state.
#pragma once

#include "controller/control_state.h"
#include "interpreter/variables.h"

namespace trunnion {

/// Present position in the work frame, mm and deg: #5041... Includes the tool length when the
/// configuration says so (default; facts/control.md 2.8, assumed).
ControlPosition work_position(const ControlState& c);

class ControlVariables : public SystemVariables {
  public:
    explicit ControlVariables(ControlState& control) : c_(control) {}

    double get(int number) override;
    void set(int number, double value, const char* comment) override;
    double parameter(int number, int bit, int axis) override;

  private:
    ControlState& c_;
};

}  // namespace trunnion
