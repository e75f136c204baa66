#include "controller/wrapped_motion.h"

#include <array>
#include <cmath>

#include "controller/alarms.h"
#include "controller/arcs.h"
#include "controller/commanded.h"

namespace trunnion::controller {

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

/// Axes that follow a figure in a plane through the mapping of one axis pair; the other axes are
/// linear in s.
class FigureCurve : public motion::PathCurve {
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

/// A linear (radius) axis and a rotary axis follow a figure in the rotating plane.
class PolarCurve : public FigureCurve {
  public:
    PolarCurve(const PlaneElement& figure, const AxisPositions& from, const AxisPositions& to,
               const PolarMotion& axes)
        : FigureCurve(figure, from, to), axes_(axes) {
        for (int i = 1; i <= steps; ++i) {
            const auto before = static_cast<std::size_t>(i - 1);
            turned_rad_[before + 1] =
                turned_rad_[before] + angle_between(station(i - 1), station(i));
        }
    }

    AxisPositions at(double s) const override {
        AxisPositions out = others_at(s);
        out[axes_.linear] =
            from_[axes_.linear] + length_of(point_on(figure_, s)) - length_of(figure_.start);
        out[axes_.rotary] = from_[axes_.rotary] + turned(s);
        return out;
    }
    /// Angle about the pole up to s, rad: counted from station to station, so that full turns
    /// about the pole count.
    double turned(double s) const {
        if (s <= 0.0) return 0.0;
        const int passed = static_cast<int>(std::ceil(s * steps)) - 1;
        return turned_rad_[static_cast<std::size_t>(passed)] +
               angle_between(station(passed), point_on(figure_, s));
    }

  private:
    static constexpr int steps = 64;
    static double angle_between(PlanePoint from, PlanePoint to) {
        return std::atan2(cross(from, to), dot(from, to));
    }
    PlanePoint station(int i) const {
        return i == 0 ? figure_.start : point_on(figure_, static_cast<double>(i) / steps);
    }
    std::array<double, steps + 1> turned_rad_{};
    PolarMotion axes_;
};

/// A linear axis and the rotary axis (radius * angle) follow a figure on the developed cylinder.
class CylinderCurve : public FigureCurve {
  public:
    CylinderCurve(const PlaneElement& figure, const AxisPositions& from, const AxisPositions& to,
                  const motion::PlaneAxes& plane, double radius_mm)
        : FigureCurve(figure, from, to),
          first_(plane.first),
          second_(plane.second),
          radius_mm_(radius_mm) {}

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

/// A line or arc between two points of a plane, with its centre words.
PlaneElement figure_of(const SortedWords& words, const Modal& modal,
                       const motion::PlaneAxes& letters, PlaneElement figure, Mover& mover) {
    const int code = modal.codes[ModalGroup::motion];
    if (code == 20 || code == 30)
        watch_arc(bend_to_arc(words, letters, arc_rule(modal), figure), figure, modal, mover);
    return figure;
}

std::optional<Axis> first_rotary(const SortedWords& words, const ControlSettings& settings) {
    for (const ControlAxis& axis : settings.axes)
        if (axis.rotary && words.has(axis.axis)) return axis.axis;
    return std::nullopt;
}

/// 5460, 5461: the axis of a number; `otherwise` when absent.
Axis axis_by_number(const ControlSettings& settings, double number, Axis otherwise) {
    if (!(number >= 1.0) || number > static_cast<double>(settings.axes.size())) return otherwise;
    return settings.axes[static_cast<std::size_t>(number) - 1].axis;
}

CurveMove along_curve(const motion::PathCurve& curve, const PlaneElement& figure) {
    CurveMove way;
    way.curve = &curve;
    way.length_mm = way.feed_length_mm = way_of(figure);
    return way;
}

motion::MotionKind kind_of(const Modal& modal) {
    switch (modal.codes[ModalGroup::motion]) {
        case 20: return motion::MotionKind::arc_cw;
        case 30: return motion::MotionKind::arc_ccw;
        default: return motion::MotionKind::linear;
    }
}

}  // namespace

void WrappedMotion::set_polar(Modal& modal, const Frames& frames, int code10) {
    if (!modal.cutter_is_off() || frames.tip.in_force || frames.plane || frames.fixture_number != 0)
        raise_alarm(145);
    modal.codes.set(ModalGroup::polar_motion, code10);
    polar_.reset();
    if (code10 != 121) return;
    const offsets::Parameters& parameters = frames.stores().parameters;
    PolarMotion polar;
    polar.linear = axis_by_number(modal.settings, parameters.get(5460), Axis::X);
    polar.rotary = axis_by_number(modal.settings, parameters.get(5461), Axis::C);
    if (!modal.has_axis(polar.linear) || !modal.has_axis(polar.rotary)) raise_alarm(145);
    polar.at.x = frames.program[polar.linear];  // the rotary axis is at the zero of the figure
    polar_ = polar;
}

void WrappedMotion::set_cylinder(const SortedWords& words, const Modal& modal) {
    const auto axis = first_rotary(words, modal.settings);
    if (!axis) raise_alarm(175);
    const double radius = words.length_mm(letter_of(*axis));
    if (radius < 0.0) raise_alarm(175);
    if (!modal.cutter_is_off()) raise_alarm(176);
    cylinder_.reset();
    if (radius > 0.0) cylinder_ = CylinderMotion{*axis, radius};
}

/// The words of the figure are removed; the other axes move linearly.
void WrappedMotion::move_polar(SortedWords& words, Modal& modal, const Frames& frames,
                               Mover& mover) {
    PolarMotion& polar = *polar_;
    const bool rapid = modal.is(ModalGroup::motion, 0);
    if (rapid && (words.has(polar.linear) || words.has(polar.rotary))) raise_alarm(146);
    const char x_word = letter_of(polar.linear), y_word = letter_of(polar.rotary);
    PlaneElement figure;
    figure.start = figure.end = polar.at;
    const auto read = [&](char letter, double& value) {
        if (words.has(letter)) value = (modal.absolute() ? 0.0 : value) + words.length_mm(letter);
    };
    read(x_word, figure.end.x);
    read(y_word, figure.end.y);
    words.present &= ~(SortedWords::bit(x_word) | SortedWords::bit(y_word));
    figure = figure_of(words, modal, motion::plane_xy, figure, mover);
    offsets::ControlPosition target = commanded_position(words, modal, frames);
    const double turned = PolarCurve(figure, frames.axes, frames.axes, polar).turned(1.0);
    target[polar.linear] += length_of(figure.end) - length_of(figure.start);
    target[polar.rotary] += deg_from_rad(turned);
    polar.at = figure.end;
    if (!figure.moves()) {
        mover.line(rapid ? motion::MotionKind::rapid : motion::MotionKind::linear, target);
        return;
    }
    const offsets::ControlPosition machine = frames.stages.machine_from_program(target);
    const AxisPositions from = frames.axes, to = offsets::axis_positions_of(machine);
    const PolarCurve curve(figure, from, to, polar);
    mover.axes.along(kind_of(modal), {target, machine, to}, along_curve(curve, figure));
}

/// Straight lines are straight for the axes as well. F is the speed on the cylinder surface: the
/// rotary axis counts its angle times the radius.
void WrappedMotion::move_cylinder_line(const SortedWords& words, Modal& modal, const Frames& frames,
                                       Mover& mover) {
    const offsets::ControlPosition target = commanded_position(words, modal, frames);
    const offsets::ControlPosition machine = frames.stages.machine_from_program(target);
    double square = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const bool wound = all_axes[i] == cylinder_->rotary;
        const double d = machine.value[i] - frames.machine.value[i];
        square += std::pow(wound ? rad_from_deg(d) * cylinder_->radius_mm : d, 2);
    }
    CurveMove way;
    way.length_mm = way.feed_length_mm = std::sqrt(square);
    mover.axes.along(motion::MotionKind::linear,
                     {target, machine, offsets::axis_positions_of(machine)}, way);
}

void WrappedMotion::move_cylinder_arc(const SortedWords& words, Modal& modal, const Frames& frames,
                                      Mover& mover) {
    motion::PlaneAxes plane = modal.plane();
    if (!has_arc_words(words, plane)) raise_alarm(modal.settings.arc_needs_centre ? 22 : 176);
    // The rotary axis replaces X in G18, else Y (its linear direction by 1022, assumed).
    const Axis replaced = plane.first == Axis::Z ? Axis::X : Axis::Y;
    (plane.first == replaced ? plane.first : plane.second) = cylinder_->rotary;
    const offsets::ControlPosition target = commanded_position(words, modal, frames);
    const double per_degree = cylinder_->radius_mm * rad_from_deg(1.0);
    const auto unrolled = [&](const offsets::ControlPosition& p, Axis axis) {
        return p[axis] * (is_rotary(axis) ? per_degree : 1.0);
    };
    PlaneElement figure;
    figure.start = {unrolled(frames.program, plane.first), unrolled(frames.program, plane.second)};
    figure.end = {unrolled(target, plane.first), unrolled(target, plane.second)};
    figure = figure_of(words, modal, plane, figure, mover);
    const offsets::ControlPosition machine = frames.stages.machine_from_program(target);
    const AxisPositions from = frames.axes, to = offsets::axis_positions_of(machine);
    const CylinderCurve curve(figure, from, to, plane, cylinder_->radius_mm);
    mover.axes.along(kind_of(modal), {target, machine, to}, along_curve(curve, figure));
}

}  // namespace trunnion::controller
