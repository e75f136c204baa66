// G codes that change how words are read: units, plane, feed, polar words; and dwell.
#include "controller/readings.h"

#include <fmt/format.h>

#include "controller/control_state.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/polar_words.h"

namespace trunnion {

double feed_word_unit(const ControlState& c) {
    if (!c.words.is_bare('F') || c.settings.bare_is_unit) return 1.0;
    // Without a point and with 3401#0 = 0: 1 mm/min, 0.01 in/min, 0.01 mm/turn, 0.0001 in/turn.
    if (c.modal.is(ModalGroup::feed_mode, 950)) return c.inch() ? 0.0001 : 0.01;
    if (c.modal.is(ModalGroup::feed_mode, 940)) return c.inch() ? 0.01 : 1.0;
    return 1.0;
}

void g_units(ControlState& c, const GCode& code) {
    const double before_mm = c.unit_mm;
    c.modal.set(ModalGroup::units, code.code10);
    c.units_changed();
    c.units_switched = true;
    if (c.unit_mm != before_mm) {  // F stays the same speed
        if (!c.modal.is(ModalGroup::feed_mode, 930)) c.feed.programmed *= before_mm / c.unit_mm;
        c.feed_changed();
    }
}

void g_plane(ControlState& c, const GCode& code) {
    const bool changes = !c.modal.is(ModalGroup::plane, code.code10);
    if (changes && !c.modal.is(ModalGroup::cutter, 400)) raise_alarm(37);
    c.modal.set(ModalGroup::plane, code.code10);
}

void g_feed_mode(ControlState& c, const GCode& code) {
    if (!c.modal.is(ModalGroup::feed_mode, code.code10)) c.feed.programmed = 0.0;
    c.modal.set(ModalGroup::feed_mode, code.code10);
    c.feed_changed();
}

void g_polar_words(ControlState& c, const GCode& code) {
    c.modal.set(ModalGroup::polar_words, code.code10);
    start_polar_words(c);
}

void g_exact_stop(ControlState& c, const GCode&) {
    c.exact_stop_once = true;
}

void g_accepted(ControlState& c, const GCode& code) {
    c.note(fmt::format("{} ({}) is accepted: it smooths a real path, positions stay",
                       g_code_text(code.code10), code.text));
}

void g_dwell(ControlState& c, const GCode&) {
    const SortedWords& w = c.words;
    double duration_s = 0.0;
    if (w.has('P')) duration_s = c.whole_word('P') * 0.001;
    for (const char letter : {'X', 'U'}) {
        if (!w.has(letter)) continue;
        const bool in_ms = w.is_bare(letter) && !c.settings.bare_is_unit;
        duration_s = w.get(letter) * (in_ms ? 0.001 : 1.0);
    }
    if (duration_s < 0.0) raise_alarm(6, w.column_of(w.has('P') ? 'P' : 'X'));
    queue_dwell(c, duration_s);
}

}  // namespace trunnion
