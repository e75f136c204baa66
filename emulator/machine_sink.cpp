#include "emulator/machine_sink.h"

#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/units.h"
#include "emulator/follow_move.h"
#include "motion/tool_centre_point.h"
#include "setup/control_axes.h"

namespace trunnion::emulator {
namespace {

/// Smaller rotation is rounding of an axis at rest.
constexpr double standing_rad = 1e-9;

std::vector<Axis> axes_of(const std::vector<kinematics::AxisGeometry>& machine_axes) {
    std::vector<Axis> axes;
    for (const kinematics::AxisGeometry& axis : machine_axes)
        if (is_letter(axis)) axes.push_back(axis.axis);
    return axes;
}

bool turns(const motion::AxisMove& move) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        if (std::abs(move.from[axis] - move.to[axis]) > standing_rad) return true;
    return false;
}

class MovePath : public motion::PathCurve {
  public:
    explicit MovePath(const motion::AxisMove& move) : move_(move) {}
    AxisPositions at(double s) const override { return move_.at(s); }

  private:
    const motion::AxisMove& move_;
};

/// Path length of the programmed point, or the longer one of X Y Z and of the believed tip in W:
/// under G43.4 and M128 the axes may move while the tip is at rest, and a turning table carries the
/// tip along an arc while X Y Z are at rest.
double longer_way_mm(const motion::AxisMove& move) {
    const bool turning = turns(move);
    if (move.arc && !turning) return move.length_mm;
    const int parts = move.curve || turning ? 4 * motion::curve_parts(move.from, move.to) : 1;
    double axes_mm = 0.0, tip_mm = 0.0;
    AxisPositions before = move.from;
    for (int k = 1; k <= parts; ++k) {
        const AxisPositions now = move.at(static_cast<double>(k) / parts);
        axes_mm += (move.parallel.linear(now) - move.parallel.linear(before)).norm();
        tip_mm += (believed_tool(move, now).tip_W_mm - believed_tool(move, before).tip_W_mm).norm();
        before = now;
    }
    return std::max({move.length_mm, axes_mm, tip_mm});
}

}  // namespace

MachineSink::MachineSink(const setup::Setup& setup, EffectModels effects,
                         const SinkOptions& options)
    : setup_(setup),
      options_(options),
      machine_(setup, std::move(effects)),
      touch_(setup, options.seed),
      bar_(setup, options.seed ^ 0x5bd1e995u,  // not the stream of the probe
           options.automatic_ballbar),
      measure_(setup),
      meant_(setup),
      log_(axes_of(setup.machine.chain.axes()), setup.side_before, options.test),
      history_(setup.side_before),
      test_(options.test) {
    for (const std::string& words : options.measure) measure_.obey(words, 0.0);
    can_read_ = setup.probe || setup.ballbar || !setup.artefacts.empty() || !setup.tools.empty() ||
                !options.measure.empty();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        has_rotary_ |= axis.rotary;
    if (has_rotary_) mode_ = plain_mode_ = PositioningMode::dpp;
    if (options.trace)
        trace_.emplace(axes_of(setup::control_axes(setup)), options.truth, options.trace_chunk);
}

void MachineSink::place(const AxisPositions& machine) {
    history_.place(machine);
    at_ = machine;
}

void MachineSink::printed(std::string_view text) {
    for (const char c : text) {
        if (c != '\n') {
            if (c != '\r') line_ += c;
            continue;
        }
        obey(line_);
        line_.clear();
    }
}

/// The bar stops reading; the following rows belong to the test again.
void MachineSink::end_pass() {
    bar_.stop(machine_, log_);
    log_.set_test(test_);
}

records::ReadingTable MachineSink::take_readings() {
    end_pass();
    return log_.take();
}

void MachineSink::obey(std::string_view line) {
    constexpr std::string_view test = "TEST ", on = "BALLBAR ON", off = "BALLBAR OFF";
    if (line.starts_with(off)) end_pass();
    if (line.starts_with(test)) {
        test_ = records::told_name(line.substr(test.size()));
        end_pass();
    }
    if (line.starts_with(on)) {
        end_pass();
        log_.set_pass(records::told_name(line.substr(on.size())));
        bar_.start(clock_s_);
    }
    if (const auto words = records::told_words(line, "MEASURE")) {
        measure_.obey(*words, clock_s_);
        can_read_ = true;
    }
    set_shop(line);
}

void MachineSink::set_shop(std::string_view line) {
    records::take_told(line, shop_);
    if (const auto mode = records::told_mode(line); mode && has_rotary_) mode_ = *mode;
    if (const auto words = records::told_words(line, "POSITIONS"); words && has_rotary_)
        plain_mode_ = mode_ =
            words->starts_with("DIRECT") ? PositioningMode::none : PositioningMode::dpp;
    if (const auto words = records::told_words(line, "SAMPLE"))
        if (const auto degrees = parse_number(*words); degrees && *degrees > 0.0)
            bar_.sample_every(*degrees);
}

/// A move under a positioning function sets the mode; a rotation without any function means that
/// the program does the arithmetic (dpp). Probing moves after the function was cancelled keep its
/// mode.
void MachineSink::follow_mode(const motion::AxisMove& move) {
    if (move.mode != PositioningMode::none && move.mode != PositioningMode::dpp)
        mode_ = move.mode;
    else if (has_rotary_ && turns(move))
        mode_ = plain_mode_;
}

Vector3 MachineSink::true_tip_W(const PathSampler& path, double s) const {
    return physical_tip_W(machine_.at(path.at(s), tip_contact(setup_, path.move)),
                          physical_tip_S(setup_, path.move, shop_.extension_mm));
}

void MachineSink::write_trace(const PathSampler& path, double end_s) {
    const auto row = [&](double s, bool end) {
        const Vector3 tip = options_.truth ? true_tip_W(path, s) : Vector3::Zero();
        trace_->add(path.move, s, path.time_s(s), end, &tip);
    };
    for (const double s : sample_places(path.move))
        if (s < end_s - 1e-9) row(s, false);
    row(end_s, true);
}

/// Values of s for the SAMPLE rows of a move, ascending.
std::vector<double> MachineSink::sample_places(const motion::AxisMove& move) const {
    std::vector<double> places;
    const double way_mm = options_.trace_step_mm > 0.0 ? longer_way_mm(move) : 0.0;
    if (way_mm > 0.0)
        for (int i = 1; i * options_.trace_step_mm < way_mm; ++i)
            places.push_back(i * options_.trace_step_mm / way_mm);
    if (options_.trace_chord_mm <= 0.0 || !(move.arc || move.curve)) return places;
    const auto steps = motion::chord_steps(MovePath(move), options_.trace_chord_mm);
    places.insert(places.end(), steps.begin() + 1, steps.end());
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

/// A row with the operator's present settings.
records::Reading MachineSink::row_now() const {
    records::Reading row;
    row.time_s = clock_s_;
    row.mode = mode_;
    records::put_shop(shop_, row);
    return row;
}

void MachineSink::dwell(double duration_s) {
    records::Reading row = row_now();
    row.commanded = at_;
    measure_.dwell(row, duration_s, log_);
    clock_s_ += duration_s;
}

std::optional<Touch> MachineSink::probe(const motion::AxisMove& move) {
    if (!move.until_skip || !touch_.mounted(move)) return std::nullopt;
    if (!bar_.commanded()) end_pass();
    log_.passed(move.from, clock_s_, mode_);
    auto touch = touch_.touch(move, row_now(), machine_, log_);
    if (!touch || touch->row.device == records::Device::none) return touch;
    records::Reading& row = touch->row;
    row.point_W_mm = meant_.at(row.mode, row.commanded, row.extension_mm);
    log_.add(row);
    return touch;
}

motion::MoveResult MachineSink::move(const motion::AxisMove& move) {
    follow_mode(move);
    if (can_read_ && log_.empty()) log_.passed(move.from, clock_s_, mode_);
    const std::optional<Touch> touch = probe(move);
    const double end_s = touch ? touch->s : 1.0;
    if (trace_) write_trace({move, history_, clock_s_, mode_, shop_}, end_s);
    bool read = bar_.listens() && !move.until_skip && bar_.record(move, row_now(), log_);
    if (!read && measure_.logs() && !touch) {
        measure_.record(move, row_now(), log_);
        read = true;
    }
    if (!read && bar_.running() && !bar_.commanded()) end_pass();
    const AxisPositions end = at_ = touch ? touch->stopped : move.to;
    clock_s_ += end_s * move.duration_s;
    const bool kept = touch && touch->row.device != records::Device::none;
    if (!read && !kept && can_read_) log_.passed(end, clock_s_, mode_);
    if (options_.truth && !touch) follow(history_, move);
    if (options_.truth && touch) history_.advance(end);
    return {touch.has_value(), end, end_s};
}

}  // namespace trunnion::emulator
