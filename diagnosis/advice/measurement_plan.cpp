#include "diagnosis/advice/measurement_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace trunnion::diagnosis {
namespace {

constexpr double move_s = 2.0;

std::string with(std::string text, char from, char to) {
    std::replace(text.begin(), text.end(), from, to);
    return text;
}

}  // namespace

double plan_rounded(double v, double step) {
    const double r = std::round(v / step) * step;
    return r == 0.0 ? 0.0 : r;  // no -0
}

MeasurementPlan::MeasurementPlan(const setup::Setup& setup, std::string name, std::string text,
                                 double start_s)
    : setup_(setup), time_s_(start_s), start_s_(start_s) {
    result_.name = std::move(name);
    result_.text = std::move(text);
    result_.table.path = "measurement " + result_.name;
    result_.table.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
        result_.table.axes.push_back(axis.axis);
        if (axis.rotary) rotary_.push_back(axis);
    }
    for (const setup::Artefact& a : setup.artefacts) {
        if (a.kind == setup::Artefact::Kind::sphere) spheres_.push_back(a);
        if (a.kind == setup::Artefact::Kind::center_pivot) pivots_.push_back(a);
    }
    state_.test = result_.name;
    result_.table.side_before = setup.side_before;
}

std::pair<double, double> MeasurementPlan::range_deg(std::size_t k) const {
    if (k > 0) return {0.0, 360.0};
    const kinematics::AxisGeometry& axis = rotary_[k];
    const double low = axis.min ? deg_from_rad(*axis.min) + 8.0 : -80.0;
    const double high = axis.max ? deg_from_rad(*axis.max) - 8.0 : 80.0;
    return {std::max(-80.0, low), std::min(80.0, high)};
}

void MeasurementPlan::tell(const std::string& words) {
    result_.program += "DPRNT[" + with(words, ' ', '*') + "]\n";
}

void MeasurementPlan::stop(const std::string& what) {
    result_.program += "M0 (" + what + ")\n";
    if (std::find(stops_.begin(), stops_.end(), what) == stops_.end()) stops_.push_back(what);
}

void MeasurementPlan::spindle(double degrees) {
    state_.spindle_rad = rad_from_deg(degrees);
    go_clear();
    stop(fmt::format("TURN THE SPINDLE TO {:.0f} DEG AND HOLD IT", degrees));
    tell(fmt::format("SPINDLE {:.0f}", degrees));
}

void MeasurementPlan::load(double kilograms) {
    state_.load_kg = kilograms;
    go_clear();
    stop(fmt::format("PUT {:.0f} KG ON THE TABLE, NEAR ITS CENTRE", kilograms));
    tell(fmt::format("LOAD {:.0f}", kilograms));
    time_s_ += 300.0;
}

void MeasurementPlan::temperature(double celsius) {
    state_.temperature_c = celsius;
    go_clear();
    stop(fmt::format("WARM THE MACHINE TO {:.0f} C", celsius));
    tell(fmt::format("TEMPERATURE {:.0f}", celsius));
    time_s_ += 1800.0;
}

void MeasurementPlan::extension(double longer_mm) {
    state_.extension_mm = longer_mm;
    go_clear();
    stop(fmt::format("MOUNT A STYLUS OR CUP {:.0f} MM LONGER", longer_mm));
    tell(fmt::format("EXTENSION {:.0f}", longer_mm));
    time_s_ += 300.0;
}

void MeasurementPlan::wait(double seconds) {
    go_clear();
    time_s_ += seconds;
    result_.program += fmt::format("G4 X{:.0f}.\n", seconds);
}

AxisPositions MeasurementPlan::rotary_at(const std::vector<double>& angles_deg,
                                         double back_deg) const {
    AxisPositions at;
    for (std::size_t k = 0; k < rotary_.size(); ++k)
        at[rotary_[k].axis] = rad_from_deg(plan_rounded(angles_deg[k] - back_deg, 1e-4));
    return at;
}

/// Linear axes that put `tip_S` on a point of the table.
MeasurementPlan::Target MeasurementPlan::aim(const AxisPositions& rotary, const Vector3& target_W,
                                             const Vector3& tip_S) const {
    Target target{rotary, true};
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) target.at[axis] = 0.0;
    const kinematics::MachinePose poses = setup_.machine.poses(target.at);
    const Vector3 gauge = poses.pose_MW * target_W - poses.pose_MS * tip_S;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        target.at[axis] = plan_rounded(gauge(static_cast<int>(index_of(axis))), 1e-4);
    for (const kinematics::AxisGeometry& axis : setup_.machine.chain.axes()) {
        const double room_mm = axis.rotary ? 0.0 : axis.axis == Axis::Z ? sphere_start_mm : 25.0;
        const double q = target.at[axis.axis];
        if ((axis.min && q - (axis.axis == Axis::Z ? 25.0 : room_mm) < *axis.min) ||
            (axis.max && q + room_mm > *axis.max))
            target.reachable = false;
    }
    return target;
}

std::string MeasurementPlan::words(const AxisPositions& at, bool linear) const {
    std::string line;
    for (const Axis axis : result_.table.axes)
        if (is_rotary(axis) != linear)
            line += fmt::format(" {}{:.4f}", letter_of(axis),
                                plan_rounded(linear ? at[axis] : deg_from_rad(at[axis]), 1e-4));
    return line;
}

std::string MeasurementPlan::all_words(const AxisPositions& at) const {
    return words(at, true) + words(at, false);
}

double MeasurementPlan::clear_mm() const {
    const kinematics::AxisGeometry* z = setup_.machine.chain.find(Axis::Z);
    double reach_mm = 0.0;
    for (const setup::Artefact& a : setup_.artefacts)
        reach_mm = std::max(reach_mm, a.center_W_mm.norm());
    const double wanted =
        plan_rounded(reach_mm + 100.0 - (setup_.probe ? setup_.probe->tip_S_mm.z() : -150.0), 1.0);
    return z->max ? std::min(wanted, *z->max - 1.0) : wanted;
}

/// Tells the PC the axis positions.
void MeasurementPlan::print_place() {
    result_.program += "M98P8102\n";
}

/// A row without device at the axis positions.
void MeasurementPlan::pass_through(const AxisPositions& at) {
    records::Reading row = state_;
    row.commanded = at;
    row.time_s = time_s_ += 0.25 * move_s;
    result_.table.rows.push_back(row);
    last_ = at;
}

void MeasurementPlan::go(const AxisPositions& at, bool linear) {
    AxisPositions to = last_;
    for (const Axis axis : result_.table.axes)
        if (is_rotary(axis) != linear) to[axis] = at[axis];
    result_.program += "G0" + words(to, linear) + '\n';
    print_place();
    pass_through(to);
}

void MeasurementPlan::go_clear() {
    last_[Axis::Z] = clear_mm();
    result_.program += fmt::format("G53 G0 Z{:.4f}\n", last_[Axis::Z]);
    print_place();
    pass_through(last_);
}

void MeasurementPlan::define_sides() {
    go_clear();
    AxisPositions aside, zero;
    for (const Axis axis : result_.table.axes) {
        const kinematics::AxisGeometry& geometry = *setup_.machine.chain.find(axis);
        const double step = geometry.rotary ? rad_from_deg(1.0) : 1.0;
        aside[axis] = geometry.min && *geometry.min > -step ? step : -step;
    }
    aside[Axis::Z] = zero[Axis::Z] = last_[Axis::Z];
    go(aside, false);
    go(zero, false);
    go(aside, true);
    go(zero, true);
}

Measurement MeasurementPlan::done() {
    result_.minutes = (time_s_ - start_s_) / 60.0 + 5.0;  // five minutes for preparation
    result_.program =
        head_text() + result_.program +
        fmt::format("G53 G0 Z{:.4f}\n#149=#0\nDPRNT[MEASUREMENT*END]\nPCLOS\nM30\n%\n", clear_mm());
    int index = 0;
    for (records::Reading& row : result_.table.rows) row.index = index++;
    return std::move(result_);
}

}  // namespace trunnion::diagnosis
