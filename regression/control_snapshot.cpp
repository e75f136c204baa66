#include "regression/control_snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "controller/control.h"
#include "controller/g_codes.h"

namespace trunnion::regression {

namespace {

float number(double value) {
    return static_cast<float>(value + 0.0);
}

std::array<float, 3> xyz(const offsets::ControlPosition& p) {
    return {number(p[Axis::X]), number(p[Axis::Y]), number(p[Axis::Z])};
}

void read_frames(const controller::Frames& frames, ControlSnapshot& s) {
    const controller::Coordinates& stages = frames.stages;
    const offsets::ControlPosition origin = stages.work_origin();
    s.length_mm = xyz(stages.length);
    s.origin_mm = xyz(origin);
    s.origin_deg = {number(origin[Axis::A]), number(origin[Axis::B]), number(origin[Axis::C])};
    s.local_mm = xyz(stages.local);
    s.preset_mm = xyz(stages.preset);
    s.rotation_deg = stages.rotation ? number(stages.rotation->angle_deg) : 0.0F;
    s.scale = {1.0F, 1.0F, 1.0F};
    for (const auto* factor : {&stages.scaling, &stages.mirror})
        if (*factor)
            for (std::size_t k = 0; k < 3; ++k) s.scale[k] *= xyz((*factor)->factor)[k];
    s.fixture_number = static_cast<std::int16_t>(frames.fixture_number);
    s.length_number = static_cast<std::int16_t>(frames.tool.number);
    s.feature = {};
    if (!stages.feature_MF) return;
    for (std::size_t k = 0; k < 9; ++k)
        s.feature[k] = number(stages.feature_MF->rotation(static_cast<Eigen::Index>(k / 3),
                                                          static_cast<Eigen::Index>(k % 3)));
}

/// Radius of offset number D while G41 or G42 is active.
double radius_in_force_mm(const controller::Control& c) {
    const auto d = static_cast<std::size_t>(std::max(0, c.modal.number.radius));
    const auto& tools = c.stores.tools.tool;
    return c.modal.cutter_is_off() || d >= tools.size() ? 0.0 : tools[d].radius_mm();
}

void read_numbers(const controller::Control& c, ControlSnapshot& s) {
    const controller::Modal& modal = c.modal;
    s.work_number = static_cast<std::int16_t>(modal.number.work);
    s.radius_number = static_cast<std::int16_t>(modal.number.radius);
    s.tool_selected = modal.number.tool;
    s.tool = modal.block.tool;
    s.spindle_direction = modal.spindle.direction;
    s.coolant = modal.block.coolant ? 1 : 0;
    s.feed = number(modal.block.feed.programmed);
    s.speed = number(modal.spindle.programmed);
    s.radius_mm = number(radius_in_force_mm(c));
}

/// G5.1 Q R, G5 P, G8 P: accepted by the control without effect on positions.
void read_smoothing(const controller::SortedWords& words, ControlSnapshot& s) {
    constexpr std::array<int, 4> code10{51, 51, 50, 80};
    constexpr std::array<char, 4> letter{'Q', 'R', 'P', 'P'};
    for (std::size_t k = 0; k < words.code_count; ++k)
        for (std::size_t n = 0; n < code10.size(); ++n)
            if (words.code[k]->code10 == code10[n])
                s.smoothing[n] = number(words.get(letter[n], 0.0));
}

/// The stores written by a G10 block, as one number. The values are compared at the end, with a
/// tolerance.
std::uint64_t store_key_of(const controller::Control& c) {
    const controller::SortedWords& w = c.words;
    if (!w.has_code(100)) return 0;
    std::uint64_t h = 1;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
        if (!w.has(letter)) continue;
        const bool amount = std::strchr("ABCXYZUVWR", letter) != nullptr;
        const double value = amount ? 0.0 : w.get(letter);
        h = (h ^ static_cast<std::uint64_t>(letter)) * 0xBF58476D1CE4E5B9ULL;
        h = (h ^ static_cast<std::uint64_t>(std::llround(value * 1e4))) * 0x94D049BB133111EBULL;
        h ^= h >> 31U;
    }
    return h | 1U;
}

/// A number without point that would be another length in least increments.
bool has_bare_length(const controller::SortedWords& w) {
    constexpr std::string_view lengths = "ABCIJKQRUVWXYZ";
    return std::any_of(lengths.begin(), lengths.end(), [&w](char letter) {
        return w.has(letter) && w.is_bare(letter) && w.get(letter) != 0.0;
    });
}

}  // namespace

BlockLook look_at(const controller::Control& c, ControlSnapshot& s) {
    std::copy(c.modal.codes.code10.begin(), c.modal.codes.code10.end(), s.modal10.begin());
    read_numbers(c, s);
    read_frames(c.frames, s);
    read_smoothing(c.words, s);
    for (int k = 0; k < 2; ++k)
        s.overrides[static_cast<std::size_t>(k)] = number(c.clock.get(3003 + k, 0.0).value_or(0.0));
    BlockLook look;
    look.line = c.modal.block.line;
    look.program = c.modal.block.program;
    look.store_key = store_key_of(c);
    const offsets::ControlPosition& machine = c.frames.machine;
    look.rotary_deg = {machine[Axis::A], machine[Axis::B], machine[Axis::C]};
    look.bare_words_meet_no_parameter =
        c.words.bare != 0 && has_bare_length(c.words) && !c.stores.parameters.find(3401);
    return look;
}

UnsetOffsets unset_offsets(const controller::Control& c) {
    const auto row = [&c](int n) {
        const auto& tools = c.stores.tools.tool;
        const auto k = static_cast<std::size_t>(std::max(0, n));
        return k < tools.size() ? tools[k] : offsets::ToolOffset{};
    };
    UnsetOffsets unset;
    unset.length = c.frames.tool.number;
    const offsets::ToolOffset length = row(unset.length);
    unset.length_is_set = length.length_given || length.length_mm() != 0.0;
    const int d = c.modal.number.radius;
    const offsets::ToolOffset radius = row(d);
    if (!c.modal.cutter_is_off() && !radius.radius_given && radius.radius_mm() == 0.0)
        unset.radius = c.modal.codes.code10[7] == 420 ? -d : d;
    const auto& work = c.frames.stages.work.value;
    if (std::all_of(work.begin(), work.end(), [](double value) { return value == 0.0; })) {
        const int code10 = c.modal.codes.code10[14];
        unset.work = code10 == 541 ? 100 + c.modal.number.work : code10 / 10;
    }
    return unset;
}

int tool_in_spindle(const controller::Control& control) {
    return control.modal.block.tool;
}

int running_line(const controller::Control& control) {
    return control.modal.block.line;
}

bool feeds_by_inverse_time(const controller::Control& control) {
    return control.modal.block.feed.inverse_time;
}

// The fields ------------------------------------------------------------------------------------

namespace {

using Values = std::array<double, 3>;
using S = const ControlSnapshot&;

template <std::size_t group>
Values modal_value(S s) {
    return {static_cast<double>(s.modal10[group]), 0.0, 0.0};
}
template <std::size_t group>
std::string modal_text(S s) {
    return controller::g_code_text(s.modal10[group]);
}

std::string vector_text(const char* what, const std::array<float, 3>& v) {
    return fmt::format("{} ({:.4g}, {:.4g}, {:.4g})", what, v[0], v[1], v[2]);
}

Values of(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

std::string work_text(S s) {
    const std::string code = controller::g_code_text(s.modal10[14]);
    return s.modal10[14] == 541 ? fmt::format("{} P{}", code, s.work_number) : code;
}

/// Row-major rotation: its trace and last row suffice for a comparison.
Values feature_value(S s) {
    return {s.feature[2] + 3.0 * s.feature[0], s.feature[5] + 3.0 * s.feature[3],
            s.feature[8] + 3.0 * s.feature[6]};
}

template <std::size_t group>
constexpr SnapshotField modal(const char* name, unsigned explains) {
    return {name, explains, modal_value<group>, modal_text<group>};
}

const SnapshotField fields[] = {
    modal<6>("units", explains_path | explains_feed),
    modal<3>("absolute or incremental", explains_path),
    modal<2>("plane", explains_path),
    modal<5>("feed mode", explains_feed),
    {"work offset", explains_path,
     [](S s) {
         return Values{static_cast<double>(s.modal10[14]),
                       s.modal10[14] == 541 ? static_cast<double>(s.work_number) : 0.0};
     },
     work_text},
    modal<8>("length compensation", explains_path),
    {"length number", explains_path,
     [](S s) { return Values{static_cast<double>(s.length_number)}; },
     [](S s) { return fmt::format("H{}", s.length_number); }},
    modal<7>("cutter compensation", explains_path),
    {"radius number", explains_path,
     [](S s) { return Values{static_cast<double>(s.radius_number)}; },
     [](S s) { return fmt::format("D{}", s.radius_number); }},
    {"tool", explains_path | explains_tool, [](S s) { return Values{static_cast<double>(s.tool)}; },
     [](S s) { return fmt::format("T{}", s.tool); }},
    modal<9>("canned cycle", explains_path),
    modal<10>("level after a cycle", explains_path),
    modal<16>("rotation or tilted plane", explains_path),
    {"angles of the tilted plane", explains_path, feature_value,
     [](S) { return std::string("another orientation of the tilted plane"); }},
    {"angle of rotation", explains_path, [](S s) { return Values{s.rotation_deg}; },
     [](S s) { return fmt::format("G68 R{:.4g}", s.rotation_deg); }},
    {"scaling and mirror", explains_path, [](S s) { return of(s.scale); },
     [](S s) { return vector_text("scaling or mirror", s.scale); }},
    {"local shift", explains_path, [](S s) { return of(s.local_mm); },
     [](S s) { return vector_text("G52", s.local_mm); }},
    {"preset", explains_path, [](S s) { return of(s.preset_mm); },
     [](S s) { return vector_text("G92", s.preset_mm); }},
    modal<17>("polar words", explains_path),
    modal<21>("polar interpolation", explains_path),
    {"fixture offset", explains_path,
     [](S s) { return Values{static_cast<double>(s.fixture_number)}; },
     [](S s) { return fmt::format("G54.2 P{}", s.fixture_number); }},
    {"cutter radius", explains_path, [](S s) { return Values{s.radius_mm}; },
     [](S s) { return fmt::format("cutter radius {:.4g} mm", s.radius_mm); }},
    {"tool length", explains_path,
     [](S s) { return Values{std::hypot(s.length_mm[0], s.length_mm[1], s.length_mm[2])}; },
     [](S s) {
         return fmt::format("tool length {:.4f} mm",
                            std::hypot(s.length_mm[0], s.length_mm[1], s.length_mm[2]));
     }},
    {"work zero", explains_path, [](S s) { return of(s.origin_mm); },
     [](S s) { return vector_text("work zero", s.origin_mm); }},
    {"work zero of the rotary axes", explains_path, [](S s) { return of(s.origin_deg); },
     [](S s) { return vector_text("rotary work zero", s.origin_deg); }},
    modal<1>("motion", explains_path),
    modal<13>("surface speed", explains_speed),
    {"spindle", explains_speed,
     [](S s) { return Values{static_cast<double>(s.spindle_direction)}; },
     [](S s) {
         return std::string(s.spindle_direction > 0 ? "M3" : s.spindle_direction < 0 ? "M4" : "M5");
     }},
    {"speed", explains_speed, [](S s) { return Values{s.speed}; },
     [](S s) { return fmt::format("S{:g}", s.speed); }},
    {"coolant", explains_coolant, [](S s) { return Values{static_cast<double>(s.coolant)}; },
     [](S s) { return std::string(s.coolant != 0 ? "M8" : "M9"); }},
    {"feed", explains_feed, [](S s) { return Values{s.feed}; },
     [](S s) { return fmt::format("F{:g}", s.feed); }},
};

}  // namespace

std::span<const SnapshotField> snapshot_fields() {
    return fields;
}

}  // namespace trunnion::regression
