// G12.1 and G7.1: figures programmed on a plane that a rotary axis turns or rolls up.
#pragma once

#include <optional>

#include "controller/mover.h"

namespace trunnion::controller {

/// G12.1 in force: a linear axis is the radius, a rotary axis the angle. Program words: the linear
/// axis in mm, the rotary letter in mm too (the hypothetical axis).
struct PolarMotion {
    Axis linear = Axis::X, rotary = Axis::C;
    PlanePoint at;  ///< where the figure stands in their plane, mm
};
/// G7.1 in force: the rotary axis counts as a length of radius * angle.
struct CylinderMotion {
    Axis rotary = Axis::C;
    double radius_mm = 0.0;
};

class WrappedMotion {
  public:
    /// G12.1, G13.1: PS0145 under cutter compensation, G43.4, G54.2, G68.2 or without the axes.
    void set_polar(Modal& modal, const Frames& frames, int code10);
    /// G7.1 with a rotary word, its radius; 0 ends it. PS0175, PS0176.
    void set_cylinder(const SortedWords& words, const Modal& modal);

    bool polar() const { return polar_.has_value(); }
    bool cylinder() const { return cylinder_.has_value(); }

    /// PS0146 for rapids of the two axes.
    void move_polar(SortedWords& words, Modal& modal, const Frames& frames, Mover& mover);
    void move_cylinder_line(const SortedWords& words, Modal& modal, const Frames& frames,
                            Mover& mover);
    void move_cylinder_arc(const SortedWords& words, Modal& modal, const Frames& frames,
                           Mover& mover);

  private:
    std::optional<PolarMotion> polar_;
    std::optional<CylinderMotion> cylinder_;
};

}  // namespace trunnion::controller
