// Programmed points of readings against those that the declared stores mean, as linear equations of
// the stores.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "effects/effect_kind.h"
#include "records/readings.h"
#include "setup/right_stores.h"

namespace trunnion::diagnosis {

constexpr int tool_place = -1;  ///< place of a StoreNumber that is a length; its component is H

/// Rows of a probe with their point.
struct PointRows {
    std::vector<std::size_t> row;     ///< in the table
    std::vector<std::size_t> device;  ///< among the device rows
    std::size_t devices = 0;
};
PointRows point_rows(const records::ReadingTable& table);

effects::EffectKind kind_of(const setup::StoreNumber& number);
/// "dg_mm": as the effect calls it. 19709-11 are dt_mm, 19712-14 ds_mm.
const char* parameter_of(const setup::StoreNumber& number);
void add_to(setup::Setup& setup, const setup::StoreNumber& number, double change_mm);

/// Differences of the points (in W, one below the other) and what 1 mm of each number does to
/// them, which is linear. Numbers without any influence are left out.
struct PointEquations {
    std::vector<setup::StoreNumber> numbers;  ///< declared
    Eigen::MatrixXd columns, gram;
    Eigen::VectorXd difference, product;  ///< by the table minus by the declared stores, mm
    double square = 0.0;                  ///< sum of squares of the differences
    double repeats = 1.0;  ///< rows for each position: they share the last digits of the table
};
PointEquations point_equations(const setup::Setup& setup, const records::ReadingTable& table,
                               const PointRows& rows);

/// What differences of the points do to the readings, um, by device row.
std::vector<double> readings_um(const setup::Setup& setup, const records::ReadingTable& table,
                                const PointRows& rows, const Eigen::VectorXd& points_mm);

}  // namespace trunnion::diagnosis
