#include "controller/frames.h"

#include <algorithm>

#include "controller/alarms.h"
#include "offsets/axis_numbers.h"

namespace trunnion::controller {

namespace {

std::vector<Axis> axis_order(const ControlSettings& settings) {
    std::vector<Axis> order;
    for (const ControlAxis& axis : settings.axes) order.push_back(axis.axis);
    return order;
}

positioning::RotaryTravel::Range travel_of(const ControlSettings& settings,
                                           const offsets::PivotAxis& axis) {
    positioning::RotaryTravel::Range range{axis.min_rad, axis.max_rad};
    for (const ControlAxis& entry : settings.axes) {
        if (axis.hypothetical || entry.axis != axis.axis) continue;
        if (entry.min) range.min_rad = std::max(*entry.min, range.min_rad.value_or(*entry.min));
        if (entry.max) range.max_rad = std::min(*entry.max, range.max_rad.value_or(*entry.max));
    }
    return range;
}

}  // namespace

bool same_rotaries(const AxisPositions& a, const AxisPositions& b) {
    return a[Axis::A] == b[Axis::A] && a[Axis::B] == b[Axis::B] && a[Axis::C] == b[Axis::C];
}

void Frames::parameters_changed(const ControlSettings& settings) {
    const std::vector<Axis> order = axis_order(settings);
    believed = {};
    try {
        if (const auto pivot = offsets::decode_pivot(stores_.parameters, order))
            believed.transform.emplace(*pivot);
    } catch (const Alarm& alarm) {
        believed.fault = alarm;
    }
    believed.parallel = offsets::parallel_axes(stores_.parameters, order);
}

const positioning::RotaryTransform& Frames::transform(int otherwise) const {
    if (believed.fault) throw Alarm(*believed.fault);
    if (!believed.transform) raise_alarm(otherwise, "(No.19680 is 0)");
    return *believed.transform;
}

positioning::RotaryTravel Frames::rotary_travel(const ControlSettings& settings) const {
    const offsets::PivotParameters& pivot = believed.transform->pivot();
    return {travel_of(settings, pivot.first), travel_of(settings, pivot.second)};
}

PositioningMode Frames::mode(const ControlSettings& settings) const {
    if (tip.in_force || tip.starting) return PositioningMode::rtcp;
    if (plane) return PositioningMode::tw;
    if (fixture_number != 0) return PositioningMode::rtdfo;
    return settings.has_rotary_axis ? PositioningMode::dpp : PositioningMode::none;
}

void Frames::recompute() {
    stages.compile();
    program = program_at(machine);
}

offsets::ControlPosition Frames::program_at(
    const offsets::ControlPosition& machine_position) const {
    if (!tip.in_force) return stages.program_from_machine(machine_position);
    offsets::ControlPosition staged = machine_position;
    offsets::set_xyz(staged,
                     tip.in_force->programmed_tip_M(offsets::axis_positions_of(machine_position)) +
                         offsets::xyz_of(stages.length));
    return stages.program_from_machine(staged);
}

void Frames::take_work_offset(const Modal& modal) {
    const offsets::WorkOffsets& work = stores_.work;
    const int code = modal.codes[ModalGroup::work_offset];
    stages.external = work.external;
    stages.work = code == 541 ? work.additional[static_cast<std::size_t>(modal.number.work - 1)]
                              : work.standard[static_cast<std::size_t>(code / 10 - 54)];
    if (plane) place_plane();
}

void Frames::stand_at(const offsets::ControlPosition& machine_position) {
    machine = machine_position;
    axes = offsets::axis_positions_of(machine);
    if (plane) place_plane();
    recompute();
}

Vector3 Frames::origin_of_work() const {
    Coordinates plain = stages;
    plain.feature_MF.reset();
    return offsets::xyz_of(plain.work_origin()) + offsets::xyz_of(plain.plane_local);
}

void Frames::place_plane() {
    plane->latched = axes;
    Pose pose_MP = Pose::shift(origin_of_work());
    if (believed.transform) pose_MP = believed.transform->pose_MW(axes) * pose_MP;
    stages.feature_MF = pose_MP * plane->pose_PF;
    stages.length = staged_length(stages.length);
}

offsets::ControlPosition Frames::staged_length(offsets::ControlPosition plain) const {
    if (!plane) return plain;
    offsets::set_xyz(plain, tool.vector_mm);
    if (!believed.transform) return plain;
    const AxisPositions& there = plane->latched;
    offsets::set_xyz(plain, believed.parallel.linear(there) -
                                believed.transform->pose_MW(there) *
                                    believed.transform->tip_W(there, tool.vector_mm));
    return plain;
}

offsets::ControlPosition Frames::shown_length() const {
    offsets::ControlPosition length = stages.length;
    if (plane) offsets::set_xyz(length, tool.vector_mm);
    return length;
}

const positioning::FixtureSettings& Frames::fixture_settings(const ControlSettings& settings) {
    if (!believed.fixture)
        believed.fixture =
            positioning::decode_fixture_settings(stores_.parameters, axis_order(settings));
    return *believed.fixture;
}

bool Frames::turn_fixture(const ControlSettings& settings,
                          const offsets::ControlPosition& machine_position) {
    if (fixture_number == 0) return false;
    const auto& set = stores_.fixture.set[static_cast<std::size_t>(fixture_number - 1)];
    const offsets::ControlPosition vector =
        positioning::turned_fixture_offset(fixture_settings(settings), set, machine_position);
    if (vector == stages.fixture) return false;
    stages.fixture = vector;
    return true;
}

void Frames::follow_fixture(const ControlSettings& settings,
                            const offsets::ControlPosition& target) {
    if (fixture_number == 0 || stores_.parameters.bit(7570, 0)) return;
    if (turn_fixture(settings, stages.machine_from_program(target))) stages.compile();
}

}  // namespace trunnion::controller
