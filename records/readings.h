// Readings: simulated and real alike, one scalar a row (formats.md, "Readings").
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion {

enum class Device : unsigned char { none, sphere, touch, ballbar };

/// since_reversal of an axis that has not turned since its test began: more than this (mm or rad).
constexpr double no_reversal_seen = 1e6;

std::string_view name_of(Device device);         ///< "sphere", ...; "" for none
std::string_view name_of(PositioningMode mode);  ///< "dpp", ...; "" for none

struct Reading {
    int index = 0;
    double time_s = 0.0;
    std::string test;
    PositioningMode mode = PositioningMode::none;
    Device device = Device::none;
    std::string feature;
    AxisPositions commanded;  ///< mm and rad (deg in the file)
    Vector3 direction_M = Vector3::Zero();
    std::optional<double> value_mm;
    double feed_mm_min = 0.0;
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< stylus ball or cup hangs so much lower than the setup says
    std::optional<double> sigma_mm;
    int line = 0;  ///< in the file, 0 when simulated
    int part = 0;  ///< of a joined table: which file
};

struct ReadingTable {
    std::string path;                            ///< of the file, for messages
    std::vector<std::string> parts;              ///< of a joined table: path of each file
    std::map<std::string, std::string> comment;  ///< `# key = value`
    std::vector<Axis> axes;                      ///< machine axes with a column
    std::vector<std::string> optional_columns;   ///< optional columns present, in file order
    std::vector<Reading> rows;
};

/// Reads the CSV text. Throws InputError with line and column. Unknown columns are listed in
/// `notes`.
ReadingTable parse_readings(std::string_view text, const std::string& path,
                            std::vector<std::string>& notes);
/// Several tables as one, in the order given: one that starts before the last one ended is taken as
/// 60 s later, a test name that was used already gets a number. Throws InputError when the axes or
/// the touch patterns differ.
ReadingTable join_readings(std::vector<ReadingTable> tables);
/// Where a row stands, for messages.
SourceRef place_of(const ReadingTable& table, const Reading& row);
/// The same table as text; numbers read back to the same double.
std::string format_readings(const ReadingTable& table);

/// AxisSample of each row: velocity and direction of travel by the contract's rules. Ballbar rows:
/// central differences within the test, travel 0 where the axis stands or turns within rounding.
/// Other rows: sign of the axis's last non-zero move. `since_reversal` counts from the turning
/// point (of the parabola through the samples around it); before the first turn of a test it is
/// beyond `no_reversal_seen`.
std::vector<AxisSample> samples_of(const ReadingTable& table);

}  // namespace trunnion
