#include "controller/five_axis.h"

#include <algorithm>
#include <cmath>

#include "controller/g_codes.h"
#include "offsets/axis_numbers.h"
#include "positioning/rotary_choice.h"

namespace trunnion {

namespace {

std::vector<Axis> axis_order(const ControlState& c) {
    std::vector<Axis> order;
    for (const ControlAxis& axis : c.config.axes) order.push_back(axis.axis);
    return order;
}

PositioningMode mode_of(const ControlState& c) {
    const FiveAxisState& five = c.five_axis;
    if (five.tcp || five.starting) return PositioningMode::rtcp;
    if (five.plane) return PositioningMode::tw;
    if (c.fixture_number != 0) return PositioningMode::rtdfo;
    const bool rotary = std::any_of(c.config.axes.begin(), c.config.axes.end(),
                                    [](const ControlAxis& axis) { return axis.rotary; });
    return rotary ? PositioningMode::dpp : PositioningMode::none;
}

RotaryTravel::Range travel_of(const ControlState& c, const PivotAxis& axis) {
    RotaryTravel::Range range{axis.min_rad, axis.max_rad};
    for (const ControlAxis& entry : c.config.axes) {
        if (axis.hypothetical || entry.axis != axis.axis) continue;
        if (entry.min) range.min_rad = std::max(*entry.min, range.min_rad.value_or(*entry.min));
        if (entry.max) range.max_rad = std::min(*entry.max, range.max_rad.value_or(*entry.max));
    }
    return range;
}

bool rotaries_moved(const AxisPositions& a, const AxisPositions& b) {
    return a[Axis::A] != b[Axis::A] || a[Axis::B] != b[Axis::B] || a[Axis::C] != b[Axis::C];
}

}  // namespace

void decode_five_axis(ControlState& c) {
    FiveAxisState& five = c.five_axis;
    five.transform.reset();
    five.fault.reset();
    five.fixture.reset();
    try {
        if (const auto pivot = decode_pivot(c.stores.parameters, axis_order(c)))
            five.transform.emplace(*pivot);
    } catch (const Alarm& alarm) {
        five.fault = alarm;
    }
    c.move.parallel = parallel_axes(c.stores.parameters, axis_order(c));
    c.move.transform = five.transform ? &*five.transform : nullptr;
    five_axis_changed(c);
}

const RotaryTransform& five_axis_transform(const ControlState& c, int otherwise) {
    if (c.five_axis.fault) throw Alarm(*c.five_axis.fault);
    if (!c.five_axis.transform) raise_alarm(otherwise, "(No.19680 is 0)");
    return *c.five_axis.transform;
}

void five_axis_changed(ControlState& c) {
    FiveAxisState& five = c.five_axis;
    five.active = five.tcp || five.starting || five.plane || five.definition.pending() ||
                  c.fixture_number != 0;
    c.move.mode = mode_of(c);
}

RotaryTravel rotary_travel(const ControlState& c) {
    const PivotParameters& pivot = c.five_axis.transform->pivot();
    return {travel_of(c, pivot.first), travel_of(c, pivot.second)};
}

void five_axis_block_begin(const ControlState& c) {
    if (!c.five_axis.definition.pending()) return;
    const SortedWords& w = c.words;
    const bool goes_on =
        w.code_count == 1 && w.code[0]->code10 == c.five_axis.definition_code10 && !w.motion;
    if (!goes_on)
        raise_alarm(5457, "(another block within a definition)",
                    w.code_count != 0 ? w.code_column[0] : 0);
}

void five_axis_block_end(ControlState& c) {
    FiveAxisState& five = c.five_axis;
    bool changed = false;
    if (five.starting) {
        five.tcp = five.starting;
        five.starting.reset();
        c.frame_changed();
        if (five.by_vector && (c.words.present & tool_vector_letters))
            move_tip(c, MotionKind::rapid, c.program);
    }
    if (five.plane && rotaries_moved(five.plane->latched, c.move.from)) {
        place_plane(c);
        changed = true;
    }
    if (c.fixture_number != 0 && turn_fixture(c, c.machine)) changed = true;
    if (changed) c.frame_changed();
}

namespace {

/// The way (deg) to |wanted| mod 360 in the direction of its sign.
double way_by_sign(double present, double wanted) {
    const double way = std::fmod(std::abs(wanted) - present, 360.0);
    if (std::signbit(wanted)) return way > 0.0 ? way - 360.0 : way;
    return way < 0.0 ? way + 360.0 : way;
}

}  // namespace

void take_shortest_way(const ControlState& c, ControlPosition& target) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
        if (!c.words.has(letter_of(axis))) continue;
        const auto bit = static_cast<std::uint16_t>(1U << index_of(axis));
        const bool rolls = (c.settings.rollover & bit) != 0;
        if (!c.five_axis.shortest_way && !rolls) continue;
        const double present = c.program[axis], wanted = target[axis];
        const bool by_sign = !c.five_axis.shortest_way && (c.settings.rollover_signed & bit);
        target[axis] = present + (by_sign ? way_by_sign(present, wanted)
                                          : std::remainder(wanted - present, 360.0));
    }
}

MoveResult move_five_axis(ControlState& c, MotionKind kind, const ControlPosition& target) {
    if (c.five_axis.tcp) return move_tip(c, kind, target);
    if (follow_fixture(c, target)) c.coordinates.compile();
    return move_straight(c, kind, target);
}

}  // namespace trunnion
