// The door through which every prediction goes: axis sample in, reading out. Noise-free and smooth.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "setup/setup.h"
#include "kinematics/forward.h"
#include "records/readings.h"

namespace trunnion {

/// What the instrument does at one reading: all that effects of probe, ballbar and artefact need
/// beside the axis sample. `run` leaves it empty while no device reads.
struct Contact {
    Device device = Device::none;
    int artefact = -1;                      ///< index in Setup::artefacts
    Vector3 direction_M = Vector3::Zero();  ///< component read, approach, or cup to pivot
    Vector3 direction_W = Vector3::Zero();  ///< the same seen from the table
    int touches = 0;                        ///< of the pattern behind a sphere row, 0 = unknown
    double extension_mm = 0.0;              ///< of stylus or cup, beyond the setup's
    double path_mm = 0.0;                   ///< of the linear axes since the test began
    AxisPositions acceleration;             ///< mm/s^2, rad/s^2 along the commanded path
    bool tip = false;     ///< no device reads: where the tip of the tool in the spindle is
    bool stylus = false;  ///< that tool is the probe
};

/// The physical model of one effect that is switched on: what it adds at one sample. Written in the
/// effects room, one small file each; the emulator only calls it.
class EffectModel {
  public:
    virtual ~EffectModel() = default;
    virtual void perturb(const AxisSample& sample, const Contact& contact,
                         Perturbation& out) const = 0;
    void perturb(const AxisSample& sample, Perturbation& out) const { perturb(sample, {}, out); }
};

/// For the errors of the spindle.
inline SpindleAngle spindle_angle(const AxisSample& sample) {
    return sample.spindle_turns ? std::nullopt : SpindleAngle(sample.spindle_rad);
}

using EffectModels = std::vector<std::shared_ptr<const EffectModel>>;

/// Set-up quantities of a replay that differ from the setup file's, mm.
struct ReplayOffsets {
    std::vector<Vector3> artefact_W;  ///< by artefact
    Vector3 cup_S = Vector3::Zero();
    double length = 0.0;                   ///< of the ballbar
    ExtensionErrors stylus_S, long_cup_S;  ///< by extension
};

/// All device rows of a table, ready to be predicted many times.
///   sphere   dir . (found centre - stylus tip), the found centre noise-free
///   touch    signed distance along dir from the commanded end point to the contact, root in closed
///            form: stylus ball (tip) against sphere
///   ballbar  ball-to-ball length - nominal length
/// Linear-axis travel of a sphere row is 0: its touches come from opposite sides.
class Replay {
  public:
    /// Throws InputError when a row names an artefact or device that the setup does not have, or an
    /// axis column is missing.
    Replay(const Setup& setup, const ReadingTable& table);

    std::size_t size() const { return rows_.size(); }
    std::size_t table_row(std::size_t i) const { return rows_[i]; }
    const AxisSample& sample(std::size_t i) const { return samples_[i]; }
    const Contact& contact(std::size_t i) const { return contacts_[i]; }
    const Setup& setup() const { return setup_; }

    /// Readings of all device rows, mm. `machine` may differ from the setup's (location errors).
    std::vector<double> predict(const Machine& machine, const ReplayOffsets& offsets,
                                const EffectModels& models) const;
    std::vector<double> predict(const EffectModels& models) const;

    /// d reading / d Perturbation of device row i by central differences, as a Perturbation whose
    /// entries are the derivatives (mm/mm, mm/rad).
    Perturbation gradient(std::size_t i, const ForwardModel& model,
                          const ReplayOffsets& offsets) const;

  private:
    double read(std::size_t i, const ForwardModel& model, const ReplayOffsets& offsets,
                const Perturbation& extra) const;

    Setup setup_;
    std::vector<std::size_t> rows_;
    std::vector<AxisSample> samples_;
    std::vector<Contact> contacts_;
};

/// Sum of products of all entries: the change of a reading for a small `delta`.
double dot(const Perturbation& gradient, const Perturbation& delta);

/// The table with value_mm of every device row replaced by its noise-free prediction.
ReadingTable predicted(const Setup& setup, const ReadingTable& table, const EffectModels& models);

}  // namespace trunnion
