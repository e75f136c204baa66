#include "emulator/measure_station.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/random.h"
#include "emulator/device_noise.h"
#include "emulator/replay.h"

namespace trunnion::emulator {
namespace {

constexpr double most_hz = 1e5;

/// Compares without case, because a control prints capital letters only.
bool same_name(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::toupper(static_cast<unsigned char>(x)) ==
               std::toupper(static_cast<unsigned char>(y));
    });
}

[[noreturn]] void refuse(const std::string& message) {
    throw InputError("MEASURE: " + message);
}

std::vector<std::string> split(std::string_view text) {
    std::istringstream in{std::string(text)};
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

}  // namespace

records::Reading MeasureStation::target_row(records::Device device, std::string_view name) const {
    for (const setup::Artefact& artefact : setup_.artefacts)
        if (artefact.kind == setup::Artefact::Kind::target && same_name(artefact.name, name)) {
            records::Reading row;
            row.device = device;
            row.feature = artefact.name;
            row.angular = device == records::Device::angle;
            return row;
        }
    refuse("the setup has no target '" + std::string(name) + "'");
}

void MeasureStation::add_displacement(records::Device device,
                                      const std::vector<std::string>& words) {
    const std::size_t d = words.size() == 3 && words[2].size() == 1
                              ? std::string_view("XYZxyz").find(words[2][0])
                              : std::string_view::npos;
    if (d == std::string_view::npos)
        refuse("a target and X, Y or Z follow, as in '" + words[0] + " R1 X'");
    records::Reading row = target_row(device, words[1]);
    row.direction_M = Vector3::Unit(static_cast<Eigen::Index>(d % 3));
    static_.push_back(row);
}

void MeasureStation::add_point(const std::vector<std::string>& words) {
    if (words.size() < 2 || words.size() > 3)
        refuse("a target, and an instrument where there are several, follow: 'POINT R1 TRACKER'");
    records::Reading row = target_row(records::Device::point, words[1]);
    if (words.size() == 3) {
        for (const setup::Instrument& instrument : setup_.instruments)
            if (same_name(instrument.name, words[2])) row.instrument = instrument.name;
        if (row.instrument.empty()) refuse("the setup has no instrument '" + words[2] + "'");
    }
    for (int d = 0; d < 3; ++d) {
        row.direction_M = Vector3::Unit(d);
        static_.push_back(row);
    }
}

void MeasureStation::add_axis(const std::vector<std::string>& words, double time_s) {
    const auto hz = words.size() == 3 ? parse_number(words[2]) : std::optional(1.0 / step_s_);
    if (words.size() < 2 || words.size() > 3 || !hz || *hz <= 0.0 || *hz > most_hz)
        refuse("an axis, and how often a second, follow: 'AXIS X 250'");
    std::string names;
    for (const kinematics::AxisGeometry& axis : setup_.machine.chain.axes()) {
        names += (names.empty() ? "" : ", ") + axis.name;
        if (same_name(axis.name, words[1])) {
            records::Reading row;
            row.device = records::Device::axis;
            row.feature = axis.name;
            row.angular = axis.rotary;
            if (logged_.empty()) next_s_ = time_s;
            step_s_ = 1.0 / *hz;
            logged_.push_back(row);
            return;
        }
    }
    refuse("the machine has no axis '" + words[1] + "'; it has " + names);
}

void MeasureStation::obey(std::string_view text, double time_s) {
    const std::vector<std::string> words = split(text);
    const std::string_view device = words.empty() ? std::string_view() : words[0];
    if (same_name(device, "linear")) return add_displacement(records::Device::linear, words);
    if (same_name(device, "angle")) return add_displacement(records::Device::angle, words);
    if (same_name(device, "point")) return add_point(words);
    if (same_name(device, "axis")) return add_axis(words, time_s);
    if (!same_name(device, "off"))
        refuse("'" + std::string(text) + "' is none of LINEAR, ANGLE, POINT, AXIS, OFF");
    static_.clear();
    logged_.clear();
}

/// `now` is the row of a device; `row` gives the settings of operator and control.
template <typename Place>
void MeasureStation::take_log(const records::Reading& row, double duration_s, const Place& place,
                              ReadingLog& log) {
    if (logged_.empty()) return;
    for (; next_s_ <= row.time_s + duration_s; next_s_ += step_s_) {
        if (next_s_ < row.time_s) continue;
        records::Reading now = row;
        now.time_s = next_s_;
        now.commanded = place(duration_s > 0.0 ? (next_s_ - row.time_s) / duration_s : 1.0);
        now.device = records::Device::axis;
        for (const records::Reading& logged : logged_) {
            now.feature = logged.feature;
            now.angular = logged.angular;
            log.add(now);
        }
    }
}

void MeasureStation::dwell(const records::Reading& row, double duration_s, ReadingLog& log) {
    take_log(
        row, duration_s, [&](double) { return row.commanded; }, log);
    for (const records::Reading& device : static_) {
        records::Reading now = row;
        now.time_s = row.time_s + duration_s;
        now.device = device.device;
        now.feature = device.feature;
        now.direction_M = device.direction_M;
        now.angular = device.angular;
        now.instrument = device.instrument;
        log.add(now);
    }
}

void MeasureStation::record(const motion::AxisMove& move, const records::Reading& row,
                            ReadingLog& log) {
    records::Reading moving = row;
    moving.feed_mm_min = move.feed_mm_min;
    take_log(
        moving, move.duration_s, [&](double s) { return move.at(s); }, log);
}

void fill_readings(const setup::Setup& setup, const EffectModels& effects, std::uint64_t seed,
                   records::ReadingTable& table) {
    const auto waits = [](const records::Reading& row) {
        return row.device != records::Device::none && !row.value_mm;
    };
    if (std::none_of(table.rows.begin(), table.rows.end(), waits)) return;
    const Replay replay(setup, table);
    const std::vector<double> value_mm = replay.predict(effects);
    SeededNoise noise(seed);
    for (std::size_t i = 0; i < replay.size(); ++i) {
        records::Reading& row = table.rows[replay.table_row(i)];
        if (waits(row))
            row.value_mm = value_mm[i] + device_noise(setup.model, row).sigma_mm * noise.normal();
    }
}

}  // namespace trunnion::emulator
