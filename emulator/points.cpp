#include "emulator/points.h"

#include "base/alarm.h"
#include "geometry/pose.h"

namespace trunnion::emulator {
namespace {

/// Position of a target: in M, or relative to the table when the instrument is set so, mm.
Vector3 seen_mm(const setup::Artefact& target, const Vector3& place_mm,
                const kinematics::MachinePose& poses, const setup::Instrument& instrument) {
    const Vector3 p_M_mm = (target.tool_S_mm ? poses.pose_MS : poses.pose_MW) * place_mm;
    return instrument.sees_table ? poses.pose_MW.inverse() * p_M_mm : p_M_mm;
}

/// Position in S for a target on the tool, else in W.
Vector3 place_mm(const setup::Setup& setup, const setup::Artefact& target) {
    return target.tool_S_mm ? setup.target_S_mm(target) : target.center_W_mm;
}

/// The instrument of the setup with the fit's corrections; without an [[instrument]] one at M.
setup::Instrument instrument_of(const InstrumentView& view) {
    if (view.contact.instrument < 0) return {};
    const auto k = static_cast<std::size_t>(view.contact.instrument);
    setup::Instrument instrument = view.setup.instruments[k];
    if (k < view.offsets.instruments.size()) {
        instrument.pose_error += view.offsets.instruments[k].pose;
        instrument.scale_error += view.offsets.instruments[k].scale;
    }
    return instrument;
}

}  // namespace

double point_mm(const InstrumentView& view) {
    const auto k = static_cast<std::size_t>(view.contact.artefact);
    const setup::Artefact& target = view.setup.artefacts[k];
    Vector3 place = place_mm(view.setup, target) + target.found_mm;
    place += target.tool_S_mm ? view.state.extra.tip_shift_mm : view.state.extra.work_shift_mm;
    if (k < view.offsets.artefact.size()) place += view.offsets.artefact[k];
    const setup::Instrument instrument = instrument_of(view);
    const Vector3 measured_I_mm =
        instrument.read_mm(seen_mm(target, place, view.state.poses, instrument));
    return view.contact.direction_I.dot(measured_I_mm - view.contact.commanded_I_mm) +
           view.state.extra.reading_mm;
}

void aim_at_point(const setup::Setup& setup, const records::Reading& row, Contact& contact) {
    if (row.instrument.empty() && setup.instruments.size() > 1)
        throw InputError("a point row without an instrument, and the setup has several");
    contact.instrument = instrument_of_row(setup, row);
    const setup::Instrument instrument =
        contact.instrument < 0 ? setup::Instrument{}
                               : setup.instruments[static_cast<std::size_t>(contact.instrument)];
    const setup::Artefact& target = setup.artefacts[static_cast<std::size_t>(contact.artefact)];
    const kinematics::MachinePose believed =
        kinematics::Machine{setup.machine.chain, {}}.poses(row.commanded);
    const Pose pose_IM = instrument.pose_IM();
    contact.direction_I = row.direction_M;
    contact.commanded_I_mm =
        pose_IM * seen_mm(target, place_mm(setup, target), believed, instrument);
    const Matrix3 turn = rotation_of(instrument.pose_error.tilt_rad);
    contact.turned_I_mm = turn * contact.commanded_I_mm;
    contact.direction_M = pose_IM.rotation.transpose() * (turn.transpose() * row.direction_M);
    if (instrument.sees_table)
        contact.direction_M = believed.pose_MW.rotation * contact.direction_M;
}

}  // namespace trunnion::emulator
