#include "controller/arcs.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

/// With 3410 = 0 an R arc whose chord exceeds the diameter by no more than this is a half circle
/// (assumed: two least increments).
constexpr double chord_slack_mm = 0.002;

/// With 3410 = 0 ends that are farther off the circle than rounded words explain are told
/// (assumed).
constexpr double open_arc_mm = 0.02;

double start_radius(const PlaneElement& figure) {
    return length_of(figure.start - figure.centre);
}
double end_radius(const PlaneElement& figure) {
    return length_of(figure.end - figure.centre);
}

}  // namespace

ArcFit fit_of_radii(double start_mm, double end_mm, double tolerance_mm) {
    const double apart = std::abs(end_mm - start_mm);
    if (tolerance_mm > 0.0) return apart > tolerance_mm ? ArcFit::refused : ArcFit::good;
    return apart > open_arc_mm ? ArcFit::open : ArcFit::good;
}

bool chord_exceeds(double chord_mm, double radius_mm, double tolerance_mm) {
    return 0.5 * chord_mm - std::abs(radius_mm) >
           (tolerance_mm > 0.0 ? tolerance_mm : chord_slack_mm);
}

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
    if (chord_exceeds(chord, radius, rule.tolerance_mm)) raise_alarm(20);
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

ArcFit bend_to_arc(const SortedWords& words, const motion::PlaneAxes& plane, const ArcRule& rule,
                   PlaneElement& figure) {
    figure.centre = figure.start;
    ArcFit fit = ArcFit::good;
    if (words.has('R')) {
        const double radius = words.length_mm('R');
        if (radius == 0.0) raise_alarm(22, words.column_of('R'));
        if (figure.start.x == figure.end.x && figure.start.y == figure.end.y) return fit;
        figure.centre = centre_from_radius(figure.start, figure.end, radius, rule);
    } else {
        const auto take = [&](char letter, double& centre) {
            if (!words.has(letter)) return;
            centre = words.length_mm(letter) + (rule.absolute_centre ? 0.0 : centre);
        };
        take(plane.centre_first, figure.centre.x);
        take(plane.centre_second, figure.centre.y);
        fit = fit_of_radii(start_radius(figure), end_radius(figure), rule.tolerance_mm);
        if (fit == ArcFit::refused) raise_alarm(20);
    }
    figure.sweep_rad = sweep_of(figure.centre, figure.start, figure.end, rule.clockwise);
    figure.arc = true;
    return fit;
}

void watch_arc(ArcFit fit, const PlaneElement& figure, const Modal& modal, Mover& mover) {
    if (fit == ArcFit::open)
        mover.caution({.kind = CautionKind::open_arc,
                       .line = modal.block.line,
                       .start_mm = start_radius(figure),
                       .end_mm = end_radius(figure)});
}

void watch_straight_arc(const SortedWords& words, const Modal& modal, Mover& mover) {
    const motion::PlaneAxes& plane = modal.plane();
    if (!words.has('R') && (words.has(plane.first) || words.has(plane.second)))
        mover.caution({.kind = CautionKind::straight_arc, .line = modal.block.line});
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
        watch_arc(bend_to_arc(words, plane, rule, figure), figure, modal, mover);
    } else if (modal.settings.arc_needs_centre) {
        raise_alarm(22);
    }
    if (!figure.arc) {  // 3403#5 = 0: a straight line
        watch_straight_arc(words, modal, mover);
        mover.line(motion::MotionKind::linear, target);
        return;
    }
    const ProgramArc arc{in_space(plane, frames.program, figure.centre), unit_along(plane.normal),
                         figure.sweep_rad};
    mover.arc(rule.clockwise ? motion::MotionKind::arc_cw : motion::MotionKind::arc_ccw, target,
              arc);
}

}  // namespace trunnion::controller
