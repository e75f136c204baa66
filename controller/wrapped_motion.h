// G12.1 and G7.1: figures programmed in a plane that a rotary axis turns, or on a cylinder.
#pragma once

#include <optional>

#include "controller/mover.h"

namespace trunnion::controller {

/// Active G12.1: a linear axis is the radius, a rotary axis the angle. In program words both the
/// linear axis and the rotary letter (the hypothetical axis) are in mm.
struct PolarMotion {
    Axis linear = Axis::X, rotary = Axis::C;
    PlanePoint at;  ///< present point of the figure in the plane, mm
};
/// Active G7.1: the rotary axis counts as a length of radius * angle.
struct CylinderMotion {
    Axis rotary = Axis::C;
    double radius_mm = 0.0;
};

class WrappedMotion {
  public:
    /// G12.1, G13.1. PS0145 under cutter compensation, G43.4, G54.2, G68.2, or when the axes are
    /// missing.
    void set_polar(Modal& modal, const Frames& frames, int code10);
    /// G7.1 with a rotary word, which is the radius; 0 ends it. PS0175, PS0176.
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
