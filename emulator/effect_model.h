// What an effect is to the emulator: something that adds to the machine at one reading.
#pragma once

#include <memory>
#include <vector>

#include "kinematics/machine.h"
#include "records/readings.h"

namespace trunnion::emulator {

/// What the instrument does at one reading: all that effects of probe, ballbar and artefact need
/// beside the axis sample. `run` leaves it empty while no device reads.
struct Contact {
    records::Device device = records::Device::none;
    int artefact = -1;                      ///< index in Setup::artefacts
    Vector3 direction_M = Vector3::Zero();  ///< component read, approach, or cup to pivot
    Vector3 direction_W = Vector3::Zero();  ///< the same seen from the table
    int instrument = -1;  ///< of a point row: index in Setup::instruments, -1 without one
    Vector3 direction_I = Vector3::Zero(), commanded_I_mm = Vector3::Zero();  ///< of a point row
    Pose believed_WS;            ///< of a linear or angle row: the tool by the declared control
    int zero = -1;               ///< of such a row: its test, index in Replay::zeros
    Axis axis = Axis::X;         ///< of an axis row
    bool scale_encoder = false;  ///< its encoder sits behind the drive
    double along_mm = 0.0;       ///< touch: from the commanded end to the sample, along direction_M
    int touches = 0;             ///< of the pattern behind a sphere row, 0 = unknown
    double extension_mm = 0.0;   ///< of stylus or cup, beyond the setup's
    bool tip = false;            ///< no device reads: where the tip of the tool in the spindle is
    bool stylus = false;         ///< that tool is the probe
};

/// The physical model of one effect that is switched on: what it adds at one sample. Written in the
/// effects room, one small file each; the emulator only calls it.
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
