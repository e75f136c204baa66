#include "emulator/ballbar_station.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/ballbar.h"
#include "base/numbers.h"
#include "base/units.h"
#include "emulator/replay.h"

namespace trunnion::emulator {
namespace {

/// Number of positions of a move at which the range is checked.
constexpr int range_checks = 16;
/// A sample this close to the end of a move belongs to its end, not to the start of the next move.
constexpr double end_rad = 1e-9;

constexpr double farthest_reach_mm = 5000.0;  ///< upper bound for the distance of a point from a
                                              ///< rotary axis
constexpr double effects_mm = 5.0;            ///< upper bound for the change of a distance by
                                              ///< errors and effects

/// Upper bound for the change of the distance between two points of the machine from one position
/// to the other, mm.
double farthest_way_mm(const AxisPositions& a, const AxisPositions& b) {
    double way_mm = 0.0;
    for (const Axis axis : all_axes)
        way_mm += std::abs(b[axis] - a[axis]) * (is_rotary(axis) ? farthest_reach_mm : 1.0);
    return way_mm;
}

double swept_rad(const motion::AxisMove& move) {
    double most = move.arc ? std::abs(move.arc->sweep_rad) : 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        most = std::max(most, std::abs(move.to[axis] - move.from[axis]));
    return most;
}

std::string place_of(const motion::AxisMove& move) {
    return (move.program ? *move.program : std::string("program")) + ':' +
           std::to_string(move.line);
}

}  // namespace

BallbarStation::BallbarStation(const setup::Setup& setup, std::uint64_t seed, bool automatic)
    : setup_(setup), nominal_(setup.machine), noise_(seed), automatic_(automatic) {}

void BallbarStation::start(double time_s) {
    commanded_ = setup_.ballbar.has_value();
    start_s_ = time_s;
    angle_left_rad_ = 0.0;
}

/// Ball-to-ball length - nominal length without effects, mm.
double BallbarStation::nominal_mm(const motion::AxisMove& move, double s,
                                  const setup::Artefact& pivot, const records::Reading& row) const {
    const ballbar::Ballbar bar{setup_.ballbar->cup_with(row.extension_mm), pivot.center_W_mm,
                               setup_.ballbar->warm_length_mm()};
    return ballbar::length_deviation_mm(nominal_.poses(move.at(s), row.spindle_rad), bar);
}

bool BallbarStation::stays_in_range(const motion::AxisMove& move, const setup::Artefact& pivot,
                                    const records::Reading& row) {
    const ballbar::Ballbar bar;
    for (int i = 0; i <= range_checks; ++i) {
        const double off_mm = nominal_mm(move, static_cast<double>(i) / range_checks, pivot, row);
        if (i == 0) apart_mm_ = std::min(apart_mm_, std::abs(off_mm) - bar.range_mm - effects_mm);
        if (!ballbar::in_range(off_mm, bar)) return false;
    }
    return true;
}

/// With BALLBAR ON: the pivot that the bar reaches best. Automatic: a pivot within range during the
/// whole move.
void BallbarStation::choose_pivot(const motion::AxisMove& move, const records::Reading& row) {
    if (commanded_ && pivot_) return;
    const bool looks = commanded_ || (automatic_ && move.kind != motion::MotionKind::rapid);
    pivot_ = nullptr;
    if (!looks || (!commanded_ && apart_mm_ > farthest_way_mm(apart_at_, move.from))) return;
    apart_mm_ = std::numeric_limits<double>::infinity();
    apart_at_ = move.from;
    double nearest_mm = std::numeric_limits<double>::infinity();
    for (const setup::Artefact& artefact : setup_.artefacts) {
        if (artefact.kind != setup::Artefact::Kind::center_pivot) continue;
        const double off_mm = std::abs(nominal_mm(move, 0.0, artefact, row));
        if (off_mm >= nearest_mm || (!commanded_ && !stays_in_range(move, artefact, row))) continue;
        nearest_mm = off_mm;
        pivot_ = &artefact;
    }
}

std::vector<double> BallbarStation::places(const motion::AxisMove& move, double time_s) {
    std::vector<double> places;
    const double angle = swept_rad(move),
                 step = rad_from_deg(sample_deg_ > 0.0 ? sample_deg_ : setup_.ballbar->sample_deg);
    if (step > 0.0 && angle > 0.0) {
        for (; angle_left_rad_ < angle + end_rad; angle_left_rad_ += step)
            places.push_back(std::clamp(angle_left_rad_ / angle, 0.0, 1.0));
        angle_left_rad_ -= angle;
    } else if (move.duration_s > 0.0) {
        for (const double t : ballbar::sample_times(start_s_, setup_.ballbar->sample_hz, time_s,
                                                    time_s + move.duration_s))
            places.push_back(std::clamp((t - time_s) / move.duration_s, 0.0, 1.0));
    }
    return places;
}

bool BallbarStation::record(const motion::AxisMove& move, const records::Reading& row,
                            ReadingLog& log) {
    if (!listens()) return false;
    choose_pivot(move, row);
    if (!pivot_) return false;
    if (moves_.empty() && !commanded_) {
        start_s_ = row.time_s;
        angle_left_rad_ = 0.0;
        log.set_pass("bar" + std::to_string(++passes_));
    }
    moves_.push_back({std::numeric_limits<std::size_t>::max(), place_of(move)});
    for (const double s : places(move, row.time_s)) {
        records::Reading reading = row;
        reading.time_s = row.time_s + s * move.duration_s;
        reading.device = records::Device::ballbar;
        reading.feature = pivot_->name;
        reading.commanded = move.at(s);
        reading.feed_mm_min = move.feed_mm_min;
        log.add(std::move(reading));
        if (moves_.back().row > log.size()) moves_.back().row = log.size() - 1;
    }
    return true;
}

void BallbarStation::note_out_of_range(std::size_t row, double value_mm, const std::string& test) {
    std::string place = moves_.front().text;
    for (const Place& move : moves_)
        if (move.row <= row) place = move.text;
    notes_.push_back(place + ": the ballbar is out of its range of 1 mm (" +
                     shortest(std::round(value_mm * 1e6) / 1e6) + " mm) in test " + test +
                     "; no readings there");
}

void BallbarStation::read_pass(const Observer& observer, ReadingLog& log,
                               const std::vector<double>& noise_mm) {
    const std::span<records::Reading> rows = log.pass();
    const std::vector<AxisSample> samples = log.pass_samples(setup_.time_constant_s);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k].device != records::Device::ballbar) continue;
        const DeviceRow ready = device_row(observer, rows[k], samples[k]);
        rows[k].value_mm = observer.read(ready.sample, ready.contact) + noise_mm[k];
    }
}

/// Rows beyond the range remain in the path, without a reading.
void BallbarStation::stop(const Observer& observer, ReadingLog& log) {
    if (!moves_.empty()) {
        const std::span<records::Reading> rows = log.pass();
        std::vector<double> noise_mm(rows.size());
        for (double& noise : noise_mm)
            noise = mm_from_um(setup_.ballbar->noise_um) * noise_.normal();
        read_pass(observer, log, noise_mm);
        bool out = false;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            records::Reading& row = rows[k];
            if (!row.value_mm || ballbar::in_range(*row.value_mm, ballbar::Ballbar{})) continue;
            if (!std::exchange(out, true))
                note_out_of_range(log.size() - rows.size() + k, *row.value_mm, log.test());
            row.device = records::Device::none;
            row.value_mm.reset();
        }
        if (out) read_pass(observer, log, noise_mm);
    }
    moves_.clear();
    pivot_ = nullptr;
    commanded_ = false;
}

}  // namespace trunnion::emulator
