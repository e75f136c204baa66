// A table of readings asked again: every device row through the observer, and its derivatives.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/observer.h"

namespace trunnion::emulator {

/// A row whose device reads: what effects and device see. run and predict both begin here.
struct DeviceRow {
    AxisSample sample;
    Contact contact;
};
/// Linear axes have no side at a sphere row: its touches (`touches` of them, 0: unknown) come from
/// opposite ones. Where nothing tells a side it is taken as +. Throws InputError without a place
/// when the setup lacks the device or the artefact.
DeviceRow device_row(const Observer& observer, const records::Reading& row,
                     const AxisSample& sample, int touches = 0);

/// Device rows of one axis before whose first motion nothing tells the side, in one session.
struct UnknownSide {
    Axis axis = Axis::X;
    std::vector<std::size_t> rows;  ///< device rows
    signed char taken = 1;
};

/// Rows of a laser or autocollimator between two zeroings.
struct ZeroGroup {
    std::string test, session;
    bool angular = false;
    std::vector<std::size_t> rows;  ///< device rows, the first one defines the zero
};

/// All device rows of a table, ready to be predicted many times.
class Replay {
  public:
    /// Throws InputError when a row names an artefact or device that the setup does not have, or an
    /// axis column is missing.
    Replay(const setup::Setup& setup, const records::ReadingTable& table);

    std::size_t size() const { return rows_.size(); }
    std::size_t table_row(std::size_t i) const { return rows_[i]; }
    /// A touch: at the contact as the machine without effects makes it.
    const AxisSample& sample(std::size_t i) const { return samples_[i]; }
    const Contact& contact(std::size_t i) const { return contacts_[i]; }
    const setup::Setup& setup() const { return setup_; }
    /// With the values of the session ([[session]]), where the setup has some.
    const setup::Setup& setup_of(std::size_t session) const;

    /// Sides that the table leaves open, one entry for each axis and session.
    const std::vector<UnknownSide>& unknown_sides() const { return unknown_; }
    /// From here on the k-th of them is taken as `side`, -1 or +1; + until then.
    void assume_side(std::size_t k, signed char side);
    signed char side(std::size_t k) const { return unknown_[k].taken; }

    /// Tests of `linear` and `angle` rows, one entry for each test and session: their zero is free.
    const std::vector<ZeroGroup>& zeros() const { return zeros_; }

    /// Names of the sessions, in the order of their first device rows; one without a name where the
    /// table has no column for them.
    const std::vector<std::string>& sessions() const { return sessions_; }
    std::size_t session(std::size_t i) const { return session_[i]; }

    /// Readings of all device rows, mm; `linear` and `angle` rows count from the first of their
    /// test. `machine` may differ from the setup's (location errors).
    std::vector<double> predict(const kinematics::Machine& machine, const ReplayOffsets& offsets,
                                const EffectModels& models) const;
    std::vector<double> predict(const EffectModels& models) const;

    /// d reading / d Perturbation of device row i by central differences, as a Perturbation whose
    /// entries are the derivatives (mm/mm, mm/rad).
    kinematics::Perturbation gradient(std::size_t i, const kinematics::ForwardModel& model,
                                      const ReplayOffsets& offsets) const;

  private:
    double read(std::size_t i, const kinematics::ForwardModel& model, const ReplayOffsets& offsets,
                const kinematics::Perturbation& extra) const;
    void list_unknown_sides(const records::ReadingTable& table);
    void list_zeros(const records::ReadingTable& table);
    void list_sessions(const records::ReadingTable& table);

    setup::Setup setup_;
    std::map<std::size_t, setup::Setup> own_;  ///< by session: those with values of their own
    std::vector<std::size_t> rows_;
    std::vector<AxisSample> samples_;
    std::vector<Contact> contacts_;
    std::vector<AxisPositions> commanded_;
    std::vector<UnknownSide> unknown_;
    std::vector<ZeroGroup> zeros_;
    std::vector<std::string> sessions_;
    std::vector<std::size_t> session_;  ///< of each device row
};

/// Sum of products of all entries: the change of a reading for a small `delta`.
double dot(const kinematics::Perturbation& gradient, const kinematics::Perturbation& delta);

/// The table with value_mm of every device row replaced by its noise-free prediction.
records::ReadingTable predicted(const setup::Setup& setup, const records::ReadingTable& table,
                                const EffectModels& models);

}  // namespace trunnion::emulator
