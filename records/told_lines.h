// Lines by which a running program tells its PC what is measured and what the operator set up.
#pragma once

#include <string>
#include <string_view>

#include "records/readings.h"

namespace trunnion::records {

/// Settings made by the operator.
struct ShopState {
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< additional length of stylus or cup beyond the setup
};

/// Parses SPINDLE 180, TEMPERATURE 24, LOAD 80, CLAMPED 1, EXTENSION 60 (deg, deg C, kg, 0 or 1,
/// mm). Any other line has no effect.
void take_told(std::string_view line, ShopState& shop);
void put_shop(const ShopState& shop, Reading& row);
/// MODE RTCP: the active positioning function; MODE DIRECT: none. Empty for any other line.
std::optional<PositioningMode> told_mode(std::string_view line);
/// Name of a test from words: joined by '_', in lower case except single letters: RADIAL A POS
/// becomes radial_A_pos.
std::string told_name(std::string_view words);
/// Text after `word` and a blank, trimmed; empty for any other line.
std::optional<std::string_view> told_words(std::string_view line, std::string_view word);
/// Columns that some row sets to a value other than the default.
std::vector<std::string> shop_columns(const std::vector<Reading>& rows);

}  // namespace trunnion::records
