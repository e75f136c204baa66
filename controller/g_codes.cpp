#include "controller/g_codes.h"

#include <array>
#include <cmath>

namespace trunnion::controller {

namespace {

using enum ModalGroup;

constexpr GCode table[] = {
    {0, motion, Phase::motion, Action::sets_group, "rapid positioning"},
    {10, motion, Phase::motion, Action::sets_group, "linear interpolation"},
    {20, motion, Phase::motion, Action::sets_group, "circular interpolation clockwise"},
    {30, motion, Phase::motion, Action::sets_group, "circular interpolation counter-clockwise"},
    {40, one_shot, Phase::shot, Action::dwell, "dwell"},
    {41, one_shot, Phase::reading, Action::accepted, "stop of the reading ahead"},
    {50, one_shot, Phase::shot, Action::accepted, "high-speed machining, G5 P10000 / P0"},
    {51, one_shot, Phase::shot, Action::accepted, "AI contour control"},
    {54, one_shot, Phase::shot, Action::accepted, "high response vector control"},
    {71, one_shot, Phase::shot, Action::cylinder, "cylindrical interpolation"},
    {80, one_shot, Phase::shot, Action::accepted, "look-ahead control"},
    {90, one_shot, Phase::reading, Action::exact_stop, "exact stop"},
    {100, one_shot, Phase::shot, Action::data_setting, "programmable data input"},
    {110, one_shot, Phase::reading, Action::data_setting_end, "end of data input"},
    {121, polar_motion, Phase::shot, Action::polar_motion, "polar coordinate interpolation"},
    {131, polar_motion, Phase::shot, Action::polar_motion, "polar coordinate interpolation off"},
    {150, polar_words, Phase::reading, Action::sets_group, "polar coordinate words off"},
    {160, polar_words, Phase::reading, Action::polar_words, "polar coordinate words"},
    {170, plane, Phase::plane, Action::plane, "XY plane"},
    {180, plane, Phase::plane, Action::plane, "ZX plane"},
    {190, plane, Phase::plane, Action::plane, "YZ plane"},
    {200, units, Phase::units, Action::units, "inch"},
    {210, units, Phase::units, Action::units, "mm"},
    {220, stored_stroke, Phase::shot, Action::accepted,
     "stored stroke check on; the zone of its words is not checked"},
    {230, stored_stroke, Phase::reading, Action::sets_group, "stored stroke check off"},
    {250, one_shot, Phase::shot, Action::accepted, "spindle speed fluctuation detection off"},
    {260, one_shot, Phase::shot, Action::accepted, "spindle speed fluctuation detection"},
    {270, one_shot, Phase::shot, Action::reference_check, "reference position check"},
    {280, one_shot, Phase::shot, Action::reference, "to the reference position"},
    {290, one_shot, Phase::shot, Action::from_reference, "from the reference position"},
    {300, one_shot, Phase::shot, Action::reference, "to the 2nd to 4th reference position"},
    {310, one_shot, Phase::shot, Action::skip, "skip function"},
    {330, motion, Phase::motion, Action::thread, "thread cutting"},
    {370, one_shot, Phase::shot, Action::tool_measurement, "automatic tool length measurement"},
    {390, one_shot, Phase::shot, Action::corner_arc, "corner arc of cutter compensation"},
    {400, cutter, Phase::offsets, Action::cutter, "cutter compensation off"},
    {401, one_shot, Phase::reading, Action::accepted, "normal direction control off"},
    {410, cutter, Phase::offsets, Action::cutter, "cutter compensation, tool left"},
    {412, cutter, Phase::offsets, Action::five_axis_cutter,
     "cutter compensation for five axes, left"},
    {413, cutter, Phase::offsets, Action::five_axis_cutter, "leading edge offset for five axes"},
    {414, cutter, Phase::offsets, Action::five_axis_cutter, "the same as G41.2, type 2"},
    {415, cutter, Phase::offsets, Action::five_axis_cutter, "the same for table machines, type 1"},
    {416, cutter, Phase::offsets, Action::five_axis_cutter, "the same for mixed machines"},
    {420, cutter, Phase::offsets, Action::cutter, "cutter compensation, tool right"},
    {422, cutter, Phase::offsets, Action::five_axis_cutter,
     "cutter compensation for five axes, right"},
    {424, cutter, Phase::offsets, Action::five_axis_cutter, "the same as G42.2, type 2"},
    {425, cutter, Phase::offsets, Action::five_axis_cutter, "the same for table machines, type 1"},
    {426, cutter, Phase::offsets, Action::five_axis_cutter, "the same for mixed machines"},
    {430, length, Phase::offsets, Action::tool_length, "tool length compensation +"},
    {434, length, Phase::offsets, Action::tool_centre, "tool centre point control, rotary words"},
    {435, length, Phase::offsets, Action::tool_centre,
     "tool centre point control, tool axis vector"},
    {440, length, Phase::offsets, Action::tool_length, "tool length compensation -"},
    {450, one_shot, Phase::reading, Action::position_offset, "move longer by the offset"},
    {460, one_shot, Phase::reading, Action::position_offset, "move shorter by the offset"},
    {470, one_shot, Phase::reading, Action::position_offset, "move longer by twice the offset"},
    {480, one_shot, Phase::reading, Action::position_offset, "move shorter by twice the offset"},
    {490, length, Phase::offsets, Action::tool_length, "tool length compensation off"},
    {500, scaling, Phase::frame, Action::scaling_off, "scaling off"},
    {501, mirror, Phase::shot, Action::mirror_off, "programmable mirror image off"},
    {510, scaling, Phase::shot, Action::scaling, "scaling"},
    {511, mirror, Phase::shot, Action::mirror, "programmable mirror image"},
    {520, one_shot, Phase::shot, Action::local_shift, "local coordinate system"},
    {530, one_shot, Phase::shot, Action::machine_position, "machine coordinate position"},
    {531, one_shot, Phase::shot, Action::tool_axis, "tool axis along the tilted plane's normal"},
    {536, one_shot, Phase::shot, Action::tool_axis_keeping_tip, "the same with the tip kept"},
    {540, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 1"},
    {541, work_offset, Phase::work_offset, Action::work_offset, "additional work coordinates"},
    {542, fixture, Phase::work_offset, Action::fixture_offset, "dynamic fixture offset"},
    {550, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 2"},
    {560, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 3"},
    {570, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 4"},
    {580, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 5"},
    {590, work_offset, Phase::work_offset, Action::work_offset, "work coordinate system 6"},
    {600, one_shot, Phase::shot, Action::single_direction, "single direction positioning"},
    {610, path_mode, Phase::reading, Action::sets_group, "exact stop mode"},
    {620, path_mode, Phase::reading, Action::sets_group, "automatic corner override"},
    {630, path_mode, Phase::reading, Action::sets_group, "tapping mode"},
    {640, path_mode, Phase::reading, Action::sets_group, "cutting mode"},
    {680, rotation, Phase::shot, Action::rotation, "coordinate rotation"},
    {682, rotation, Phase::shot, Action::tilted_plane, "tilted working plane"},
    {683, rotation, Phase::shot, Action::tilted_plane_by_tool,
     "tilted working plane by the tool axis"},
    {684, rotation, Phase::shot, Action::tilted_plane, "tilted working plane, incremental"},
    {690, rotation, Phase::frame, Action::rotation_cancel, "rotation, tilted plane off"},
    {730, ModalGroup::cycle, Phase::cycle, Action::cycle, "pecking with chip breaking"},
    {740, ModalGroup::cycle, Phase::cycle, Action::cycle, "left-hand tapping"},
    {760, ModalGroup::cycle, Phase::cycle, Action::cycle, "fine boring"},
    {810, ModalGroup::cycle, Phase::cycle, Action::cycle, "drilling"},
    {820, ModalGroup::cycle, Phase::cycle, Action::cycle, "drilling with dwell"},
    {830, ModalGroup::cycle, Phase::cycle, Action::cycle, "pecking"},
    {840, ModalGroup::cycle, Phase::cycle, Action::cycle, "tapping"},
    {842, ModalGroup::cycle, Phase::cycle, Action::cycle, "rigid tapping, format FS10/11"},
    {843, ModalGroup::cycle, Phase::cycle, Action::cycle, "the same, left-hand"},
    {850, ModalGroup::cycle, Phase::cycle, Action::cycle, "boring, feed out"},
    {860, ModalGroup::cycle, Phase::cycle, Action::cycle, "boring, rapid out"},
    {870, ModalGroup::cycle, Phase::cycle, Action::cycle, "back boring"},
    {880, ModalGroup::cycle, Phase::cycle, Action::cycle, "boring, stop"},
    {890, ModalGroup::cycle, Phase::cycle, Action::cycle, "boring with dwell, feed out"},
    {800, cycle, Phase::reading, Action::sets_group, "canned cycle off"},
    {900, distance, Phase::reading, Action::sets_group, "absolute words"},
    {910, distance, Phase::reading, Action::sets_group, "incremental words"},
    {911, one_shot, Phase::reading, Action::accepted, "incremental arc centres"},
    {920, one_shot, Phase::shot, Action::preset, "setting of the work coordinates"},
    {921, one_shot, Phase::shot, Action::preset_cancel, "preset of the work coordinates"},
    {930, feed_mode, Phase::feed, Action::feed_mode, "inverse time feed"},
    {940, feed_mode, Phase::feed, Action::feed_mode, "feed per minute"},
    {950, feed_mode, Phase::feed, Action::feed_mode, "feed per turn"},
    {960, surface_speed, Phase::speed, Action::speed_mode, "constant surface speed"},
    {970, surface_speed, Phase::speed, Action::speed_mode, "constant surface speed off"},
    {980, cycle_return, Phase::reading, Action::sets_group, "cycle returns to the initial level"},
    {990, cycle_return, Phase::reading, Action::sets_group, "cycle returns to level R"},
};

constexpr int highest_code10 = 10000;

/// Other spellings of a code.
struct Alias {
    int code10, means10;
};
constexpr Alias aliases[] = {{1070, 71}, {1120, 121}, {1130, 131}, {1500, 401}};

/// Row of each code * 10, or -1.
std::array<std::int16_t, highest_code10> make_index() {
    std::array<std::int16_t, highest_code10> index;
    index.fill(-1);
    for (std::size_t i = 0; i < std::size(table); ++i)
        index[static_cast<std::size_t>(table[i].code10)] = static_cast<std::int16_t>(i);
    for (const Alias& alias : aliases)
        index[static_cast<std::size_t>(alias.code10)] =
            index[static_cast<std::size_t>(alias.means10)];
    return index;
}
const std::array<std::int16_t, highest_code10> row_of = make_index();

}  // namespace

const GCode* find_g_code(double value) {
    const double tenfold = value * 10.0;
    if (!(tenfold >= 0.0) || tenfold > highest_code10 - 1) return nullptr;
    const int code10 = static_cast<int>(tenfold + 0.5);
    if (std::abs(tenfold - code10) > 1e-6) return nullptr;
    const int row = row_of[static_cast<std::size_t>(code10)];
    return row < 0 ? nullptr : &table[row];
}

}  // namespace trunnion::controller
