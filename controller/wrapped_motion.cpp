#include "controller/wrapped_motion.h"

#include <cmath>

#include "controller/arcs.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

PlanePoint point_on(const PlaneElement& e, double s) {
    if (!e.arc) return e.start + s * (e.end - e.start);
    const PlanePoint r = e.start - e.centre;
    const double turn = s * e.sweep_rad;
    return e.centre + std::cos(turn) * r + std::sin(turn) * left_of(r);
}

double way_of(const PlaneElement& e) {
    return e.arc ? e.radius() * std::abs(e.sweep_rad) : length_of(e.end - e.start);
}

/// Axes of a figure in a plane that one axis pair maps in its own way; the others run evenly.
class FigureCurve : public PathCurve {
  public:
    FigureCurve(const PlaneElement& figure, const AxisPositions& from, const AxisPositions& to)
        : figure_(figure), from_(from), to_(to) {}

  protected:
    AxisPositions others_at(double s) const {
        AxisPositions out;
        for (std::size_t i = 0; i < axis_count; ++i)
            out.value[i] = from_.value[i] + s * (to_.value[i] - from_.value[i]);
        return out;
    }
    PlaneElement figure_;
    AxisPositions from_, to_;
};

/// Radius axis and rotary axis follow a figure in the turning plane.
class PolarCurve : public FigureCurve {
  public:
    PolarCurve(const PlaneElement& figure, const AxisPositions& from, const AxisPositions& to,
               const PolarMotion& axes)
        : FigureCurve(figure, from, to), axes_(axes) {}

    AxisPositions at(double s) const override {
        AxisPositions out = others_at(s);
        out[axes_.linear] =
            from_[axes_.linear] + length_of(point_on(figure_, s)) - length_of(figure_.start);
        out[axes_.rotary] = from_[axes_.rotary] + turned(s);
        return out;
    }
    /// Angle passed about the pole up to s: in steps, so that a figure round the pole counts.
    double turned(double s) const {
        constexpr int steps = 64;
        double angle = 0.0;
        PlanePoint before = figure_.start;
        const int whole = static_cast<int>(std::ceil(s * steps));
        for (int i = 1; i <= whole; ++i) {
            const PlanePoint p = point_on(figure_, std::min(s, static_cast<double>(i) / steps));
            angle += std::atan2(cross(before, p), dot(before, p));
            before = p;
        }
        return angle;
    }

  private:
    PolarMotion axes_;
};

/// One linear axis and the rotary axis (radius * angle) follow a figure on the unrolled cylinder.
class CylinderCurve : public FigureCurve {
  public:
    CylinderCurve(const PlaneElement& figure, const AxisPositions& from, const AxisPositions& to,
                  Axis first, Axis second, double radius_mm)
        : FigureCurve(figure, from, to), first_(first), second_(second), radius_mm_(radius_mm) {}

    AxisPositions at(double s) const override {
        AxisPositions out = others_at(s);
        const PlanePoint p = point_on(figure_, s);
        out[first_] = from_[first_] + (p.x - figure_.start.x) / scale(first_);
        out[second_] = from_[second_] + (p.y - figure_.start.y) / scale(second_);
        return out;
    }

  private:
    double scale(Axis axis) const { return is_rotary(axis) ? radius_mm_ : 1.0; }
    Axis first_, second_;
    double radius_mm_;
};

/// The figure of this block between two points of a plane whose centre words are given.
PlaneElement figure_of(const ControlState& c, PlanePoint start, PlanePoint end, char first_centre,
                       char second_centre) {
    PlaneElement e;
    e.start = e.centre = start;
    e.end = end;
    const int code = c.modal[ModalGroup::motion];
    e.arc = code == 20 || code == 30;
    if (!e.arc) return e;
    if (c.words.has('R')) {
        e.centre = centre_from_radius(start, end, c.length_word('R'), code == 20,
                                      c.settings.arc_tolerance_mm);
    } else {
        if (c.words.has(first_centre)) e.centre.x += c.length_word(first_centre);
        if (c.words.has(second_centre)) e.centre.y += c.length_word(second_centre);
        check_radii(e.centre, start, end, c.settings.arc_tolerance_mm);
    }
    e.sweep_rad = sweep_of(e.centre, start, end, code == 20);
    return e;
}

std::optional<Axis> first_rotary(const ControlState& c) {
    for (const ControlAxis& axis : c.config.axes)
        if (axis.rotary && c.words.has(letter_of(axis.axis))) return axis.axis;
    return std::nullopt;
}

/// G12.1 X C: Y belongs to no figure, C turns about Z (5460, 5461; absent: X and C).
Axis axis_by_parameter(const ControlState& c, int number, Axis otherwise) {
    const int n = static_cast<int>(c.stores.parameters.get(number));
    if (n < 1 || n > static_cast<int>(c.config.axes.size())) return otherwise;
    return c.config.axes[static_cast<std::size_t>(n - 1)].axis;
}

}  // namespace

void g_polar_motion(ControlState& c, const GCode& code) {
    const bool on = code.code10 == 121;
    if (!c.modal.is(ModalGroup::cutter, 400) || c.five_axis.active) raise_alarm(145);
    c.modal.set(ModalGroup::polar_motion, code.code10);
    c.polar.reset();
    if (!on) return;
    PolarMotion polar;
    polar.linear = axis_by_parameter(c, 5460, Axis::X);
    polar.rotary = axis_by_parameter(c, 5461, Axis::C);
    if (!c.has_axis(polar.linear) || !c.has_axis(polar.rotary)) raise_alarm(145);
    polar.x_mm = c.program[polar.linear];  // the rotary axis stands at its zero of the figure
    c.polar = polar;
}

void move_polar(ControlState& c) {
    PolarMotion& polar = *c.polar;
    const int code = c.modal[ModalGroup::motion];
    if (code == 0 && (c.words.has(letter_of(polar.linear)) || c.words.has(letter_of(polar.rotary))))
        raise_alarm(146);
    const char x_word = letter_of(polar.linear), y_word = letter_of(polar.rotary);
    PlanePoint end{polar.x_mm, polar.y_mm};
    const auto read = [&](char letter, double& value) {
        if (c.words.has(letter)) value = (c.absolute() ? 0.0 : value) + c.length_word(letter);
    };
    read(x_word, end.x);
    read(y_word, end.y);
    c.words.present &= ~(SortedWords::bit(x_word) | SortedWords::bit(y_word));
    ControlPosition target = c.target();
    const PlaneElement figure = figure_of(c, {polar.x_mm, polar.y_mm}, end, 'I', 'J');
    const AxisPositions from = c.move.from;
    const double turned = PolarCurve(figure, from, from, polar).turned(1.0);
    target[polar.linear] += length_of(figure.end) - length_of(figure.start);
    target[polar.rotary] += deg_from_rad(turned);
    const ControlPosition machine = c.coordinates.machine_from_program(target);
    const PolarCurve curve(figure, from, axis_positions_of(machine), polar);
    if (figure.arc || figure.moves())
        move_curve(c,
                   code == 30   ? MotionKind::arc_ccw
                   : code == 20 ? MotionKind::arc_cw
                                : MotionKind::linear,
                   target, machine, curve, way_of(figure));
    else
        move_line(c, code == 0 ? MotionKind::rapid : MotionKind::linear, target);
    polar.x_mm = end.x;
    polar.y_mm = end.y;
}

void g_cylinder(ControlState& c, const GCode&) {
    const auto axis = first_rotary(c);
    if (!axis) raise_alarm(175);
    const double radius = c.words.get(letter_of(*axis)) *
                          (c.words.is_bare(letter_of(*axis)) ? c.bare_linear : c.unit_mm);
    if (radius < 0.0) raise_alarm(175);
    if (!c.modal.is(ModalGroup::cutter, 400)) raise_alarm(176);
    c.cylinder.reset();
    if (radius > 0.0) c.cylinder = CylinderMotion{*axis, radius};
}

/// F is the speed on the cylinder: a rotary axis counts its way at the radius.
void move_cylinder_line(ControlState& c) {
    const CylinderMotion& cylinder = *c.cylinder;
    const ControlPosition target = c.target();
    const ControlPosition machine = c.coordinates.machine_from_program(target);
    double square = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const bool wound = all_axes[i] == cylinder.rotary;
        const double d = machine.value[i] - c.machine.value[i];
        square += std::pow(wound ? rad_from_deg(d) * cylinder.radius_mm : d, 2);
    }
    CurveMove way;
    way.length_mm = way.feed_length_mm = std::sqrt(square);
    move_along(c, MotionKind::linear, target, machine, axis_positions_of(machine), way);
}

void move_cylinder_arc(ControlState& c, bool clockwise) {
    const CylinderMotion& cylinder = *c.cylinder;
    const PlaneAxes& plane = plane_axes(c.modal);
    // The rotary axis stands for X in G18, else for Y (its linear direction by 1022, assumed).
    const Axis replaced = plane.first == Axis::Z ? Axis::X : Axis::Y;
    Axis first = plane.first, second = plane.second;
    (first == replaced ? first : second) = cylinder.rotary;
    if (!has_arc_words(c)) raise_alarm(c.settings.arc_needs_centre ? 22 : 176);
    const ControlPosition target = c.target();
    const double per_degree = cylinder.radius_mm * rad_from_deg(1.0);
    const auto scale = [&](Axis axis) { return is_rotary(axis) ? per_degree : 1.0; };
    const PlanePoint start{c.program[first] * scale(first), c.program[second] * scale(second)};
    const PlanePoint end{target[first] * scale(first), target[second] * scale(second)};
    const PlaneElement figure = figure_of(c, start, end, plane.centre_first, plane.centre_second);
    const ControlPosition machine = c.coordinates.machine_from_program(target);
    const CylinderCurve curve(figure, c.move.from, axis_positions_of(machine), first, second,
                              cylinder.radius_mm);
    move_curve(c, clockwise ? MotionKind::arc_cw : MotionKind::arc_ccw, target, machine, curve,
               way_of(figure));
}

}  // namespace trunnion
