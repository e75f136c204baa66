#include "emulator/touch_station.h"

#include <algorithm>

#include "base/units.h"
#include "emulator/body_touch.h"
#include "emulator/replay.h"
#include "kinematics/tool_sense.h"

namespace trunnion::emulator {
namespace {

/// True when only X, Y and Z move, on a straight line: then it is also the line of the row.
bool is_plain(const motion::AxisMove& move) {
    if (move.arc || move.curve) return false;
    for (const Axis axis : all_axes)
        if (axis != Axis::X && axis != Axis::Y && axis != Axis::Z &&
            move.from[axis] != move.to[axis])
            return false;
    return true;
}

/// A move towards one sphere, and the contact of its ball.
class Approach {
  public:
    Approach(const motion::AxisMove& move, records::Reading row, const Observer& observer,
             const ReadingLog& log)
        : move_(move), row_(std::move(row)), observer_(observer), log_(log) {
        const Vector3 way = gauge(move.to) - gauge(move.from);
        length_mm_ = way.norm();
        start_s_ = row_.time_s;
        row_.commanded = move.to;
        row_.device = records::Device::touch;
        row_.feed_mm_min = move.feed_mm_min;
        row_.direction_M = length_mm_ > 0.0 ? Vector3(way / length_mm_) : Vector3::UnitZ();
    }

    /// With the row's value, without noise; s is that of the contact. Empty when the ball misses.
    std::optional<Touch> on(const std::string& sphere) {
        row_.feature = sphere;
        row_.time_s = start_s_ + move_.duration_s;
        return is_plain(move_) && length_mm_ > 0.0 ? straight() : along_path();
    }
    double length_mm() const { return length_mm_; }

  private:
    /// Of the tool relative to the work, in M.
    Vector3 gauge(const AxisPositions& q) const {
        return kinematics::tool_senses(observer_.setup().machine.chain)
            .cwiseProduct(move_.parallel.linear(q));
    }
    DeviceRow ready() const { return device_row(observer_, row_, log_.sample_of(row_)); }

    std::optional<Touch> straight() {
        DeviceRow at = ready();
        const double rough_mm = observer_.touch(at.sample, at.contact).contact_mm;
        if (rough_mm > length_mm_ || rough_mm < -2.0 * length_mm_) return std::nullopt;
        row_.time_s = start_s_ + move_.duration_s * part(rough_mm);
        at.sample.time_s = row_.time_s;
        const TouchReading touch = observer_.touch(at.sample, at.contact);
        if (!touch.meets || touch.contact_mm > 0.0) return std::nullopt;
        if (touch.contact_mm < -length_mm_) return in_contact(at);
        return done(part(touch.contact_mm), touch.value_mm);
    }

    /// The skip signal is present before the move starts: it stops at once, without a measurement.
    std::optional<Touch> in_contact(DeviceRow at) {
        at.sample.position = move_.from;
        if (observer_.centre_to_tip_M(at.sample, at.contact).norm() >
            observer_.reach_mm(at.contact))
            return std::nullopt;
        Touch touch = done(0.0, -length_mm_);
        touch.row.device = records::Device::none;
        return touch;
    }

    std::optional<Touch> along_path() {
        const DeviceRow at = ready();
        const auto here = [&](double s) {
            AxisSample sample = at.sample;
            sample.position = move_.at(s);
            return sample;
        };
        const auto s = probe::first_contact(
            [&](double t) { return observer_.centre_to_tip_M(here(t), at.contact); },
            observer_.reach_mm(at.contact));
        if (!s) return std::nullopt;
        row_.time_s = start_s_ + move_.duration_s * *s;
        const double later_mm = observer_.at(here(*s), at.contact).extra.reading_mm;
        return done(*s, length_mm_ * (*s - 1.0) + later_mm);
    }

    double part(double value_mm) const { return std::clamp(1.0 + value_mm / length_mm_, 0.0, 1.0); }

    Touch done(double s, double value_mm) {
        Touch touch{s, {}, row_};
        touch.row.value_mm = value_mm;
        return touch;
    }

    const motion::AxisMove& move_;
    records::Reading row_;
    const Observer& observer_;
    const ReadingLog& log_;
    double length_mm_ = 0.0, start_s_ = 0.0;
};

}  // namespace

const setup::PhysicalTool* TouchStation::tool_in_spindle(const motion::AxisMove& move) const {
    const auto tool = setup_.tools.find(move.tool);
    const bool is_probe = setup_.probe && move.tool == setup_.probe->tool;
    return tool == setup_.tools.end() || is_probe ? nullptr : &tool->second;
}

bool TouchStation::mounted(const motion::AxisMove& move) const {
    if (tool_in_spindle(move)) return true;
    if (!setup_.probe) return false;
    return setup_.probe->tool == 0 || move.tool == 0 || move.tool == setup_.probe->tool;
}

std::optional<Touch> TouchStation::touch(const motion::AxisMove& move, records::Reading row,
                                         const Observer& observer, const ReadingLog& log) {
    std::optional<Touch> body = touch_body(move, row, observer, log);
    if (tool_in_spindle(move)) return body;
    std::optional<Touch> sphere = touch_sphere(move, std::move(row), observer, log);
    return body && (!sphere || body->s < sphere->s) ? body : sphere;
}

/// No reading: features of the setup and tables of readings have spheres only.
std::optional<Touch> TouchStation::touch_body(const motion::AxisMove& move, records::Reading row,
                                              const Observer& observer, const ReadingLog& log) {
    if (setup_.bodies.empty()) return std::nullopt;
    row.commanded = move.to;
    row.feed_mm_min = move.feed_mm_min;
    const setup::PhysicalTool* tool = tool_in_spindle(move);
    const Feeler feeler = tool ? feeler_of(*tool, move, row.spindle_rad) : stylus_of(*setup_.probe);
    const auto found = touch_bodies(move, log.sample_of(row), feeler, observer);
    if (!found) return std::nullopt;
    Touch touch{found->s, {}, std::move(row)};
    const double sigma_um = tool ? found->body->repeatability_um : setup_.probe->repeatability_um;
    if (const double length_mm =
            (move.parallel.linear(move.to) - move.parallel.linear(move.from)).norm();
        length_mm > 0.0 && sigma_um > 0.0)
        touch.s += mm_from_um(sigma_um) * noise_.normal() / length_mm;
    touch.s = std::clamp(touch.s, 0.0, 1.0);
    touch.stopped = move.at(touch.s);
    touch.row.device = records::Device::none;
    return touch;
}

std::optional<Touch> TouchStation::touch_sphere(const motion::AxisMove& move, records::Reading row,
                                                const Observer& observer, const ReadingLog& log) {
    Approach approach(move, std::move(row), observer, log);
    std::optional<Touch> first;
    for (const setup::Artefact& artefact : setup_.artefacts) {
        if (artefact.kind != setup::Artefact::Kind::sphere) continue;
        auto touch = approach.on(artefact.name);
        if (touch && (!first || touch->s < first->s)) first = std::move(touch);
    }
    if (!first) return first;
    double& value_mm = *first->row.value_mm;
    value_mm += mm_from_um(setup_.probe->repeatability_um) * noise_.normal();
    if (value_mm > 0.0) return std::nullopt;
    const double length_mm = approach.length_mm();
    if (length_mm > 0.0) first->s = std::clamp(1.0 + value_mm / length_mm, 0.0, 1.0);
    first->stopped = move.at(first->s);
    if (length_mm == 0.0) first->row.device = records::Device::none;
    return first;
}

}  // namespace trunnion::emulator
