#include "emulator/ballbar_station.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.h"
#include "base/units.h"

namespace trunnion {
namespace {

/// Places of a move at which "stays within range" is looked at.
constexpr int range_checks = 16;
/// A sample this close to the end of a move is at its end, not at the next one's beginning.
constexpr double end_rad = 1e-9;

constexpr double farthest_reach_mm = 5000.0;  ///< of a point from a rotary axis, on the safe side
constexpr double effects_mm = 5.0;            ///< more than errors and effects change a distance

/// No two points of the machine come nearer to each other than by this between two positions.
double farthest_way_mm(const AxisPositions& a, const AxisPositions& b) {
    double way_mm = 0.0;
    for (const Axis axis : all_axes)
        way_mm += std::abs(b[axis] - a[axis]) * (is_rotary(axis) ? farthest_reach_mm : 1.0);
    return way_mm;
}

double swept_rad(const AxisMove& move) {
    double most = move.arc ? std::abs(move.arc->sweep_rad) : 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        most = std::max(most, std::abs(move.to[axis] - move.from[axis]));
    return most;
}

std::string place_of(const AxisMove& move) {
    return (move.program ? *move.program : std::string("program")) + ':' +
           std::to_string(move.line);
}

}  // namespace

BallbarStation::BallbarStation(const Setup& setup, std::uint64_t seed)
    : setup_(setup), noise_(seed) {}

void BallbarStation::start(double time_s) {
    commanded_ = ever_commanded_ = running_ = true;
    out_of_range_ = false;
    start_s_ = time_s;
    angle_left_rad_ = 0.0;
}

void BallbarStation::stop() {
    commanded_ = running_ = false;
}

double BallbarStation::deviation_mm(const PathSampler& path, double s,
                                    const PhysicalMachine& machine, Contact contact,
                                    Contact* filled) const {
    Ballbar bar{setup_.ballbar->cup_with(path.shop.extension_mm), pivot_->center_W_mm,
                setup_.ballbar->warm_length_mm()};
    const AxisSample sample = path.at(s);
    const MachinePose nominal = machine.at(sample, contact).poses;
    contact.direction_M = cup_to_pivot_M(nominal, bar).normalized();
    contact.direction_W = nominal.pose_MW.rotation.transpose() * contact.direction_M;
    const PhysicalState state = machine.at(sample, contact);
    bar.cup_S_mm += state.extra.tip_shift_mm;
    bar.pivot_W_mm += state.extra.work_shift_mm;
    if (filled) *filled = contact;
    return length_deviation_mm(state.poses, bar) + state.extra.reading_mm;
}

const Artefact* BallbarStation::mounted_pivot(const PathSampler& path,
                                              const PhysicalMachine& machine) {
    const Ballbar bar;
    if (!commanded_ && apart_mm_ > farthest_way_mm(apart_at_, path.move.from)) return nullptr;
    apart_mm_ = std::numeric_limits<double>::infinity();
    apart_at_ = path.move.from;
    for (const Artefact& artefact : setup_.artefacts) {
        if (artefact.kind != Artefact::Kind::center_pivot) continue;
        pivot_ = &artefact;
        bool inside = true;
        for (int i = 0; i <= range_checks && inside; ++i) {
            const double off_mm =
                deviation_mm(path, static_cast<double>(i) / range_checks, machine, {}, nullptr);
            if (i == 0)
                apart_mm_ = std::min(apart_mm_, std::abs(off_mm) - bar.range_mm - effects_mm);
            inside = in_range(off_mm, bar);
        }
        if (inside || commanded_) return pivot_;
    }
    return nullptr;
}

std::vector<double> BallbarStation::places(const PathSampler& path) {
    const AxisMove& move = path.move;
    std::vector<double> places;
    const double angle = swept_rad(move),
                 step = rad_from_deg(sample_deg_ > 0.0 ? sample_deg_ : setup_.ballbar->sample_deg);
    if (step > 0.0 && angle > 0.0) {
        for (; angle_left_rad_ < angle + end_rad; angle_left_rad_ += step)
            places.push_back(std::clamp(angle_left_rad_ / angle, 0.0, 1.0));
        angle_left_rad_ -= angle;
    } else if (move.duration_s > 0.0) {
        for (const double t :
             sample_times(start_s_, setup_.ballbar->sample_hz, path.start_s, path.time_s(1.0)))
            places.push_back(std::clamp((t - path.start_s) / move.duration_s, 0.0, 1.0));
    }
    return places;
}

void BallbarStation::read(PathSampler path, double s, const PhysicalMachine& machine,
                          ReadingLog& log) {
    Contact contact;
    contact.device = Device::ballbar;
    contact.artefact = static_cast<int>(pivot_ - setup_.artefacts.data());
    contact.acceleration = path.acceleration(s);
    contact.extension_mm = path.shop.extension_mm;
    const double noise_mm = mm_from_um(setup_.ballbar->noise_um) * noise_.normal();
    const double value_mm = deviation_mm(path, s, machine, contact, &contact) + noise_mm;
    if (!in_range(value_mm, Ballbar{})) {
        if (!std::exchange(out_of_range_, true))
            notes_.push_back(place_of(path.move) + ": the ballbar is out of its range of 1 mm (" +
                             shortest(std::round(value_mm * 1e6) / 1e6) + " mm) in test " +
                             log.test() + "; no readings there");
        return;
    }
    Reading row;
    row.time_s = path.time_s(s);
    row.device = Device::ballbar;
    row.feature = pivot_->name;
    row.mode = path.mode;
    row.commanded = path.move.at(s);
    row.value_mm = value_mm;
    row.feed_mm_min = path.move.feed_mm_min;
    set_up_like(path.shop, row);
    log.add(std::move(row));
}

bool BallbarStation::record(const PathSampler& move, const PhysicalMachine& machine,
                            ReadingLog& log, AxisTracker& tracker) {
    if (!setup_.ballbar) return false;
    const bool automatic = !ever_commanded_ && move.move.kind != MotionKind::rapid;
    pivot_ = commanded_ || automatic ? mounted_pivot(move, machine) : nullptr;
    if (!pivot_) {
        running_ = commanded_;
        return false;
    }
    if (!running_) {
        running_ = true;
        start_s_ = move.start_s;
        angle_left_rad_ = 0.0;
        log.set_test("bar" + std::to_string(++passes_));
    }
    PathSampler path = move;
    path.by_velocity = true;
    if (move.move.duration_s > 0.0)
        path.half_step = std::min(0.5, 1.0 / (setup_.ballbar->sample_hz * move.move.duration_s));
    for (const double s : places(path)) {
        tracker.advance(path.move.at(s));
        read(path, s, machine, log);
    }
    return true;
}

}  // namespace trunnion
