// Groups of columns: every way in which readings may differ from the simulation, one group each.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::diagnosis {

/// Kinds of groups. Only the first three are causes.
enum class GroupKind : unsigned char {
    textbook,  ///< a catalogue effect in textbook form
    table,     ///< an error motion of an axis in free form
    periodic,  ///< a catalogue effect with given keys: ripple, drift, slip
    offset,    ///< zero of each test; noise while small, part of the gap when large
    driver,    ///< "where": any dependence on position, time, speed, mode
    spoiled    ///< the readings of one visit, whatever they are; only a rival
};
inline bool is_cause(GroupKind kind) {
    return kind == GroupKind::textbook || kind == GroupKind::table || kind == GroupKind::periodic;
}

/// Error motions of one axis in free form: values at knots, or harmonics of a whole turn.
struct TableForm {
    effects::EffectKind motion;     ///< the family: positioning, straightness, ...
    kinematics::AxisGeometry axis;  ///< as in the chain
    std::vector<int> directions;    ///< 0..5 = X Y Z (mm), A B C (rad), along and about + axes of M
    std::vector<double> knots;      ///< mm or rad, rising; empty: harmonics
    int first_order = 0, orders = 0;        ///< cos, sin of each order
    const effects::Effect* play = nullptr;  ///< a backlash: its value depends on the place
    Eigen::Index per_direction() const {
        return knots.empty() ? 2 * orders : static_cast<Eigen::Index>(knots.size());
    }
};
/// Tables that the same readings may confuse: of one axis, both or neither of its play.
bool are_kindred(const TableForm& a, const TableForm& b);
/// Size of one unit of a table's feature: 5 um or 40 urad, returned in mm or rad.
double table_unit(int direction);

struct ColumnGroup {
    GroupKind kind = GroupKind::textbook;
    std::string name;                         ///< the cause or driver: "X.backlash", "time"
    std::string component, text;              ///< of a driver
    bool of_time = false;                     ///< a driver: a course of time
    bool is_whole = false;                    ///< a driver with what effects do as well
    bool is_walk = false;                     ///< a driver that only stands against causes
    bool is_anything = false;                 ///< a driver that follows nearly everything, too:
                                              ///< by itself it does not tell where
    bool machine_jump = false;                ///< of diagnosis/groups/machine_jump.h
    bool unnamed = false;                     ///< of add_unnamed_forms
    bool by_definition = false;               ///< angles of an axis that was read along one line:
                                              ///< by ISO 230-1 they are its positioning there
    const effects::Effect* effect = nullptr;  ///< textbook, periodic
    std::vector<double> keys;                 ///< of the effect; linear parameters 0
    std::vector<std::size_t> parameters;      ///< of the effect, one for each feature
    TableForm table;
    bool is_line = false;  ///< the functions that a table at knots leaves to the textbook form; it
                           ///< stands in no model
    std::vector<double> open_keys;  ///< of a ripple: other keys that the likelihood leaves open
    bool of_cycles = false;         ///< offset: the zeros of cycles within a laser test
    std::vector<Eigen::Index> features;  ///< columns of the design that the group combines
    Eigen::MatrixXd shape;               ///< features x columns; empty: one column for each feature
    /// Values of the features for coefficients of the columns.
    Eigen::VectorXd feature_values(const Eigen::VectorXd& coefficients) const;
    double log_prior = 0.0;  ///< log of the prior probability of being present
    /// A change between sessions: the first session with it, and the earlier sessions without it.
    std::string since;
    std::vector<std::string> before;
    bool is_change() const { return !before.empty(); }
    bool has_range() const;  ///< parameters from 0 to 1, never below 0, or with a limit
    Eigen::Index columns() const {
        return shape.size() > 0 ? shape.cols() : static_cast<Eigen::Index>(features.size());
    }
};

bool has_keys(const effects::Effect& effect);
/// True for a driver of time, a drift, an expansion and a move of an artefact.
bool is_course_of_time(const ColumnGroup& group);
/// Log prior of the size of a drift, `tau` typical ones: at its end, or within the time of the
/// readings in what a usual one of half an hour does there, whichever is more. Many times that
/// hardly any machine drifts, and what a few minutes show is a position that was measured in the
/// order of time. 0 for other effects, which may have any size.
double log_prior_of_size(const ColumnGroup& group, double tau);

/// Sets the rows of sessions before a change to zero.
void drop_sessions(Eigen::MatrixXd& columns, const emulator::Replay& replay,
                   const std::vector<std::string>& before);

/// Derivatives of the readings with respect to the values of a table at its knots (or its
/// harmonics), mm for one table_unit; direction after direction.
Eigen::MatrixXd table_features(const emulator::Replay& replay,
                               const std::vector<kinematics::Perturbation>& gradient,
                               const TableForm& table);

/// Columns of a cause for any readings, mm for one typical change. Offsets and drivers have none,
/// because they predict nothing.
Eigen::MatrixXd columns_on(const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient,
                           const ColumnGroup& group);
/// These columns times coefficients, mm.
Eigen::VectorXd contribution_on(const emulator::Replay& replay,
                                const std::vector<kinematics::Perturbation>& gradient,
                                const ColumnGroup& group, const Eigen::VectorXd& coefficients);

}  // namespace trunnion::diagnosis
