#include "controller/arcs.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

/// With 3410 = 0 an R arc whose chord exceeds the diameter by no more than this is a half circle
/// (assumed: two least increments).
constexpr double chord_slack_mm = 0.002;

void check_radii(const PlaneElement& figure, double tolerance_mm) {
    if (tolerance_mm <= 0.0) return;
    const double r0 = length_of(figure.start - figure.centre);
    const double r1 = length_of(figure.end - figure.centre);
    if (std::abs(r1 - r0) > tolerance_mm) raise_alarm(20);
}

}  // namespace

ArcRule arc_rule(const Modal& modal) {
    const bool bnc = modal.settings.is_bnc();
    const bool exchanged = bnc && modal.is(ModalGroup::plane, 180);
    return {modal.is(ModalGroup::motion, 20) != exchanged, bnc && modal.absolute(),
            modal.settings.arc_tolerance_mm};
}

PlanePoint centre_from_radius(PlanePoint start, PlanePoint end, double radius,
                              const ArcRule& rule) {
    const double dx = end.x - start.x, dy = end.y - start.y;
    const double chord = std::sqrt(dx * dx + dy * dy);
    const double half = 0.5 * chord, r = std::abs(radius);
    if (half - r > (rule.tolerance_mm > 0.0 ? rule.tolerance_mm : chord_slack_mm)) raise_alarm(20);
    const double rise = half < r ? std::sqrt((r - half) * (r + half)) : 0.0;
    // A counter-clockwise arc of less than half a turn has its centre to the left of the chord.
    const double side = (rule.clockwise ? -1.0 : 1.0) * (radius < 0.0 ? -1.0 : 1.0) * rise / chord;
    return {start.x + 0.5 * dx - side * dy, start.y + 0.5 * dy + side * dx};
}

void check_arc_words(const SortedWords& words, const Modal& modal) {
    const int spiral = words.column_of_first(SortedWords::bit('Q') | SortedWords::bit('L'));
    if (spiral != 0 && !modal.settings.is_hurco())
        refuse_option("spiral interpolation, G2 or G3 with Q or L", spiral);
    if (has_arc_words(words, modal.plane())) return;
    for (const char letter : {'I', 'J', 'K'})
        if (words.has(letter)) raise_alarm(21, words.column_of(letter));
}

bool has_arc_words(const SortedWords& words, const motion::PlaneAxes& plane) {
    return words.has('R') || words.has(plane.centre_first) || words.has(plane.centre_second);
}

void bend_to_arc(const SortedWords& words, const motion::PlaneAxes& plane, const ArcRule& rule,
                 PlaneElement& figure) {
    figure.centre = figure.start;
    if (words.has('R')) {
        const double radius = words.length_mm('R');
        if (radius == 0.0) raise_alarm(22, words.column_of('R'));
        if (figure.start.x == figure.end.x && figure.start.y == figure.end.y) return;
        figure.centre = centre_from_radius(figure.start, figure.end, radius, rule);
    } else {
        const auto take = [&](char letter, double& centre) {
            if (!words.has(letter)) return;
            centre = words.length_mm(letter) + (rule.absolute_centre ? 0.0 : centre);
        };
        take(plane.centre_first, figure.centre.x);
        take(plane.centre_second, figure.centre.y);
        check_radii(figure, rule.tolerance_mm);
    }
    figure.sweep_rad = sweep_of(figure.centre, figure.start, figure.end, rule.clockwise);
    figure.arc = true;
}

void move_arc_block(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover) {
    const motion::PlaneAxes& plane = modal.plane();
    check_arc_words(words, modal);
    const offsets::ControlPosition target = commanded_position(words, modal, frames);
    const ArcRule rule = arc_rule(modal);
    PlaneElement figure;
    if (has_arc_words(words, plane)) {
        figure.start = {frames.program[plane.first], frames.program[plane.second]};
        figure.end = {target[plane.first], target[plane.second]};
        bend_to_arc(words, plane, rule, figure);
    } else if (modal.settings.arc_needs_centre) {
        raise_alarm(22);
    }
    if (!figure.arc) {  // 3403#5 = 0: a straight line
        mover.line(motion::MotionKind::linear, target);
        return;
    }
    const ProgramArc arc{in_space(plane, frames.program, figure.centre), unit_along(plane.normal),
                         figure.sweep_rad};
    mover.arc(rule.clockwise ? motion::MotionKind::arc_cw : motion::MotionKind::arc_ccw, target,
              arc);
}

}  // namespace trunnion::controller
