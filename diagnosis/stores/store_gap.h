// Stores in force that are not the declared ones, from the programmed points (px_mm ..) of
// readings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/verdict/verdict_kind.h"
#include "effects/effect_kind.h"
#include "identification/identify.h"
#include "records/readings.h"
#include "setup/right_stores.h"

namespace trunnion::diagnosis {

/// One number that the control had in force while the readings were taken.
struct StoreChange {
    effects::EffectKind kind = effects::EffectKind::pivot_g54;
    setup::StoreNumber store;  ///< declared; place -1: the length of tool `component`
    double change_mm = 0.0;    ///< in force minus declared
    double sigma_mm = 0.0;     ///< NaN: not told apart
    double square_um2 = 0.0;   ///< mean square of what it alone does to the readings
};

/// Axis positions in force against those that the declared control commands for the same points.
struct StoreGap {
    double places = 0.0;                              ///< different positions that were compared
    std::vector<StoreChange> changes;                 ///< the fewest numbers that explain them
    std::vector<effects::EffectKind> rivals;          ///< explain them with as many numbers
    std::vector<identification::Inseparable> unseen;  ///< changes that would do the same
    std::vector<double> before_um, after_um;          ///< by device row: with the declared stores,
                                                      ///< with the changes
    std::vector<DriverShare> where;                   ///< by mode
};

/// Empty when no row of a probe names its point, or when the declared stores command what was
/// commanded. Positions do not depend on the machine, so its errors have no influence.
std::optional<StoreGap> store_gap(const setup::Setup& setup, const records::ReadingTable& table);

/// Differences of a table's points by the stores of a setup, as readings by device row, um; empty
/// without points.
std::vector<double> points_um(const setup::Setup& setup, const records::ReadingTable& table);
double mean_square_of(const std::vector<double>& values);

/// The setup with the stores in force.
setup::Setup with_stores(setup::Setup setup, const StoreGap& gap);

}  // namespace trunnion::diagnosis
