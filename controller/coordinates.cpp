#include "controller/coordinates.h"

namespace trunnion::controller {

namespace {

offsets::ControlPosition ones() {
    offsets::ControlPosition p;
    p.value.fill(1.0);
    return p;
}

/// Appends the stage centre + f (p' - centre) to the map p' = factor p + shift.
void follow(const Coordinates::AxisFactor& stage, offsets::ControlPosition& factor,
            offsets::ControlPosition& shift) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double f = stage.factor.value[i];
        factor.value[i] *= f;
        shift.value[i] = f * shift.value[i] + (1.0 - f) * stage.centre.value[i];
    }
}

offsets::ControlPosition sum(const offsets::ControlPosition& a, const offsets::ControlPosition& b) {
    offsets::ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = a.value[i] + b.value[i];
    return out;
}

}  // namespace

offsets::ControlPosition Coordinates::work_origin() const {
    offsets::ControlPosition origin = sum(sum(preset, work), sum(external, fixture));
    return feature_MF ? sum(origin, plane_local) : origin;
}

void Coordinates::compile() {
    factor_ = ones();
    shape_shift_ = {};
    if (mirror) follow(*mirror, factor_, shape_shift_);
    if (scaling) follow(*scaling, factor_, shape_shift_);
    shape_ = offsets::xyz_of(factor_).asDiagonal();
    if (rotation) {
        const Matrix3 turn = rotation_about(rotation->axis, rad_from_deg(rotation->angle_deg));
        shape_ = turn * shape_;
        offsets::set_xyz(shape_shift_, turn * (offsets::xyz_of(shape_shift_) - rotation->centre) +
                                           rotation->centre);
    }
    linear_ = shape_;
    total_ = sum(sum(shape_shift_, local), work_origin());
    if (feature_MF) {
        linear_ = feature_MF->rotation * shape_;
        offsets::set_xyz(total_,
                         *feature_MF * (offsets::xyz_of(shape_shift_) + offsets::xyz_of(local)));
    }
    total_ = sum(total_, length);
    is_shift_ = linear_.isIdentity(0.0) && factor_ == ones();
    inverse_ = is_shift_ ? Matrix3::Identity() : Matrix3(linear_.inverse());
}

offsets::ControlPosition Coordinates::machine_general(
    const offsets::ControlPosition& program) const {
    offsets::ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = factor_.value[i] * program.value[i] + total_.value[i];
    offsets::set_xyz(out, linear_ * offsets::xyz_of(program) + offsets::xyz_of(total_));
    return out;
}

offsets::ControlPosition Coordinates::program_from_machine(
    const offsets::ControlPosition& machine) const {
    offsets::ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = (machine.value[i] - total_.value[i]) / factor_.value[i];
    if (!is_shift_)
        offsets::set_xyz(out, inverse_ * (offsets::xyz_of(machine) - offsets::xyz_of(total_)));
    return out;
}

offsets::ControlPosition Coordinates::shaped_from_program(
    const offsets::ControlPosition& program) const {
    offsets::ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = factor_.value[i] * program.value[i] + shape_shift_.value[i];
    offsets::set_xyz(out, shape_ * offsets::xyz_of(program) + offsets::xyz_of(shape_shift_));
    return out;
}

}  // namespace trunnion::controller
