#include "emulator/observer.h"

#include <cmath>

#include "kinematics/tool_sense.h"

namespace trunnion::emulator {
namespace {

constexpr double root_mm = 1e-11;
constexpr int most_steps = 12;

/// Moves the sample along the direction of the touch: X Y Z, as far as the machine has them.
void move_along(const kinematics::Chain& chain, double way_mm, AxisSample& sample,
                Contact& contact) {
    contact.along_mm += way_mm;
    const Vector3 way = way_mm * kinematics::tool_senses(chain).cwiseProduct(contact.direction_M);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (chain.find(axis))
            sample.position[axis] += way(static_cast<Eigen::Index>(index_of(axis)));
}

}  // namespace

Observer::Observer(const setup::Setup& setup, const kinematics::Machine& machine,
                   EffectModels effects, ReplayOffsets offsets)
    : setup_(setup), model_(machine), effects_(std::move(effects)), offsets_(std::move(offsets)) {}

PhysicalState Observer::at(const AxisSample& sample, const Contact& contact) const {
    PhysicalState state;
    for (const auto& effect : effects_) effect->perturb(sample, contact, state.extra);
    state.poses = model_.poses(sample.position, state.extra, spindle_angle(sample));
    return state;
}

kinematics::MachinePose Observer::nominal(const AxisSample& sample) const {
    return model_.poses(sample.position, spindle_angle(sample));
}

double Observer::read(const AxisSample& sample, const Contact& contact) const {
    if (contact.device == records::Device::touch) return touch(sample, contact).value_mm;
    return reading_mm(view(contact, at(sample, contact)));
}

Vector3 Observer::centre_to_tip_M(const AxisSample& sample, const Contact& contact) const {
    return emulator::centre_to_tip_M(view(contact, at(sample, contact)));
}

double Observer::reach_mm(const Contact& contact) const {
    const auto k = static_cast<std::size_t>(contact.artefact);
    return 0.5 * (setup_.artefacts[k].diameter_mm + setup_.probe->ball_diameter_mm);
}

void Observer::go_to_contact(AxisSample& sample, Contact& contact) const {
    const double to_mm = touch(sample, contact).contact_mm;
    move_along(setup_.machine.chain, to_mm - contact.along_mm, sample, contact);
}

TouchReading Observer::touch(const AxisSample& sample, const Contact& contact) const {
    AxisSample here = sample;
    Contact there = contact;
    TouchReading result;
    const auto look = [&](double along_mm) {
        move_along(setup_.machine.chain, along_mm - there.along_mm, here, there);
        const PhysicalState state = at(here, there);
        const probe::WayToSphere way = way_to_contact(view(there, state));
        result = {along_mm + way.way_mm, along_mm + way.way_mm + state.extra.reading_mm, way.meets};
        return way.way_mm;
    };
    double first_mm = 0.0;
    for (int i = 0; i < most_steps; ++i) {
        const double left_mm = look(i == 0 ? contact.along_mm : result.contact_mm);
        if (std::abs(left_mm) < root_mm) return result;
        if (i == 0) first_mm = result.contact_mm;
    }
    if (!result.meets) return result;  // no contact on this line: nothing to bracket
    // Effects with steps (rounding to an increment): bisection of a bracket about the first
    // estimate.
    double reach_mm = 0.1;
    while (reach_mm < 100.0 &&
           !(look(first_mm - reach_mm) > 0.0 && look(first_mm + reach_mm) <= 0.0))
        reach_mm *= 2.0;
    double before = first_mm - reach_mm, after = first_mm + reach_mm;
    while (after - before > 10.0 * root_mm) {
        const double middle = 0.5 * (before + after);
        (look(middle) > 0.0 ? before : after) = middle;
    }
    look(after);
    result.value_mm += after - result.contact_mm;
    result.contact_mm = after;
    return result;
}

}  // namespace trunnion::emulator
