#include "controller/modal.h"

#include <cmath>
#include <string_view>

namespace trunnion::controller {

namespace {

double steps_per_mm_of(VariableRounding rounding) {
    for (const VariableRoundingName& row : variable_roundings)
        if (row.rounding == rounding) return row.steps_per_mm;
    return 0.0;
}

}  // namespace

const motion::PlaneAxes& Modal::plane() const {
    const int code = codes[ModalGroup::plane];
    return code == 170 ? motion::plane_xy : code == 180 ? motion::plane_zx : motion::plane_yz;
}

void Modal::units_changed() {
    units.unit_mm = is(ModalGroup::units, 200) ? 25.4 : 1.0;
    const double increment_mm = units.inch() ? 0.0001 * 25.4 : 0.001;
    units.bare_linear = settings.bare_is_unit ? units.unit_mm : increment_mm;
    units.bare_rotary = settings.bare_is_unit ? 1.0 : 0.001;
    set_limits_of_words();
    feed_changed();
}

/// Positions: nine digits in least increments (30i, A-79348E p. 84), eight on a 16i (A-78712E p.
/// 1416). Other words: eight digits (assumed).
void Modal::set_limits_of_words() {
    constexpr std::string_view positions = "ABCIJKQRUVWXYZ";
    const double steps_per_mm = steps_per_mm_of(settings.variable_rounding);
    for (std::size_t i = 0; i < 26; ++i) {
        const char letter = static_cast<char>('A' + i);
        const bool position = positions.find(letter) != positions.npos;
        const auto axis = axis_of(letter);
        const bool in_inch = units.inch() && !(axis && is_rotary(*axis));
        const double digits = in_inch ? 1e4 : 1e3;
        steps_per_unit[i] = !position ? 0.0 : in_inch ? 10.0 * steps_per_mm : steps_per_mm;
        largest[i] = position ? settings.largest_position / digits : 99999999.0;
        largest_bare[i] =
            position && !settings.bare_is_unit ? settings.largest_position : largest[i];
    }
}

void Modal::feed_changed() {
    motion::FeedState& feed = block.feed;
    const double rpm = spindle.signed_rpm();
    double mm_min = feed.programmed * units.unit_mm;
    if (is(ModalGroup::feed_mode, 950)) mm_min *= std::abs(rpm);
    feed.inverse_time = is(ModalGroup::feed_mode, 930);
    if (feed.inverse_time) mm_min = 0.0;
    feed.mm_min = mm_min;
    feed.seconds_per_mm = mm_min > 0.0 ? 60.0 / mm_min : 0.0;
    block.spindle_rpm = rpm;
}

}  // namespace trunnion::controller
