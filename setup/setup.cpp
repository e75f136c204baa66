#include "setup/setup.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/alarm.h"
#include "base/read_file.h"
#include "base/units.h"
#include "setup/control_axes.h"
#include "setup/hurco_keys.h"
#include "setup/setup_reader.h"

namespace trunnion::setup {
namespace {

constexpr Axis linear_xyz[] = {Axis::X, Axis::Y, Axis::Z};

/// Pivot parameters (19680-19714) and G54.2 groups that the file does not give are derived from the
/// machine, as if the control knew its true geometry.
void complete_pivot(Setup& setup, std::vector<std::string>& notes) {
    offsets::Parameters& parameters = setup.stores.parameters;
    const auto given = parameters.entry;
    const std::string reason = derive_pivot_parameters(setup.machine, parameters);
    const auto axes = setup.machine.chain.axes();
    // An axis alone, an arm or a telescope runs no NC program.
    const bool has_rotary = std::any_of(axes.begin(), axes.end(), [](auto& a) { return a.rotary; });
    const bool mills = std::all_of(std::begin(linear_xyz), std::end(linear_xyz), [&](Axis axis) {
        return setup.machine.chain.find(axis) != nullptr;
    });
    if (!reason.empty() && has_rotary && mills && !given.contains(19680))
        notes.push_back(setup.path + ": no pivot parameters 19680-19714: " + reason);
    const std::string alone = derive_parallel_axes(setup.machine, parameters);
    if (!alone.empty())
        notes.push_back(setup.path + ": no parameter 1022 says how " + alone +
                        " runs: the control assumes that it does not move the tool");
    if (const std::string wrong = believe_centrelines(setup, parameters); !wrong.empty())
        throw InputError("[control.hurco]: " + wrong, {setup.path, 0, 0});
    derive_fixture_groups(setup.machine, parameters);
    if (const std::string axes = overcompensated_axes(setup); !axes.empty())
        notes.push_back(setup.path + ": the control compensates backlash or pitch of " + axes +
                        " (1851, 3620 on), which [machine] and [effects] do not have: what it "
                        "adds is an error");
    for (const auto& [number, parameter] : parameters.entry)
        if (!given.contains(number)) ++setup.derived_parameters;
}

}  // namespace

namespace {

Vector3 extended(const Vector3& ball_S_mm, double extension_mm, const ExtensionErrors& errors) {
    if (extension_mm == 0.0) return ball_S_mm;
    const auto it = errors.find(extension_mm);
    const Vector3 below = ball_S_mm - extension_mm * Vector3::UnitZ();
    return it == errors.end() ? below : Vector3(below + it->second);
}

}  // namespace

Vector3 ProbeSettings::tip_with(double extension_mm) const {
    return extended(tip_S_mm, extension_mm, extension_errors);
}

Vector3 BallbarSettings::cup_with(double extension_mm) const {
    return extended(cup_S_mm, extension_mm, extension_errors);
}

const Artefact* Setup::find_artefact(const std::string& wanted) const {
    for (const Artefact& artefact : artefacts)
        if (artefact.name == wanted) return &artefact;
    return nullptr;
}

const Instrument* Setup::find_instrument(const std::string& wanted) const {
    for (const Instrument& instrument : instruments)
        if (instrument.name == wanted) return &instrument;
    return nullptr;
}

Pose Instrument::pose_IM() const {
    const auto turn = [&](Eigen::Index k) {
        return rotation_about(Vector3::Unit(k), rad_from_deg(rotation_deg(k)));
    };
    return {turn(2) * turn(1) * turn(0), origin_mm};
}

Vector3 Instrument::read_mm(const Vector3& p_M_mm) const {
    const Vector3 p_I_mm = (1.0 + scale_error) * (pose_IM() * p_M_mm);
    return pose_error.shift_mm + rotation_of(pose_error.tilt_rad) * p_I_mm;
}

bool is_arm(const kinematics::Chain& chain) {
    const AxisNames names = chain.names();
    return !names.find("X") && !names.find("Y") && !names.find("Z") && !chain.tool.empty() &&
           chain.tool.back().rotary;
}

Vector3 Setup::target_S_mm(const Artefact& target) const {
    const Vector3 from =
        is_arm(machine.chain) ? machine.chain.tool.back().point_mm : Vector3(Vector3::Zero());
    return from + target.tool_S_mm.value_or(Vector3::Zero());
}

Setup load_setup(const std::string& path, std::vector<std::string>& notes,
                 const BackupReader& backup) {
    return parse_setup(read_file(path), path, notes, backup);
}

Setup parse_setup(const std::string& text, const std::string& path, std::vector<std::string>& notes,
                  const BackupReader& backup) {
    const TomlFile file(text, path);
    const TomlValue& root = file.root();
    Setup setup;
    setup.path = path;
    if (const TomlValue* schema = root.find("schema");
        schema && file.text(*schema) != "trunnion.setup/1")
        file.fail(*schema, "this version reads schema \"trunnion.setup/1\"");
    const TomlValue* machine = root.find("machine");
    if (!machine) file.fail(root, "[machine] is missing");
    read_machine(file, file.table(*machine), setup);
    if (const TomlValue* control = root.find("control"))
        read_control(file, file.table(*control), backup, setup);
    read_devices(file, setup);
    complete_pivot(setup, notes);
    for (std::string& note : file.unknown_keys()) notes.push_back(std::move(note));
    return setup;
}

}  // namespace trunnion::setup
