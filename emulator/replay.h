// Repeated evaluation of a table of readings: every device row through the observer, and its
// derivatives.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "emulator/observer.h"

namespace trunnion::emulator {

/// A row with a reading device: inputs of effects and device. Common start of run and predict.
struct DeviceRow {
    AxisSample sample;
    Contact contact;
};
/// At a sphere row the linear axes have no side, because its touches (`touches` of them, 0:
/// unknown) arrive from opposite sides. An unknown side is taken as +. Throws InputError without
/// position when the setup lacks the device or the artefact.
DeviceRow device_row(const Observer& observer, const records::Reading& row,
                     const AxisSample& sample, int touches = 0);

/// Device rows of one axis and session before whose first motion the side is unknown.
struct UnknownSide {
    Axis axis = Axis::X;
    std::vector<std::size_t> rows;  ///< device rows
    signed char taken = 1;
};

/// Rows of a laser or autocollimator between two settings of its zero.
struct ZeroGroup {
    std::string test, session;
    bool angular = false;
    std::vector<std::size_t> rows;  ///< device rows; the first one defines the zero
};

/// All device rows of a table, prepared for many predictions.
class Replay {
  public:
    /// Throws InputError when a row names an artefact or device that the setup does not have, or an
    /// axis column is missing.
    Replay(const setup::Setup& setup, const records::ReadingTable& table);

    std::size_t size() const { return rows_.size(); }
    std::size_t table_row(std::size_t i) const { return rows_[i]; }
    /// A touch: at its contact on the machine without effects.
    const AxisSample& sample(std::size_t i) const { return samples_[i]; }
    const Contact& contact(std::size_t i) const { return contacts_[i]; }
    const setup::Setup& setup() const { return setup_; }
    /// The setup with the values of the session ([[session]]), if it has any.
    const setup::Setup& setup_of(std::size_t session) const;

    /// Sides not given by the table, one entry for each axis and session.
    const std::vector<UnknownSide>& unknown_sides() const { return unknown_; }
    /// Sets the k-th unknown side to -1 or +1 (initially +1).
    void assume_side(std::size_t k, signed char side);
    signed char side(std::size_t k) const { return unknown_[k].taken; }

    /// Tests of `linear` and `angle` rows, one entry for each test and session; their zeros are
    /// free.
    const std::vector<ZeroGroup>& zeros() const { return zeros_; }

    /// Names of the sessions, in the order of their first device rows; a single empty name when the
    /// table has no session column.
    const std::vector<std::string>& sessions() const { return sessions_; }
    std::size_t session(std::size_t i) const { return session_[i]; }

    /// Noise-free readings of all device rows, mm (rad for angular rows). `linear` and `angle` rows
    /// are relative to the first of their test. `machine` may differ from that of the setup
    /// (location errors).
    std::vector<double> predict(const kinematics::Machine& machine, const ReplayOffsets& offsets,
                                const EffectModels& models) const;
    std::vector<double> predict(const EffectModels& models) const;

    /// Derivatives of device row i with respect to the entries of a Perturbation by central
    /// differences, returned as a Perturbation (mm/mm, mm/rad).
    kinematics::Perturbation gradient(std::size_t i, const kinematics::ForwardModel& model,
                                      const ReplayOffsets& offsets) const;

  private:
    double read(std::size_t i, const kinematics::ForwardModel& model, const ReplayOffsets& offsets,
                const kinematics::Perturbation& extra) const;
    void list_unknown_sides(const records::ReadingTable& table);
    void list_zeros(const records::ReadingTable& table);
    void list_sessions(const records::ReadingTable& table);

    setup::Setup setup_;
    std::map<std::size_t, setup::Setup> own_;  ///< by session: those with their own values
    std::vector<std::size_t> rows_;
    std::vector<AxisSample> samples_;
    std::vector<Contact> contacts_;
    std::vector<AxisPositions> commanded_;
    std::vector<UnknownSide> unknown_;
    std::vector<ZeroGroup> zeros_;
    std::vector<std::string> sessions_;
    std::vector<std::size_t> session_;  ///< session of each device row
};

/// Sum of products of all entries: first-order change of a reading for a small `delta`.
double dot(const kinematics::Perturbation& gradient, const kinematics::Perturbation& delta);

/// The table with value_mm of every device row replaced by its noise-free prediction.
records::ReadingTable predicted(const setup::Setup& setup, const records::ReadingTable& table,
                                const EffectModels& models);

}  // namespace trunnion::emulator
