// The only access to the physical machine: poses of its bodies and readings of its devices, with
// errors and effects. Used by run, predict, identify, diagnose, compensate, volumetric and --truth.
#pragma once

#include "emulator/instruments.h"
#include "kinematics/forward.h"

namespace trunnion::emulator {

/// Spindle angle for the errors of the spindle; empty while it turns.
inline kinematics::SpindleAngle spindle_angle(const AxisSample& sample) {
    return sample.spindle_turns ? std::nullopt : kinematics::SpindleAngle(sample.spindle_rad);
}

/// A touch of a sphere on a straight line through the commanded end point.
struct TouchReading {
    double contact_mm = 0.0;  ///< contact of ball and sphere: signed distance from the end along
                              ///< the direction
    double value_mm = 0.0;    ///< position where the skip signal latches: later than the contact by
                              ///< the probe's pretravel
    bool meets = true;        ///< false: the line misses the sphere
};

/// Noise-free. Smooth in the setup as far as the effects are smooth. Same sample and contact give
/// the same reading.
class Observer {
  public:
    /// `setup` must outlive the observer; `machine` and `offsets` may differ from it (in a fit).
    Observer(const setup::Setup& setup, const kinematics::Machine& machine, EffectModels effects,
             ReplayOffsets offsets = {});
    Observer(const setup::Setup& setup, EffectModels effects)
        : Observer(setup, setup.machine, std::move(effects)) {}

    const setup::Setup& setup() const { return setup_; }
    /// State of the machine at a sample; the contact defines the device.
    PhysicalState at(const AxisSample& sample, const Contact& contact) const;
    /// The machine with its errors but without effects.
    kinematics::MachinePose nominal(const AxisSample& sample) const;
    /// Reading of the contact's device, mm (rad for angular rows).
    double read(const AxisSample& sample, const Contact& contact) const;
    /// Solves for the contact along the line, with the effects evaluated at the contact position.
    /// Accuracy: 1e-11 mm when the effects change by less than the distance moved (fixed-point
    /// iteration), else 1e-10 mm (bisection, for effects with steps). The sample may be anywhere on
    /// the line (`contact.along_mm`).
    TouchReading touch(const AxisSample& sample, const Contact& contact) const;
    /// Moves sample and contact to that position.
    void go_to_contact(AxisSample& sample, Contact& contact) const;
    /// From the centre of the contact's sphere to the stylus ball (M, mm), and its length at
    /// contact.
    Vector3 centre_to_tip_M(const AxisSample& sample, const Contact& contact) const;
    double reach_mm(const Contact& contact) const;

  private:
    InstrumentView view(const Contact& contact, const PhysicalState& state) const {
        return {setup_, offsets_, contact, state};
    }

    const setup::Setup& setup_;
    kinematics::ForwardModel model_;
    EffectModels effects_;
    ReplayOffsets offsets_;
};

}  // namespace trunnion::emulator
