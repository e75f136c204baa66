#include "controller/word_readings.h"

#include "controller/alarms.h"

namespace trunnion::controller {

double feed_word_unit(const SortedWords& words, const Modal& modal) {
    if (!words.is_bare('F') || modal.settings.bare_is_unit) return 1.0;
    // Without decimal point and with 3401#0 = 0: 1 mm/min, 0.01 in/min, 0.01 mm/rev, 0.0001 in/rev.
    const bool inch = modal.units.inch();
    if (modal.is(ModalGroup::feed_mode, 950)) return inch ? 0.0001 : 0.01;
    if (modal.is(ModalGroup::feed_mode, 940)) return inch ? 0.01 : 1.0;
    return 1.0;
}

void change_units(Modal& modal, int code10) {
    const double before_mm = modal.units.unit_mm;
    modal.codes.set(ModalGroup::units, code10);
    modal.units_changed();
    const double unit_mm = modal.units.unit_mm;
    if (unit_mm == before_mm) return;
    if (!modal.is(ModalGroup::feed_mode, 930)) modal.block.feed.programmed *= before_mm / unit_mm;
    modal.feed_changed();
}

void change_plane(Modal& modal, int code10) {
    if (!modal.is(ModalGroup::plane, code10) && !modal.cutter_is_off()) raise_alarm(37);
    modal.codes.set(ModalGroup::plane, code10);
}

void change_feed_mode(Modal& modal, int code10) {
    if (!modal.is(ModalGroup::feed_mode, code10)) modal.block.feed.programmed = 0.0;
    modal.codes.set(ModalGroup::feed_mode, code10);
    modal.feed_changed();
}

double dwell_word_s(const SortedWords& words, const Modal& modal) {
    return modal.settings.is_hurco() ? words.get('P') : words.whole('P') * 0.001;
}

void dwell(const SortedWords& words, const Modal& modal, Mover& mover) {
    double duration_s = 0.0;
    if (words.has('P')) duration_s = dwell_word_s(words, modal);
    for (const char letter : {'X', 'U'}) {
        if (!words.has(letter)) continue;
        const bool in_ms = words.is_bare(letter) && !modal.settings.bare_is_unit;
        duration_s = words.get(letter) * (in_ms ? 0.001 : 1.0);
    }
    if (duration_s < 0.0) raise_alarm(6, words.column_of('P'));
    mover.dwell(duration_s);
}

}  // namespace trunnion::controller
