// Groups of columns: every way in which readings may differ from the simulation, one group each.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::diagnosis {

/// What a group may be called. Only the first three are causes.
enum class GroupKind : unsigned char {
    textbook,  ///< a catalogue effect in the form of the textbook
    table,     ///< an error motion of an axis in free form
    periodic,  ///< a catalogue effect at one setting of its keys: ripple, drift, slip
    offset,    ///< zero of each test; noise while it is small, a place when it is large
    driver     ///< "where": anything that follows time, place, speed, mode
};
inline bool is_cause(GroupKind kind) {
    return kind == GroupKind::textbook || kind == GroupKind::table || kind == GroupKind::periodic;
}

/// Error motions of one axis in free form: values at knots, or harmonics of a whole turn.
struct TableForm {
    kinematics::AxisGeometry axis;  ///< as the chain has it
    std::vector<int> directions;    ///< 0..5 = X Y Z (mm), A B C (rad), along and about + axes of M
    std::vector<double> knots;      ///< mm or rad, rising; empty: harmonics
    int first_order = 0, orders = 0;  ///< cos, sin of each order
    Eigen::Index per_direction() const {
        return knots.empty() ? 2 * orders : static_cast<Eigen::Index>(knots.size());
    }
};
/// Size of one unit of a table's feature: 5 um or 40 urad.
double table_unit(int direction);

struct ColumnGroup {
    GroupKind kind = GroupKind::textbook;
    std::string name;                         ///< the cause or driver: "X.backlash", "time"
    std::string component, text;              ///< of a driver
    const effects::Effect* effect = nullptr;  ///< textbook, periodic
    std::vector<double> keys;                 ///< of the effect; linear parameters 0
    std::vector<std::size_t> parameters;      ///< of the effect, one for each column
    TableForm table;
    std::vector<Eigen::Index> features;  ///< columns of the design that it combines
    Eigen::MatrixXd shape;               ///< features x columns; empty: one column a feature
    double log_prior = 0.0;              ///< of being there
    /// A change between sessions: the first session that has it, and those before, which have not.
    std::string since;
    std::vector<std::string> before;
    bool is_change() const { return !before.empty(); }
    Eigen::Index columns() const {
        return shape.size() > 0 ? shape.cols() : static_cast<Eigen::Index>(features.size());
    }
};

bool has_keys(const effects::Effect& effect);

/// Rows of sessions before a change are zero: it moves no reading there.
void drop_sessions(Eigen::MatrixXd& columns, const emulator::Replay& replay,
                   const std::vector<std::string>& before);

/// Derivatives of the readings by the values of a table at its knots (or by its harmonics), mm for
/// one table_unit; direction after direction.
Eigen::MatrixXd table_features(const emulator::Replay& replay,
                               const std::vector<kinematics::Perturbation>& gradient,
                               const TableForm& table);

/// Columns of a cause on any readings, mm for one usual change. Offsets and drivers have none:
/// they predict nothing.
Eigen::MatrixXd columns_on(const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient,
                           const ColumnGroup& group);

}  // namespace trunnion::diagnosis
