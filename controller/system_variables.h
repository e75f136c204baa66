// System variables (#1000 and above) of the control: access to stores, positions and modal state.
#pragma once

#include <map>

#include "controller/control.h"
#include "interpreter/variables.h"

namespace trunnion::controller {

class ControlVariables : public interpreter::SystemVariables {
  public:
    explicit ControlVariables(Control& control) : c_(control) {}

    double get(int number) override;
    void set(int number, double value, const char* comment) override;
    double parameter(int number, int bit, int axis) override;

    /// The program read the skip position (#5061..).
    bool reads_skip() const { return reads_skip_; }
    void start_run() { reads_skip_ = false; }

  private:
    std::optional<double> find(int number) const;
    bool is_free(int number) const;

    Control& c_;
    bool reads_skip_ = false;
    std::map<int, double> free_;  ///< #900000.. and those of the machine builder; initially vacant
};

}  // namespace trunnion::controller
