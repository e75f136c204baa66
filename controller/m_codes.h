// M codes: their effect in the control, and whether they act before or after the motion.
#pragma once

#include "controller/control_config.h"
#include "controller/mover.h"

namespace trunnion::controller {

/// An M code known to the control.
struct MCode {
    int code;
    bool after_motion;
    const char* text;
};

/// True when the control, its dialect, a clamp or the builder's profile has this M code; M98, M99
/// and M198 belong to the language.
bool knows_m(int code, const ControlConfig& config);

class MCodes {
  public:
    explicit MCodes(const ControlConfig& config);

    /// Executes the M codes of the block that act before its motion (M3 M4 M6 M8, releases), or
    /// after it (M0 M1 M2 M5 M9 M30 and clamps).
    void run(bool after_motion, SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
    /// M2 or M30 was executed.
    bool ended() const { return ended_; }
    void start_run() { ended_ = false; }

  private:
    bool acts_after(int code, interpreter::DialectFamily family) const;
    const ClampCode* clamp_of(int code) const;
    void carry_out(int code, const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
    void change_state(int code, Modal& modal, Mover& mover);

    std::vector<ClampCode> clamps_;
    BuilderProfile builder_;
    bool optional_stop_;
    bool ended_ = false;
};

}  // namespace trunnion::controller
