// Readings, simulated or measured, one scalar a row (formats.md). Names: reading_columns.cpp.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "geometry/axes.h"
#include "geometry/axis_names.h"
#include "geometry/pose.h"

namespace trunnion::records {

enum class Device : unsigned char { none, sphere, touch, ballbar, linear, angle, point, axis };

std::string_view name_of(Device device);         ///< "sphere", ...; "" for none
std::string_view name_of(PositioningMode mode);  ///< "dpp", ...; "" for none

struct Reading {
    int index = 0;
    double time_s = 0.0;
    std::string test;
    PositioningMode mode = PositioningMode::none;
    Device device = Device::none;
    std::string feature;
    AxisPositions commanded;                ///< mm and rad (deg in the file)
    std::optional<Vector3> point_W_mm;      ///< programmed tip position
    Vector3 direction_M = Vector3::Zero();  ///< of a `point` row: in the instrument's frame
    /// `value_mm`, `sigma_mm`, `velocity_mm_s` and `acceleration_mm_s2` are rad, rad, rad/s and
    /// rad/s^2: rows of an autocollimator, and servo rows of a rotary axis.
    bool angular = false;
    std::optional<double> value_mm;
    double feed_mm_min = 0.0;
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< additional length of stylus or cup beyond the setup
    std::optional<double> sigma_mm;
    std::optional<double> velocity_mm_s,
        acceleration_mm_s2;  ///< commanded, of the axis of an `axis` row
    /// Of a thinned servo log: velocity, acceleration and jerk of its axis behind the time constant
    /// of its drive (records/smoothed_motion.h). Not in files.
    std::optional<Vector3> smoothing;
    /// Of a row kept of a longer table: its sample among all rows (`samples_among`). Between fewer
    /// rows speeds and reversal points are others. Not in files.
    std::shared_ptr<const AxisSample> among_all;
    std::string session;     ///< day or set-up; a change starts a new session
    std::string instrument;  ///< name of an [[instrument]]; empty: the only one, or none
    std::string source;      ///< file:line of an imported value
    int line = 0;            ///< line in the file, 0 when simulated
    int part = 0;            ///< joined table: index of the file
};

struct ReadingTable {
    std::string path;                            ///< path of the file, for messages
    std::vector<std::string> parts;              ///< joined table: path of each file
    std::map<std::string, std::string> comment;  ///< `# key = value`
    AxisSides side_before{};              ///< head line `side`, of the first session; 0: not given
    std::map<int, AxisSides> part_sides;  ///< the same for the other files of a joined table
    std::vector<Axis> axes;               ///< machine axes that have a column
    AxisNames names;                      ///< of the machine; by default the letters
    std::vector<std::string> optional_columns;  ///< optional columns present, in file order
    std::vector<Reading> rows;
};

/// Head line `times = invented`: no clock was read, the times of the rows are their order.
constexpr const char *times_key = "times", *invented = "invented";
bool has_times(const ReadingTable& table);
/// Head lines `declared chain = digest`: the declared geometry beside which the values of points
/// were taken (setup/declared.h).
constexpr const char* declared_key = "declared ";

/// True when every row with a device reads an angle.
bool only_angles(const ReadingTable& table);
/// µm in a mm, or µrad in a rad where all readings are angles.
double micro_per_one(const ReadingTable& table);

/// Parses the CSV text (columns also separated by tabs or semicolons, also UTF-16, as spreadsheets
/// save them) of a machine with axes `names`. Throws InputError with line and column for a
/// cell that is not a number, a row that does not fit its device (direction not a unit vector,
/// degrees instead of mm, an axis without column), a column of an axis that the machine lacks, or
/// decreasing time. Unknown columns are listed in `notes`.
ReadingTable parse_readings(std::string_view text, const std::string& path,
                            std::vector<std::string>& notes, const AxisNames& names = {});
/// Joins tables in the given order. A table that starts before the previous one ended is shifted to
/// 60 s after its end; a test name that is already used gets a number. Throws InputError when axes
/// or touch patterns differ (join.cpp).
ReadingTable join_readings(std::vector<ReadingTable> tables);
/// Position of a row, for messages.
SourceRef place_of(const ReadingTable& table, const Reading& row);
/// The table as text; numbers read back as the same double.
std::string format_readings(const ReadingTable& table);
/// The same text row by row, for tables too long for memory. `head` (without its rows) must outlive
/// the writer.
class ReadingWriter {
  public:
    /// `directions`: some row has a direction; `degrees`: some row is in degrees.
    ReadingWriter(const ReadingTable& head, bool directions, bool degrees);
    std::string head_text() const;
    void append(const Reading& row, std::string& out) const;

  private:
    struct Columns;
    const ReadingTable& head_;
    std::shared_ptr<const Columns> columns_;
};
/// "X+ Y+ C-": the axes of `axes` whose side is known.
std::string format_sides(const std::vector<Axis>& axes, const AxisSides& sides,
                         const AxisNames& names = {});

}  // namespace trunnion::records
