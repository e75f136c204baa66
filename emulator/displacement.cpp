#include "emulator/displacement.h"

#include "base/alarm.h"

namespace trunnion::emulator {
namespace {

/// The tool frame seen from the table.
Pose pose_WS(const kinematics::MachinePose& poses) {
    return poses.pose_MW.inverse() * poses.pose_MS;
}

/// Rotation vector of a rotation, rad.
Vector3 rotation_vector(const Matrix3& r) {
    const Eigen::AngleAxisd turn(r);
    return turn.angle() * turn.axis();
}

/// The declared position of the target on the tool. For a target on the table it is zero: only the
/// displacement of the tool counts.
Vector3 declared_S_mm(const setup::Setup& setup, const setup::Artefact& target) {
    return target.tool_S_mm ? setup.target_S_mm(target) : Vector3(Vector3::Zero());
}

}  // namespace

double linear_mm(const InstrumentView& view) {
    const auto k = static_cast<std::size_t>(view.contact.artefact);
    const setup::Artefact& target = view.setup.artefacts[k];
    const Vector3 declared = declared_S_mm(view.setup, target);
    Vector3 place = declared + target.found_mm + view.state.extra.tip_shift_mm;
    if (k < view.offsets.artefact.size()) place += view.offsets.artefact[k];
    const Vector3 moved_W_mm =
        pose_WS(view.state.poses) * place - view.contact.believed_WS * declared;
    return view.contact.direction_W.dot(moved_W_mm - view.state.extra.work_shift_mm) +
           view.state.extra.reading_mm;
}

double angle_rad(const InstrumentView& view) {
    const Matrix3 turned =
        pose_WS(view.state.poses).rotation * view.contact.believed_WS.rotation.transpose();
    return view.contact.direction_W.dot(rotation_vector(turned));
}

double encoder_mm(const InstrumentView& view) {
    const std::size_t k = index_of(view.contact.axis);
    return view.state.extra.axis[view.contact.axis] + view.setup.encoder_zero[k] +
           view.offsets.encoder_zero[k];
}

void aim_at_displacement(const setup::Setup& setup, const records::Reading& row, Contact& contact) {
    contact.instrument = instrument_of_row(setup, row);
    contact.believed_WS =
        pose_WS(kinematics::Machine{setup.machine.chain, {}}.poses(row.commanded));
}

void aim_at_encoder(const setup::Setup& setup, const records::Reading& row, Contact& contact) {
    contact.instrument = instrument_of_row(setup, row);
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (axis.name == row.feature) {
            contact.axis = axis.axis;
            contact.scale_encoder = setup.scale_encoder[index_of(axis.axis)];
            return;
        }
    throw InputError("the machine has no axis '" + row.feature + "'");
}

}  // namespace trunnion::emulator
