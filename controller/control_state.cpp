#include "controller/control_state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/five_axis.h"
#include "controller/polar_words.h"

namespace trunnion {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Rapid speeds where the setup gives none (assumed): 24 m/min and 90 deg/s.
constexpr double default_rapid_mm_s = 400.0;
constexpr double default_rapid_rad_s = pi / 2.0;

AxisLimits limits_of(const ControlConfig& config) {
    AxisLimits out;
    out.min.fill(-infinity);
    out.max.fill(infinity);
    out.seconds_per_unit.fill(0.0);
    out.per_acceleration.fill(0.0);
    out.per_jump.fill(0.0);
    for (const ControlAxis& axis : config.axes) {
        const std::size_t i = index_of(axis.axis);
        out.min[i] = axis.min.value_or(-infinity);
        out.max[i] = axis.max.value_or(infinity);
        const double speed =
            axis.rapid_speed.value_or(axis.rotary ? default_rapid_rad_s : default_rapid_mm_s);
        out.seconds_per_unit[i] = speed > 0.0 ? 1.0 / speed : 0.0;
        if (axis.max_acceleration.value_or(0.0) <= 0.0) continue;
        out.per_acceleration[i] = 1.0 / *axis.max_acceleration;
        out.accelerates = true;
    }
    return out;
}

/// Axis number of each letter: parameter 1020 where it is set, else X Y Z A B C U V W.
void sort_axes(std::vector<ControlAxis>& axes, const Parameters& parameters) {
    const auto rank = [&](const ControlAxis& axis) {
        const auto names = parameters.entry.find(1020);
        if (names != parameters.entry.end())
            for (const auto& [number, code] : names->second.by_axis)
                if (static_cast<int>(code) == letter_of(axis.axis)) return number;
        return 100 + static_cast<int>(index_of(axis.axis));
    };
    std::stable_sort(axes.begin(), axes.end(),
                     [&](const ControlAxis& a, const ControlAxis& b) { return rank(a) < rank(b); });
}

}  // namespace

ControlState::ControlState(ControlConfig config_, Stores& stores_, MotionSink& sink_)
    : config(std::move(config_)), stores(stores_), sink(sink_), limits(limits_of(config)) {
    sort_axes(config.axes, stores.parameters);
    for (const ControlAxis& axis : config.axes)
        axis_letters |= SortedWords::bit(letter_of(axis.axis));
    modal = initial_modal_state(static_cast<unsigned>(stores.parameters.get(3402)));
    if (stores.parameters.bit(0, 2)) modal.set(ModalGroup::units, 200);
    parameters_changed();
    read_work_offset();
    stand_at({});
}

void ControlState::note(std::string text) {
    if (noted.insert(text).second) result.notes.push_back(std::move(text));
}

void ControlState::frame_changed() {
    const bool pause = path.engaged && !path.paused;
    if (pause) pause_path(*this);
    coordinates.compile();
    program = program_at(machine);
    if (pause) resume_path(*this, false);
}

void ControlState::parameters_changed() {
    settings = decode_settings(stores.parameters, config);
    for (const ControlAxis& axis : config.axes) {
        const std::size_t i = index_of(axis.axis);
        const double jump = settings.corner_jump[i] / 60.0;
        limits.per_jump[i] = 1.0 / (axis.rotary ? rad_from_deg(jump) : jump);
    }
    decode_five_axis(*this);
    units_changed();
}

void ControlState::units_changed() {
    unit_mm = modal.is(ModalGroup::units, 200) ? 25.4 : 1.0;
    const double increment_mm = inch() ? 0.0001 * 25.4 : 0.001;
    bare_linear = settings.bare_is_unit ? unit_mm : increment_mm;
    bare_rotary = settings.bare_is_unit ? 1.0 : 0.001;
    set_largest_words();
    feed_changed();
}

/// Nine digits of least increments (30i, A-79348E p. 84), eight on a 16i (A-78712E p. 1416), for
/// positions; eight digits for the rest (assumed).
void ControlState::set_largest_words() {
    constexpr std::string_view positions = "ABCIJKQRUVWXYZ";
    const bool old = config.dialect.generation == ControlGeneration::fanuc_16i;
    const double increments = old ? 99999999.0 : 999999999.0;
    for (std::size_t i = 0; i < 26; ++i) {
        const char letter = static_cast<char>('A' + i);
        const bool position = positions.find(letter) != positions.npos;
        const auto axis = axis_of(letter);
        const bool in_inch = inch() && !(axis && is_rotary(*axis));
        const double digits = in_inch ? 1e4 : 1e3;
        largest[i] = position ? increments / digits : 99999999.0;
        largest_bare[i] = position && !settings.bare_is_unit ? increments : largest[i];
    }
}

double ControlState::spindle_rpm() const {
    return spindle.rpm * spindle.direction;
}

void ControlState::feed_changed() {
    const double rpm = spindle_rpm();
    double mm_min = feed.programmed * unit_mm;
    if (modal.is(ModalGroup::feed_mode, 950)) mm_min *= std::abs(rpm);
    feed.inverse_time = modal.is(ModalGroup::feed_mode, 930);
    if (feed.inverse_time) mm_min = 0.0;
    feed.mm_min = mm_min;
    feed.seconds_per_mm = mm_min > 0.0 ? 60.0 / mm_min : 0.0;
    move.spindle_rpm = rpm;
}

void ControlState::read_work_offset() {
    const WorkOffsets& work = stores.work;
    const int code = modal[ModalGroup::work_offset];
    coordinates.external = work.external;
    coordinates.work = code == 541 ? work.additional[static_cast<std::size_t>(work_number - 1)]
                                   : work.standard[static_cast<std::size_t>(code / 10 - 54)];
    if (five_axis.plane) place_plane(*this);
    frame_changed();
}

void ControlState::fixture_changed() {
    if (fixture_number != 0) turn_fixture(*this, machine);
    frame_changed();
}

ControlPosition ControlState::program_at(const ControlPosition& machine_position) const {
    return five_axis.tcp ? tcp_program_position(*this, machine_position)
                         : coordinates.program_from_machine(machine_position);
}

void ControlState::stand_at(const ControlPosition& machine_position) {
    machine = machine_position;
    move.from = move.to = axis_positions_of(machine);
    if (five_axis.plane) place_plane(*this);
    coordinates.compile();
    program = program_at(machine);
}

double ControlState::axis_word(Axis axis) const {
    const char letter = letter_of(axis);
    if (is_rotary(axis)) return words.get(letter) * (words.is_bare(letter) ? bare_rotary : 1.0);
    return length_word(letter);
}

int ControlState::whole_word(char letter) const {
    const double value = words.get(letter);
    const double whole = std::round(value);
    if (std::abs(value - whole) > 1e-6) raise_alarm(7, words.column_of(letter));
    if (std::abs(whole) > 999999999.0) raise_alarm(3, words.column_of(letter));
    return static_cast<int>(whole);
}

ControlPosition ControlState::target() {
    if (modal.is(ModalGroup::polar_words, 160)) return polar_target(*this);
    ControlPosition out = program;
    const bool relative = !absolute();
    for (const ControlAxis& entry : config.axes) {
        const Axis axis = entry.axis;
        if (!words.has(letter_of(axis))) continue;
        const double value = axis_word(axis);
        out[axis] = relative ? out[axis] + value : value;
    }
    if (!relative && (settings.rollover || five_axis.shortest_way)) take_shortest_way(*this, out);
    return out;
}

const PlaneAxes& plane_axes(const ModalState& modal) {
    static constexpr PlaneAxes xy{Axis::X, Axis::Y, Axis::Z, 'I', 'J'};
    static constexpr PlaneAxes zx{Axis::Z, Axis::X, Axis::Y, 'K', 'I'};
    static constexpr PlaneAxes yz{Axis::Y, Axis::Z, Axis::X, 'J', 'K'};
    const int code = modal[ModalGroup::plane];
    return code == 170 ? xy : code == 180 ? zx : yz;
}

}  // namespace trunnion
