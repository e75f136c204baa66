#include "imports/log_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"
#include "imports/column_roles.h"

namespace trunnion::imports {
namespace {

/// A step of a rotary axis between two rows of a log that samples its motion.
const double longest_step_rad = rad_from_deg(60.0);

Quantity quantity_of(bool rotary, Rate rate) {
    if (rate == Rate::acceleration) return Quantity::per_s2;
    if (rate == Rate::velocity) return rotary ? Quantity::turning : Quantity::speed;
    return rotary ? Quantity::angle : Quantity::length;
}

std::string usual_unit(bool rotary, Rate rate) {
    if (rate == Rate::acceleration) return "mm/s2";
    if (rate == Rate::velocity) return rotary ? "deg/s" : "mm/s";
    return rotary ? "deg" : "mm";
}

/// Sign of the error: actual - commanded (+1) or commanded - actual (-1).
double sign_of_error(const TextTable& table, const TextColumn& column, Role role,
                     const Facts& facts) {
    const std::string sign = facts.text("sign", role == Role::error ? "+" : "");
    if (sign != "+" && sign != "-")
        table.header_line().fail("'" + column.name +
                                     "': actual - commanded (--with sign=+) or commanded - actual "
                                     "(--with sign=-)?",
                                 column.column);
    return sign == "+" ? 1.0 : -1.0;
}

std::optional<NumberColumn>& place_of(AxisColumns& axis, const ColumnRole& role) {
    if (role.rate == Rate::velocity) return axis.velocity;
    if (role.rate == Rate::acceleration) return axis.acceleration;
    if (role.role == Role::commanded) return axis.commanded;
    return role.role == Role::actual ? axis.actual : axis.error;
}

/// Actual speeds from the encoder are no commanded motion; a position column must be commanded,
/// actual or error.
bool wanted(const ColumnRole& role) {
    return role.rate == Rate::position ? role.role != Role::none : role.role != Role::actual;
}

AxisColumns& columns_of(LogColumns& log, const setup::Setup& setup, Axis axis) {
    for (AxisColumns& columns : log.axes)
        if (columns.axis == axis) return columns;
    log.axes.push_back({});
    log.axes.back().axis = axis;
    log.axes.back().rotary = turns(setup, axis);
    log.axes.back().name = setup.machine.chain.names()[axis];
    return log.axes.back();
}

/// "J5 pos", not "J5" alone.
bool says_position(const std::string& name) {
    const std::vector<std::string> words = words_of(name);
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "pos" || word == "position" || word == "angle";
    });
}

bool is_index_word(const std::string& text) {
    return text.find_first_not_of("0123456789") == std::string::npos;
}

/// "m1_goal", "MotorCmdPos#0" without the motor and its number.
std::string without_motor(const std::string& name) {
    static const std::set<std::string> motors{"m", "motor", "servo", "drive"};
    std::vector<std::string> words = words_of(name);
    if (!words.empty() && motors.contains(words[0].substr(0, words[0].find_first_of("0123456789"))))
        words.erase(words.begin());
    std::erase_if(words, is_index_word);
    std::string out;
    for (const std::string& word : words) out += word + ' ';
    return out;
}

/// Position of the axis `axis` by the name of its motor. Speeds and errors of motors are often raw.
std::optional<ColumnRole> role_of_motor(const TextColumn& column, const AxisNames& names,
                                        const std::string& axis) {
    const auto role = role_of(without_motor(column.name) + axis, names);
    const bool position = role && role->rate == Rate::position &&
                          (role->role == Role::commanded || role->role == Role::actual ||
                           (role->role == Role::none && says_position(column.name)));
    return position ? role : std::nullopt;
}

/// A column name without axis letter ("commanded", "actual position") refers to the axis given by
/// the user.
std::optional<ColumnRole> role_in(const TextColumn& column, const AxisNames& names,
                                  const Facts& facts, bool of_motor) {
    if (auto role = role_of(column.name, names)) return role;
    if (of_motor) return role_of_motor(column, names, facts.text("axis"));
    return facts.has("axis") ? role_of(column.name + ' ' + facts.text("axis"), names)
                             : std::nullopt;
}

/// "Az" next to "Az error" or "Az actual": the commanded position. "J5 pos" next to "J5 target":
/// the actual one.
void take_plain(const TextTable& table, std::size_t k, const Facts& facts, AxisColumns& columns,
                LogColumns& log) {
    const std::string& name = table.columns()[k].name;
    const bool actual =
        columns.commanded && !columns.actual && !columns.error && !log.block && says_position(name);
    // A position beside errors of other kinds is where the axis stood.
    if (!actual && columns.commanded) {
        log.unused.push_back(name);
        return;
    }
    if (actual) log.taken_as_actual.push_back(name);
    (actual ? columns.actual : columns.commanded) =
        number_column(table, k, quantity_of(columns.rotary, Rate::position),
                      facts.text("unit", usual_unit(columns.rotary, Rate::position)));
}

bool any_read(const LogColumns& log) {
    return std::any_of(log.axes.begin(), log.axes.end(), [](auto& axis) { return axis.read(); });
}

void check(const TextTable& table, const LogColumns& log, const setup::Setup& setup) {
    if (any_read(log) || log.places_only()) return;
    std::string axes;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        axes += (axes.empty() ? "" : ", ") + setup.machine.chain.names()[axis.axis];
    const kinematics::AxisGeometry first = setup.machine.chain.axes().front();
    const std::string name = setup.machine.chain.names()[first.axis];
    table.header_line().fail(
        fmt::format(
            "no axis of the machine ({0}) has both a commanded and an actual position: "
            "\"{1} commanded\" (cmd, target, set, ref, soll) and \"{1} actual\" (act, "
            "measured, encoder, feedback, ist); --with axis={1} gives the axis of names without "
            "one, --with columns= the names",
            axes, name),
        1);
}

void take_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                  const TimeColumn& time, LogColumns& log) {
    std::vector<std::pair<Axis, std::size_t>> plain;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (time.is_column(k) || log.session == k || (log.block && log.block->column == k))
            continue;
        const TextColumn& column = table.columns()[k];
        const auto role = role_in(column, setup.machine.chain.names(), facts, log.of_motor);
        const auto axis = role ? axis_named(setup, role->axis) : std::nullopt;
        if (axis && role->role == Role::none && role->rate == Rate::position) {
            plain.emplace_back(*axis, k);
            continue;
        }
        if (!axis || !wanted(*role)) {
            log.unused.push_back(column.name);
            continue;
        }
        AxisColumns& columns = columns_of(log, setup, *axis);
        std::optional<NumberColumn>& place = place_of(columns, *role);
        if (place) table.header_line().fail("a second column for this", column.column);
        const std::string usual = usual_unit(columns.rotary, role->rate);
        const bool rate = role->rate != Rate::position, error = &place == &columns.error;
        log.units_assumed |= !error && column.unit.empty() && !facts.has("unit");
        // The unit of a deviation is never guessed.
        place = number_column(table, k, quantity_of(columns.rotary, role->rate),
                              rate ? usual : facts.text("unit", error ? "" : usual));
        if (error) columns.error_sign = sign_of_error(table, column, role->role, facts);
    }
    for (const auto& [axis, k] : plain)
        take_plain(table, k, facts, columns_of(log, setup, axis), log);
}

}  // namespace

std::optional<BlockColumnFound> find_block_column(const TextTable& table) {
    if (const auto line = find_column(table, {"line", "programline", "ncline"}))
        return BlockColumnFound{*line, true};
    const auto number = find_column(table, {"block", "blocknumber", "sequence", "sequencenumber",
                                            "sequenceno", "satz", "satznummer"});
    if (number) return BlockColumnFound{*number, false};
    for (std::size_t k = 0; k < table.columns().size(); ++k)  // "n" may be the number of the row
        if (table.columns()[k].name == "N") return BlockColumnFound{k, false};
    return std::nullopt;
}

bool LogColumns::places_only() const {
    return block && !any_read(*this) &&
           std::any_of(axes.begin(), axes.end(), [](auto& axis) { return axis.place(); });
}

LogColumns log_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                       const TimeColumn& time, bool blocks) {
    LogColumns none;
    if (blocks) none.block = find_block_column(table);
    none.session = find_column(table, {"session"});
    LogColumns log = none;
    take_columns(table, setup, facts, time, log);
    // A motor's encoder may stand beside that of its axis: only where no other name tells it.
    if (!any_read(log) && !log.places_only() && facts.has("axis")) {
        log = none;
        log.of_motor = true;
        take_columns(table, setup, facts, time, log);
    }
    check(table, log, setup);
    return log;
}

std::optional<double> number_or_none(const TextTable& table, std::size_t row,
                                     const std::vector<records::TableCell>& cells,
                                     const std::optional<NumberColumn>& column) {
    if (!column || is_missing(cells[column->index].text)) return std::nullopt;
    return number_in(table, row, cells, *column);
}

std::optional<LogEntry> log_entry(const TextTable& table, std::size_t row,
                                  const std::vector<records::TableCell>& cells,
                                  const AxisColumns& axis) {
    const auto commanded = number_or_none(table, row, cells, axis.commanded);
    const auto read = number_or_none(table, row, cells, axis.actual ? axis.actual : axis.error);
    if (!commanded || !read) return std::nullopt;
    const double error = axis.actual ? *read - *commanded : axis.error_sign * *read;
    return LogEntry{*commanded, axis.rotary ? std::remainder(error, 2.0 * pi) : error};
}

double without_roll_over(AxisColumns& axis, double commanded) {
    if (!axis.rotary) return commanded;
    const double step = axis.last_rad ? commanded + axis.turns_rad - *axis.last_rad : 0.0;
    if (std::abs(std::abs(step) - 2.0 * pi) < longest_step_rad) {
        axis.turns_rad -= std::copysign(2.0 * pi, step);
        axis.rolled_over = true;
    }
    axis.last_rad = commanded + axis.turns_rad;
    return *axis.last_rad;
}

std::string axes_words(const LogColumns& log) {
    std::string out;
    for (const AxisColumns& axis : log.axes)
        if (axis.read() || log.places_only())
            out += (out.empty() ? "" : ", ") + axis.name +
                   (axis.velocity ? " (with commanded speed)" : "");
    return out;
}

std::vector<std::string> log_notes(const TextTable& table, const LogColumns& log) {
    std::vector<std::string> notes;
    if (log.units_assumed)
        notes.push_back(table.path() + ": columns without unit taken as mm, deg, mm/s");
    for (const AxisColumns& axis : log.axes)
        if (axis.rolled_over)
            notes.push_back(table.path() + ": " + axis.name +
                            ": steps between 0 and 360 deg are taken as motion that goes on");
    for (const AxisColumns& axis : log.axes)
        if (axis.missing > 0)
            notes.push_back(fmt::format("{}: {}: {} rows without a value are left out",
                                        table.path(), axis.name, axis.missing));
    for (const std::string& name : log.taken_as_actual)
        notes.push_back(table.path() + ": '" + name + "' taken as the actual position");
    for (const std::string& name : log.unused)
        notes.push_back(table.path() + ": column '" + name + "' is not used");
    return notes;
}

}  // namespace trunnion::imports
