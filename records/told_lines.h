// Lines by which a running program tells its PC what is measured and what the operator set up.
#pragma once

#include <string>
#include <string_view>

#include "records/readings.h"

namespace trunnion::records {

/// What the operator set up.
struct ShopState {
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< stylus ball or cup hangs so much lower than the setup says
};

/// Takes SPINDLE 180, TEMPERATURE 24, LOAD 80, CLAMPED 1, EXTENSION 60 (deg, deg C, kg, 0 or 1,
/// mm). Any other line changes nothing.
void take_told(std::string_view line, ShopState& shop);
void put_shop(const ShopState& shop, Reading& row);
/// MODE RTCP: the function that positions from now on; MODE DIRECT: none. nullopt for another line.
std::optional<PositioningMode> told_mode(std::string_view line);
/// Name of a test from words: joined by '_', in lower case except single letters: RADIAL A POS is
/// radial_A_pos.
std::string told_name(std::string_view words);
/// What stands behind `word` and a blank, without blanks around it; nullopt for another line.
std::optional<std::string_view> told_words(std::string_view line, std::string_view word);
/// Columns of what some row sets beside its usual value.
std::vector<std::string> shop_columns(const std::vector<Reading>& rows);

}  // namespace trunnion::records
