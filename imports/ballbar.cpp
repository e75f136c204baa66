// A ballbar's recording of one circle: angle or time against radius.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "imports/column_roles.h"
#include "imports/row_writer.h"
#include "imports/side_columns.h"
#include "imports/time_column.h"

namespace trunnion::imports {
namespace {

/// One circle about the pivot as commanded by the program.
struct Circle {
    int plane = 0;  ///< 0 XY, 1 YZ, 2 ZX
    double sense = 1.0;
    double start_rad = 0.0, end_rad = 0.0;
    std::optional<double> feed_mm_min;
};

struct BarColumns {
    std::optional<NumberColumn> angle;
    NumberColumn value;
    bool radius = false;  ///< complete lengths instead of deviations
    std::optional<std::size_t> lengths;
};

[[noreturn]] void ask(const TextTable& table, const std::string& what) {
    throw InputError(what, {table.path(), 1, 1});
}

Circle circle_of(const TextTable& table, const Facts& facts) {
    Circle circle;
    const std::string plane = facts.text("plane");
    const std::vector<std::string> planes{"XY", "YZ", "ZX"};
    const auto it = std::find(planes.begin(), planes.end(), plane);
    if (it == planes.end())
        ask(table, "which plane, XY, YZ or ZX? --with plane=XY, or a line 'Plane: XY'");
    circle.plane = static_cast<int>(it - planes.begin());
    const std::string sense = facts.text("sense");
    if (sense != "cw" && sense != "ccw" && sense != "CW" && sense != "CCW")
        ask(table, "which sense, cw or ccw? --with sense=ccw, or a line 'Direction: CCW'");
    circle.sense = sense == "ccw" || sense == "CCW" ? 1.0 : -1.0;
    circle.feed_mm_min = facts.positive("feed", Quantity::speed, "mm/min");
    circle.start_rad =
        rad_from_deg(facts.number("start_deg", Quantity::angle, "deg").value_or(0.0));
    const double whole = rad_from_deg(360.0) * circle.sense;
    const auto end = facts.number("end_deg", Quantity::angle, "deg");
    circle.end_rad = end ? rad_from_deg(*end) : circle.start_rad + whole;
    return circle;
}

BarColumns columns_of(const TextTable& table, const Facts& facts) {
    BarColumns columns;
    const auto angle = find_column(table, {"angle", "winkel", "theta", "phi", "position"});
    if (angle) columns.angle = number_column(table, *angle, Quantity::angle, "deg");
    const auto radius = find_column(table, {"radius", "length", "laenge", "r", "l"});
    const auto deviation =
        find_column(table, {"deviation", "abweichung", "error", "value", "dev", "dr", "reading",
                            "readout", "radialdeviation", "radiusdeviation", "bar"});
    if (!radius && !deviation)
        table.header_line().fail("no column of deviations (\"deviation\") or lengths (\"radius\")",
                                 1);
    columns.radius = !deviation;
    columns.lengths = radius;
    columns.value = number_column(table, deviation ? *deviation : *radius, Quantity::length,
                                  facts.text("unit"));
    return columns;
}

/// A second circle in another column would be lost; conditions, and lengths beside deviations, are
/// told in a note.
void check_other_columns(const TextTable& table, const BarColumns& columns, const TimeColumn& time,
                         std::vector<std::string>& notes) {
    std::string unused;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        const TextColumn& column = table.columns()[k];
        const bool angle = columns.angle && columns.angle->index == k;
        if (angle || k == columns.value.index || time.is_column(k)) continue;
        const bool position = role_of(column.name).has_value();
        const bool known = position || is_beside_values(column) || columns.lengths == k;
        if (!known && table.has_numbers(k))
            table.header_line().fail("'" + column.name +
                                         "' is not understood: a table has the readings of one "
                                         "circle; what --with columns= names 'skip' is left out",
                                     column.column);
        if (!column.name.empty()) unused += (unused.empty() ? "'" : ", '") + column.name + '\'';
    }
    if (!unused.empty()) notes.push_back(table.path() + ": not read: " + unused);
}

/// Angles of the rows, rad: given, or in equal steps from start to end in time.
std::vector<double> angles_of(const TextTable& table, const BarColumns& columns,
                              const Circle& circle, const std::vector<double>& times) {
    std::vector<double> angles;
    std::vector<records::TableCell> cells;
    const double span_s = times.back() - times.front();
    if (!columns.angle && span_s <= 0.0)
        ask(table, "neither angles nor times: a column 'angle' or 'time' is missing");
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        angles.push_back(columns.angle
                             ? number_in(table, i, cells, *columns.angle)
                             : circle.start_rad + (circle.end_rad - circle.start_rad) *
                                                      (times[i] - times.front()) / span_s);
    }
    return angles;
}

/// A recording traverses the angles in the given direction, so 359 to 0 is a step forwards.
void unwrap(const TextTable& table, const Circle& circle, std::vector<double>& angles) {
    for (std::size_t i = 1; i < angles.size(); ++i) {
        angles[i] = angles[i - 1] + std::remainder(angles[i] - angles[i - 1], 2.0 * pi);
        if ((angles[i] - angles[i - 1]) * circle.sense <= 0.0)
            table.fail(i, 0,
                       circle.sense > 0.0 ? "the angle does not rise, as ccw says it does"
                                          : "the angle does not fall, as cw says it does");
    }
}

/// Without a time column the times follow from angle and feed.
void fill_times(const Circle& circle, double length_mm, const std::vector<double>& angles,
                std::vector<double>& times) {
    const double speed = circle.feed_mm_min ? *circle.feed_mm_min / 60.0 / length_mm : 0.0;
    for (std::size_t i = 0; i < times.size(); ++i)
        times[i] =
            speed > 0.0 ? std::abs(angles[i] - angles[0]) / speed : 60.0 * static_cast<double>(i);
}

class BarRows {
  public:
    BarRows(const setup::Setup& setup, const setup::Artefact& pivot, const AxisPositions& at)
        : setup_(setup), nominal_{setup.machine.chain, {}}, pivot_(pivot), at_(at) {
        if (!setup.ballbar) throw InputError("the setup has no [ballbar]", {setup.path});
    }

    /// Machine positions that put the cup on the circle, rotary axes at rest.
    AxisPositions on_circle(const Circle& circle, double angle_rad) const {
        const Eigen::Index a = circle.plane, b = (circle.plane + 1) % 3;
        Vector3 along = Vector3::Zero();
        along(a) = std::cos(angle_rad);
        along(b) = std::sin(angle_rad);
        const Vector3 center_M = nominal_.poses(at_).pose_MW * pivot_.center_W_mm;
        const Vector3 cup_M = center_M + setup_.ballbar->length_mm * along;
        AxisPositions q = at_;
        const Vector3 xyz = cup_M - setup_.ballbar->cup_S_mm;
        for (std::size_t d = 0; d < 3; ++d) q[all_axes[d]] = xyz(static_cast<Eigen::Index>(d));
        check(q, cup_M);
        return q;
    }

  private:
    /// The formula is valid for slides along X, Y and Z of M; other machines are refused.
    void check(const AxisPositions& q, const Vector3& cup_M) const {
        const auto poses = nominal_.poses(q);
        const Vector3 between =
            poses.pose_MW * pivot_.center_W_mm - poses.pose_MS * setup_.ballbar->cup_S_mm;
        const Vector3 wanted = nominal_.poses(at_).pose_MW * pivot_.center_W_mm - cup_M;
        if ((between - wanted).norm() > 1e-6)
            throw InputError(
                "the linear axes of this machine are not parallel to X, Y and Z: give axis "
                "positions (import table)",
                {setup_.path});
    }

    const setup::Setup& setup_;
    kinematics::Machine nominal_;  ///< the control's belief, without known errors
    const setup::Artefact& pivot_;
    AxisPositions at_;
};

/// A bar reads its length within its stroke: beyond it, it is another bar.
constexpr double stroke_mm = 2.0;

std::string other_length(const setup::Setup& setup, double length_mm) {
    return fmt::format("[ballbar] length_mm of {} is {}: write length_mm = {} there for this bar",
                       setup.path, shortest(setup.ballbar->length_mm), shortest(length_mm));
}

/// The circle of a bar of another length is no circle of this one: its squareness would be wrong by
/// the ratio of the two.
void check_radius(const TextTable& table, const Facts& facts, const setup::Setup& setup,
                  std::vector<std::string>& notes) {
    for (const char* key : {"radius", "diameter"}) {
        const auto told = facts.positive(key, Quantity::length, "mm");
        if (!told) continue;
        const double radius_mm = key == std::string_view("radius") ? *told : 0.5 * *told;
        const double off_mm = radius_mm - setup.ballbar->length_mm;
        if (std::abs(off_mm) > stroke_mm)
            facts.fail(key, fmt::format("the file's radius is {} mm, and {}", shortest(radius_mm),
                                        other_length(setup, radius_mm)));
        if (off_mm != 0.0)
            notes.push_back(fmt::format("{}: radius {} mm; read with the bar's {} mm of the setup",
                                        table.path(), shortest(radius_mm),
                                        shortest(setup.ballbar->length_mm)));
    }
}

/// Lengths of another bar, or lengths in a column of deviations.
void check_lengths(const TextTable& table, const BarColumns& columns, const setup::Setup& setup) {
    double sum_mm = 0.0;
    std::size_t count = 0;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        if (is_missing(cells[columns.value.index].text)) continue;
        sum_mm += number_in(table, i, cells, columns.value);
        ++count;
    }
    if (count == 0) throw InputError("no value in the table", {table.path(), 1, 1});
    const TextColumn& column = table.columns()[columns.value.index];
    const double mean_mm = sum_mm / static_cast<double>(count);
    const double usual_mm = columns.radius ? setup.ballbar->length_mm : 0.0;
    if (std::abs(mean_mm - usual_mm) <= stroke_mm) return;
    const double length_mm = std::round(1e3 * mean_mm) / 1e3;
    table.header_line().fail(
        columns.radius ? fmt::format("the lengths are about {} mm, and {}", shortest(length_mm),
                                     other_length(setup, length_mm))
                       : fmt::format("the deviations are about {} mm, more than a bar reads: "
                                     "lengths ('radius')? another unit?",
                                     shortest(length_mm)),
        column.column);
}

std::string circle_words(const Circle& circle, const std::vector<double>& angles) {
    static constexpr const char* planes[] = {"XY", "YZ", "ZX"};
    return fmt::format("{} {}, {:.0f} to {:.0f} deg{}", planes[circle.plane],
                       circle.sense > 0.0 ? "ccw" : "cw", deg_from_rad(angles.front()),
                       deg_from_rad(angles.back()),
                       circle.feed_mm_min ? fmt::format(", {} mm/min", *circle.feed_mm_min) : "");
}

std::vector<double> times_of(const TextTable& table, const TimeColumn& time) {
    std::vector<double> times;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        times.push_back(time.time_s(table, i, cells));
    }
    return times;
}

void import_circle(const ImportRequest& request, const TextTable& table, RowWriter& rows,
                   Imported& result) {
    const Facts facts = request.facts.with_head_of(table, result.notes);
    const setup::Setup& setup = request.setup;
    const setup::Artefact& pivot =
        artefact_for(setup, facts.text("feature"), setup::Artefact::Kind::center_pivot);
    const BarRows bar(setup, pivot, positions_told(setup, facts.text("at")));
    check_radius(table, facts, setup, result.notes);
    const Circle circle = circle_of(table, facts);
    const BarColumns columns = columns_of(table, facts);
    const TimeColumn time(table, facts);
    time.note_unit(table, result.notes);
    check_other_columns(table, columns, time, result.notes);
    check_lengths(table, columns, setup);
    std::vector<double> times = times_of(table, time);
    std::vector<double> angles = angles_of(table, columns, circle, times);
    unwrap(table, circle, angles);
    if (time.invented()) fill_times(circle, setup.ballbar->length_mm, angles, times);
    records::Reading row;
    row.test = facts.text(
        "test", fmt::format("{}_{}", facts.text("plane"), circle.sense > 0.0 ? "ccw" : "cw"));
    row.device = records::Device::ballbar;
    row.feature = pivot.name;
    row.feed_mm_min = circle.feed_mm_min.value_or(0.0);
    rows.begin_file(table, facts);
    if (time.dated()) rows.name_days();
    if (time.invented() && !circle.feed_mm_min) rows.invent_times();
    std::vector<records::TableCell> cells;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        if (is_missing(cells[columns.value.index].text)) {
            ++missing;
            continue;
        }
        row.time_s = times[i];
        row.commanded = bar.on_circle(circle, angles[i]);
        row.value_mm = number_in(table, i, cells, columns.value) -
                       (columns.radius ? setup.ballbar->length_mm : 0.0);
        rows.add(row, table.line(i).number);
    }
    result.summary.push_back(fmt::format("{}: ballbar, {}, {} readings; {}", table.path(),
                                         circle_words(circle, angles), table.size() - missing,
                                         table.dialect_words()));
    if (missing > 0)
        result.notes.push_back(
            fmt::format("{}: {} rows without a value are left out", table.path(), missing));
    if (time.invented())
        result.notes.push_back(table.path() +
                               (circle.feed_mm_min
                                    ? ": times from angle and feed"
                                    : ": neither times nor a feed: speeds are not known, nothing "
                                      "can be said about the servo (--with feed=1000)"));
}

}  // namespace

Imported import_ballbar(const ImportRequest& request) {
    Imported result;
    RowWriter rows(request.setup, "ballbar", {"feed_mm_min"}, false, false);
    for (const TextTable& table : tables_of(request, result.notes))
        import_circle(request, table, rows, result);
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports
