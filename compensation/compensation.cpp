#include "compensation/compensation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "compensation/flat_program.h"
#include "compensation/path_stretches.h"
#include "compensation/tip_corrector.h"
#include "emulator/follow_move.h"

namespace trunnion::compensation {
namespace {

constexpr int deepest_split = 16;
constexpr double reach_mm = 500.0;  ///< upper bound for the lever arm of a rotary deviation

AxisPositions between(const AxisPositions& a, const AxisPositions& b, double t) {
    AxisPositions q;
    for (std::size_t i = 0; i < axis_count; ++i)
        q.value[i] = a.value[i] + t * (b.value[i] - a.value[i]);
    return q;
}

/// Distance of two positions, with rotary deviations multiplied by the lever arm.
double apart_mm(const AxisPositions& a, const AxisPositions& b) {
    double rotary = 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) rotary += std::abs(a[axis] - b[axis]);
    return (xyz_of(a) - xyz_of(b)).norm() + reach_mm * rotary;
}

bool turns(const motion::AxisMove& move) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        if (move.from[axis] != move.to[axis]) return true;
    return false;
}

/// 0, 1, 2 when the arc's normal is along X, Y or Z, else -1.
int plane_normal(const motion::AxisMove& move) {
    if (!move.arc || move.curve || turns(move)) return -1;
    for (int i = 0; i < 3; ++i)
        if (std::abs(move.arc->normal[i]) > 1.0 - 1e-12) return i;
    return -1;
}

/// The helix in a coordinate plane through three points: start, middle, end.
struct FittedArc {
    Vector3 centre = Vector3::Zero();
    Vector3 start = Vector3::Zero();
    double sweep_rad = 0.0, rise = 0.0;
    int normal = 2;

    Vector3 at(double t) const {
        const int i = (normal + 1) % 3, j = (normal + 2) % 3;
        const double c = std::cos(sweep_rad * t), s = std::sin(sweep_rad * t);
        const double x = start[i] - centre[i], y = start[j] - centre[j];
        Vector3 p = start;
        p[i] = centre[i] + c * x - s * y;
        p[j] = centre[j] + s * x + c * y;
        p[normal] += rise * t;
        return p;
    }
};

std::optional<FittedArc> fit_arc(const Vector3& a, const Vector3& m, const Vector3& b, int normal,
                                 bool positive) {
    const int i = (normal + 1) % 3, j = (normal + 2) % 3;
    const double mx = m[i] - a[i], my = m[j] - a[j], bx = b[i] - a[i], by = b[j] - a[j];
    const double twice_area = 2.0 * (mx * by - my * bx);
    if (std::abs(twice_area) < 1e-12) return std::nullopt;
    const double mm = mx * mx + my * my, bb = bx * bx + by * by;
    FittedArc arc;
    arc.start = arc.centre = a;
    arc.centre[i] += (by * mm - my * bb) / twice_area;
    arc.centre[j] += (mx * bb - bx * mm) / twice_area;
    const double from = std::atan2(a[j] - arc.centre[j], a[i] - arc.centre[i]);
    const double to = std::atan2(b[j] - arc.centre[j], b[i] - arc.centre[i]);
    arc.sweep_rad = to - from;
    if (positive && arc.sweep_rad <= 0.0) arc.sweep_rad += 2.0 * pi;
    if (!positive && arc.sweep_rad >= 0.0) arc.sweep_rad -= 2.0 * pi;
    arc.rise = b[normal] - a[normal];
    arc.normal = normal;
    return arc;
}

/// Errors at one position.
CompensatedProgram::Worst errors_at(const emulator::BelievedTool& is,
                                    const emulator::BelievedTool& meant, bool turned) {
    CompensatedProgram::Worst errors;
    errors.tip_mm = (is.tip_W_mm - meant.tip_W_mm).norm();
    (turned ? errors.turned_rad : errors.kept_rad) =
        angle_between(is.direction_W, meant.direction_W);
    return errors;
}

/// The axes at machine zero, having arrived from the sides given in the setup.
records::TravelHistory at_start(const setup::Setup& setup) {
    records::TravelHistory history(setup.side_before);
    history.place({});
    return history;
}

/// Rewrites every move received from the control.
class RewritingSink : public motion::MotionSink {
  public:
    RewritingSink(const setup::Setup& setup, const emulator::EffectModels& effects,
                  const CompensationOptions& options, CompensatedProgram& out)
        : corrector_(setup, effects, options.largest_turn_rad, options.decimals),
          text_(setup, options.decimals),
          options_(options),
          out_(out),
          tracker_(at_start(setup)),
          written_(at_start(setup)) {}

    motion::MoveResult move(const motion::AxisMove& move) override {
        const emulator::PathSampler path{move, tracker_, clock_s_, move.mode};
        const bool turned = corrector_.turns_tool(move);
        out_.before.include(
            errors_at(corrector_.truth(path, 1.0), corrector_.meant(move, 1.0), turned));
        note_tapping(move);
        text_.prepare(move);
        const std::vector<PathStretch> stretches = path_stretches(move);
        if (turned != turned_ && !out_.blocks.empty())
            begin_turned(path, stretches.front(), turned);
        turned_ = turned;
        if (move.until_skip)
            write_skip(path, stretches.back());
        else if (move.kind == motion::MotionKind::rapid)
            write_rapid(path, stretches.back());
        else
            for (const PathStretch& stretch : stretches) write_feed(path, stretch);
        emulator::follow(tracker_, move);
        clock_s_ += move.duration_s;
        return {false, move.to};
    }
    void dwell(double duration_s) override { text_.dwell(duration_s); }
    void m_code(int code) override {
        spindle_commanded_ = true;
        text_.m_code(code);
    }
    std::string take() { return text_.take(); }
    const std::optional<SourceRef>& last_skip() const { return last_skip_; }

  private:
    static constexpr double take_up_s = 0.05;  ///< duration of preparatory moves

    Correction corrected(const emulator::PathSampler& path, const PathStretch& stretch,
                         double s) const {
        return corrector_.corrected(path, stretch, s, written_);
    }

    /// Records that the block just written ends at s.
    void note(const emulator::PathSampler& path, double s, CompensatedBlock::End end) {
        written_.advance(text_.position());
        out_.blocks.push_back(
            {path.move.line, text_.last_line(), corrector_.meant(path.move, s), turned_, end});
    }

    static CompensatedBlock::End end_of(const Correction& c) {
        const bool held = std::find(c.held.begin(), c.held.end(), true) != c.held.end();
        return held ? CompensatedBlock::End::in_gap : CompensatedBlock::End::exact;
    }

    void write_line(const emulator::PathSampler& path, double s, const Correction& c,
                    double duration_s) {
        if (text_.line(path.move, c.to, duration_s)) note(path, s, end_of(c));
    }

    /// Direction correction starts or ends: the rotary axes move there with the tip at rest.
    void begin_turned(const emulator::PathSampler& path, const PathStretch& stretch, bool turned) {
        turned_ = turned;
        pass_gap(path, stretch, 0.0, take_up_s, {Axis::A, Axis::C});
        write_line(path, 0.0, corrected(path, stretch, 0.0), take_up_s);
    }

    /// Spindle reversal without M3, M4 or M5: G74 or G84.
    void note_tapping(const motion::AxisMove& move) {
        if (move.spindle_rpm * spindle_rpm_ < 0.0 && !spindle_commanded_ && !tapping_noted_) {
            tapping_noted_ = true;
            out_.notes.push_back(
                "line " + std::to_string(move.line) +
                ": tapping is written as feed moves with the spindle turning round between them; "
                "rigid taps lose their synchronisation");
        }
        spindle_rpm_ = move.spindle_rpm;
        spindle_commanded_ = false;
    }

    void write_skip(const emulator::PathSampler& path, const PathStretch& stretch) {
        last_skip_ = SourceRef{path.move.program ? *path.move.program : "", path.move.line, 1};
        const Correction c = corrected(path, stretch, 1.0);
        if (text_.skip(path.move, c.to)) note(path, 1.0, end_of(c));
    }

    /// Axes of the range that would end inside their gap pass through it: without cutting this is
    /// harmless.
    void pass_gap(const emulator::PathSampler& path, const PathStretch& stretch, double s,
                  double duration_s, std::pair<Axis, Axis> axes) {
        constexpr double past_mm = 0.01, past_rad = 2e-5;
        const Correction c = corrected(path, stretch, s);
        AxisPositions past = c.to;
        for (std::size_t i = index_of(axes.first); i <= index_of(axes.second); ++i)
            if (c.held[i])
                past.value[i] =
                    c.wanted.value[i] - c.travel[i] * (is_rotary(all_axes[i]) ? past_rad : past_mm);
        if (past != c.to && text_.line(path.move, past, duration_s))
            note(path, s, CompensatedBlock::End::past_gap);
    }

    void write_rapid(const emulator::PathSampler& path, const PathStretch& stretch) {
        pass_gap(path, stretch, 1.0, path.move.duration_s, {Axis::X, Axis::C});
        write_line(path, 1.0, corrected(path, stretch, 1.0), path.move.duration_s);
    }

    void write_feed(const emulator::PathSampler& path, const PathStretch& stretch) {
        take_up(path, stretch);
        if (plane_normal(path.move) >= 0 && !turned_)
            split_arc(path, stretch, stretch.from, stretch.to, 0);
        else
            split_line(path, stretch, stretch.from, stretch.to, 0);
    }

    /// Axes that reverse take up their gap before the tip continues.
    void take_up(const emulator::PathSampler& path, const PathStretch& stretch) {
        const Correction c = corrected(path, stretch, stretch.from);
        AxisPositions turning = written_.position();
        for (std::size_t i = 0; i < axis_count; ++i)
            if (c.travel[i] != written_.travel()[i]) turning.value[i] = c.to.value[i];
        if (apart_mm(turning, written_.position()) > options_.tolerance_mm)
            write_line(path, stretch.from, c, take_up_s);
    }

    /// A straight move of the axes to b, bisected until it is within tolerance of the wanted path.
    void split_line(const emulator::PathSampler& path, const PathStretch& stretch, double a,
                    double b, int depth) {
        const Correction start = corrected(path, stretch, a), end = corrected(path, stretch, b);
        double worst = 0.0;
        for (const double t : {0.5, 0.25, 0.75})
            worst = std::max(worst, apart_mm(corrected(path, stretch, a + t * (b - a)).to,
                                             between(start.to, end.to, t)));
        if (worst <= options_.tolerance_mm || depth == deepest_split)
            return write_line(path, b, end, (b - a) * path.move.duration_s);
        const double middle = 0.5 * (a + b);
        split_line(path, stretch, a, middle, depth + 1);
        split_line(path, stretch, middle, b, depth + 1);
    }

    /// Number of the three positions of a segment with an axis of the plane held inside its gap.
    int held_places(const emulator::PathSampler& path, const PathStretch& stretch, double a,
                    double b) const {
        int count = 0;
        for (const double s : {a, 0.5 * (a + b), b}) {
            const Correction c = corrected(path, stretch, s);
            for (int i = 0; i < 3; ++i)
                if (c.held[static_cast<std::size_t>(i)] && i != plane_normal(path.move)) {
                    ++count;
                    break;
                }
        }
        return count;
    }

    void split_arc(const emulator::PathSampler& path, const PathStretch& stretch, double a,
                   double b, int depth) {
        constexpr int shortest_arc = 8;  // where an axis leaves its gap, lines are equivalent
        const int held = held_places(path, stretch, a, b);
        if (held == 3 || (held > 0 && depth >= shortest_arc))
            return split_line(path, stretch, a, b, depth);
        const auto point = [&](double t) {
            return xyz_of(corrected(path, stretch, a + t * (b - a)).to);
        };
        const int normal = plane_normal(path.move);
        const bool positive = path.move.arc->sweep_rad * path.move.arc->normal[normal] > 0.0;
        const auto arc =
            held > 0 ? std::nullopt : fit_arc(point(0.0), point(0.5), point(1.0), normal, positive);
        double worst = arc ? 0.0 : 1.0;
        for (const double t : {0.125, 0.25, 0.5, 0.75, 0.875})
            if (arc) worst = std::max(worst, (point(t) - arc->at(t)).norm());
        if (worst > options_.tolerance_mm && depth < deepest_split) {
            split_arc(path, stretch, a, 0.5 * (a + b), depth + 1);
            return split_arc(path, stretch, 0.5 * (a + b), b, depth + 1);
        }
        const Correction end = corrected(path, stretch, b);
        if (!arc) return write_line(path, b, end, (b - a) * path.move.duration_s);
        text_.arc(path.move, end.to, normal, positive, arc->centre);
        note(path, b, end_of(end));
    }

    TipCorrector corrector_;
    FlatProgram text_;
    CompensationOptions options_;
    CompensatedProgram& out_;
    records::TravelHistory tracker_;  ///< of the original program
    records::TravelHistory written_;  ///< of the compensated program
    double clock_s_ = 0.0;
    bool turned_ = false;
    double spindle_rpm_ = 0.0;
    bool spindle_commanded_ = false, tapping_noted_ = false;
    std::optional<SourceRef> last_skip_;
};

/// Executes the compensated program and evaluates the physical tip at the block ends.
class CheckingSink : public motion::MotionSink {
  public:
    CheckingSink(const setup::Setup& setup, const emulator::EffectModels& effects,
                 CompensatedProgram& out)
        : corrector_(setup, effects), out_(out), tracker_(at_start(setup)) {}

    motion::MoveResult move(const motion::AxisMove& move) override {
        const emulator::PathSampler path{move, tracker_, clock_s_, move.mode};
        if (next_ < out_.blocks.size() && out_.blocks[next_].written_line == move.line)
            look(path, out_.blocks[next_++]);
        emulator::follow(tracker_, move);
        clock_s_ += move.duration_s;
        return {false, move.to};
    }
    bool complete() const { return next_ == out_.blocks.size(); }

  private:
    void look(const emulator::PathSampler& path, const CompensatedBlock& block) {
        if (block.end == CompensatedBlock::End::past_gap) return;
        const bool in_gap = block.end == CompensatedBlock::End::in_gap;
        (in_gap ? out_.in_gap : out_.after)
            .include(errors_at(corrector_.truth(path, 1.0), block.meant, block.turned));
    }

    TipCorrector corrector_;
    CompensatedProgram& out_;
    records::TravelHistory tracker_;
    double clock_s_ = 0.0;
    std::size_t next_ = 0;
};

template <class Program>
controller::RunResult execute(const setup::Setup& setup, interpreter::ProgramSource& programs,
                              motion::MotionSink& sink, const Program& program,
                              BudgetMeter& meter) {
    offsets::Stores stores = setup.stores;
    std::uint64_t printed_bytes = 0;
    controller::ControlConfig config = emulator::control_config(setup);
    config.go_on = [&](std::uint64_t blocks) { return meter.allows({blocks, printed_bytes, 0}); };
    controller::Controller controller(std::move(config), stores, programs, sink,
                                      [&](std::string_view text) { printed_bytes += text.size(); });
    for (const auto& [number, value] : setup.stores.variables)
        controller.set_variable(number, value);
    return controller.run(program);
}

}  // namespace

void CompensatedProgram::Worst::include(const Worst& other) {
    tip_mm = std::max(tip_mm, other.tip_mm);
    turned_rad = std::max(turned_rad, other.turned_rad);
    kept_rad = std::max(kept_rad, other.kept_rad);
}

CompensatedProgram compensate_program(const setup::Setup& setup,
                                      interpreter::ProgramSource& programs,
                                      const emulator::ProgramChoice& program,
                                      const emulator::EffectModels& effects,
                                      const CompensationOptions& options) {
    CompensatedProgram out;
    RewritingSink sink(setup, effects, options, out);
    BudgetMeter meter(options.budget);
    out.original = std::visit(
        [&](const auto& p) { return execute(setup, programs, sink, p, meter); }, program);
    out.notes.insert(out.notes.end(), out.original.notes.begin(), out.original.notes.end());
    if (out.original.reads_skip && sink.last_skip())
        throw InputError(
            "the program reads the position of a G31 touch: its further path is not known in "
            "advance",
            *sink.last_skip());
    out.limit = meter.reached();
    if (out.original.status != controller::RunStatus::ok) return out;
    out.program = sink.take();
    CheckingSink check(setup, effects, out);
    BudgetMeter checking(options.budget);
    interpreter::ProgramsInMemory none;
    out.executed = execute(setup, none, check,
                           interpreter::ProgramText{"compensated", out.program, nullptr}, checking);
    out.limit = checking.reached();
    if (out.limit != BudgetLimit::none) {
        out.program.clear();
        return out;
    }
    if (out.executed.alarm)
        out.notes.push_back("the compensated program stops with alarm " +
                            std::to_string(out.executed.alarm->number) + ' ' +
                            out.executed.alarm->text);
    else if (!check.complete())
        out.notes.push_back("the compensated program makes fewer moves than were written to it");
    return out;
}

}  // namespace trunnion::compensation
