// Interface of an effect for the emulator: an addition to the machine at one reading.
#pragma once

#include <memory>
#include <vector>

#include "kinematics/machine.h"
#include "records/readings.h"

namespace trunnion::emulator {

/// The measurement at one reading: all inputs of effects of probe, ballbar and artefact besides the
/// axis sample. In `run` it is empty while no device reads.
struct Contact {
    records::Device device = records::Device::none;
    int artefact = -1;                      ///< index in Setup::artefacts
    Vector3 direction_M = Vector3::Zero();  ///< component read, approach, or cup to pivot; unit
                                            ///< vector
    Vector3 direction_W = Vector3::Zero();  ///< the same seen from the table
    int instrument = -1;                    ///< point row: index in Setup::instruments, -1 for none
    /// Point row, in the instrument's frame; `turned` by the pose error of the setup.
    Vector3 direction_I = Vector3::Zero(), commanded_I_mm = Vector3::Zero();
    Vector3 turned_I_mm = Vector3::Zero();
    Pose believed_WS;            ///< linear or angle row: pose of the tool in the declared control
    int zero = -1;               ///< such a row: index of its test in Replay::zeros
    Axis axis = Axis::X;         ///< axis row: the axis
    bool scale_encoder = false;  ///< its encoder is behind the drive (linear scale)
    double along_mm = 0.0;       ///< touch: distance along direction_M from the commanded end to
                                 ///< the sample
    int touches = 0;             ///< touches of the pattern behind a sphere row, 0 = unknown
    double extension_mm = 0.0;   ///< additional length of stylus or cup beyond the setup
    bool tip = false;            ///< no device reads: the position of the tool tip is evaluated
    bool stylus = false;         ///< the tool is the probe
};

/// The physical model of one active effect: its addition at one sample. Implemented in the room
/// effects, one small file a subject.
class EffectModel {
  public:
    virtual ~EffectModel() = default;
    virtual void perturb(const AxisSample& sample, const Contact& contact,
                         kinematics::Perturbation& out) const = 0;
    void perturb(const AxisSample& sample, kinematics::Perturbation& out) const {
        perturb(sample, {}, out);
    }
};

using EffectModels = std::vector<std::shared_ptr<const EffectModel>>;

}  // namespace trunnion::emulator
