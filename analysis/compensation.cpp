#include "analysis/compensation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/flat_program.h"
#include "analysis/tip_corrector.h"
#include "geometry/alarm.h"
#include "geometry/units.h"

namespace trunnion {
namespace {

constexpr int deepest_split = 16;
constexpr double reach_mm = 500.0;  ///< lever of a rotary deviation, on the safe side

Vector3 xyz(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

AxisPositions between(const AxisPositions& a, const AxisPositions& b, double t) {
    AxisPositions q;
    for (std::size_t i = 0; i < axis_count; ++i)
        q.value[i] = a.value[i] + t * (b.value[i] - a.value[i]);
    return q;
}

double apart_mm(const AxisPositions& a, const AxisPositions& b) {
    double rotary = 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) rotary += std::abs(a[axis] - b[axis]);
    return (xyz(a) - xyz(b)).norm() + reach_mm * rotary;
}

bool turns(const AxisMove& move) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        if (move.from[axis] != move.to[axis]) return true;
    return false;
}

/// 0, 1, 2 when the arc's normal is along X, Y or Z, else -1.
int plane_normal(const AxisMove& move) {
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

/// Errors at one place, added to the worst so far.
void include(CompensatedProgram::Worst& worst, const BelievedTool& is, const BelievedTool& meant,
             bool turned) {
    worst.tip_mm = std::max(worst.tip_mm, (is.tip_W_mm - meant.tip_W_mm).norm());
    double& direction_rad = turned ? worst.turned_rad : worst.kept_rad;
    direction_rad = std::max(direction_rad, angle_between(is.direction_W, meant.direction_W));
}

/// Rewrites every move as it comes from the control.
class RewritingSink : public MotionSink {
  public:
    RewritingSink(const Setup& setup, const EffectModels& effects,
                  const CompensationOptions& options, CompensatedProgram& out)
        : corrector_(setup, effects, options.largest_turn_rad),
          text_(setup, options.decimals),
          options_(options),
          out_(out) {}

    MoveResult move(const AxisMove& move) override {
        const PathSampler path{move, tracker_, clock_s_, move.mode};
        const bool turned = corrector_.turns_tool(move);
        include(out_.before, corrector_.truth(path, 1.0, move.to), corrector_.meant(move, 1.0),
                turned);
        note_tapping(move);
        text_.prepare(move);
        if (turned != turned_ && !out_.blocks.empty()) begin_turned(path, turned);
        turned_ = turned;
        if (move.until_skip)
            write_skip(path);
        else if (move.kind == MotionKind::rapid)
            write_line(path, 0.0, 1.0);
        else if (plane_normal(move) >= 0 && !turned)
            write_arcs(path);
        else
            split_line(path, {0.0, corrector_.corrected(path, 0.0)},
                       {1.0, corrector_.corrected(path, 1.0)}, 0);
        tracker_.advance(move.to);
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
    struct Place {
        double s = 0.0;
        AxisPositions q;
    };

    void note(const PathSampler& path, double s) {
        out_.blocks.push_back({path.move.line, corrector_.meant(path.move, s), turned_});
    }

    /// The rotaries begin, or cease, to correct the direction: they go there with the tip at rest.
    void begin_turned(const PathSampler& path, bool turned) {
        turned_ = turned;
        if (text_.line(path.move, corrector_.corrected(path, 0.0), 0.05)) note(path, 0.0);
    }

    /// A spindle that turns round without M3, M4 or M5: G74 or G84.
    void note_tapping(const AxisMove& move) {
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

    void write_skip(const PathSampler& path) {
        last_skip_ = SourceRef{path.move.program ? *path.move.program : "", path.move.line, 1};
        if (text_.skip(path.move, corrector_.corrected(path, 1.0))) note(path, 1.0);
    }

    void write_line(const PathSampler& path, double a, double b) {
        if (text_.line(path.move, corrector_.corrected(path, b), (b - a) * path.move.duration_s))
            note(path, b);
    }

    /// A straight move of the axes from a to b, halved until it is near the wanted path everywhere.
    void split_line(const PathSampler& path, const Place& a, const Place& b, int depth) {
        Place middle{0.5 * (a.s + b.s), {}};
        double worst = 0.0;
        for (const double t : {0.5, 0.25, 0.75}) {
            const AxisPositions q = corrector_.corrected(path, a.s + t * (b.s - a.s));
            if (t == 0.5) middle.q = q;
            worst = std::max(worst, apart_mm(q, between(a.q, b.q, t)));
        }
        if (worst <= options_.tolerance_mm || depth == deepest_split)
            return write_line(path, a.s, b.s);
        split_line(path, a, middle, depth + 1);
        split_line(path, middle, b, depth + 1);
    }

    /// In pieces of a quarter turn at most.
    void write_arcs(const PathSampler& path) {
        const int pieces = std::max(
            1, static_cast<int>(std::ceil(std::abs(path.move.arc->sweep_rad) / (0.5 * pi) - 1e-9)));
        for (int i = 0; i < pieces; ++i)
            split_arc(path, static_cast<double>(i) / pieces, static_cast<double>(i + 1) / pieces,
                      0);
    }

    void split_arc(const PathSampler& path, double a, double b, int depth) {
        const auto point = [&](double t) {
            return xyz(corrector_.corrected(path, a + t * (b - a)));
        };
        const int normal = plane_normal(path.move);
        const bool positive = path.move.arc->sweep_rad * path.move.arc->normal[normal] > 0.0;
        const auto arc = fit_arc(point(0.0), point(0.5), point(1.0), normal, positive);
        double worst = arc ? 0.0 : 1.0;
        for (const double t : {0.125, 0.25, 0.5, 0.75, 0.875})
            if (arc) worst = std::max(worst, (point(t) - arc->at(t)).norm());
        if (worst > options_.tolerance_mm && depth < deepest_split) {
            split_arc(path, a, 0.5 * (a + b), depth + 1);
            return split_arc(path, 0.5 * (a + b), b, depth + 1);
        }
        if (!arc) return write_line(path, a, b);
        text_.arc(path.move, corrector_.corrected(path, b), normal, positive, arc->centre);
        note(path, b);
    }

    TipCorrector corrector_;
    FlatProgram text_;
    CompensationOptions options_;
    CompensatedProgram& out_;
    AxisTracker tracker_;
    double clock_s_ = 0.0;
    bool turned_ = false;
    double spindle_rpm_ = 0.0;
    bool spindle_commanded_ = false, tapping_noted_ = false;
    std::optional<SourceRef> last_skip_;
};

/// Executes the program written and looks where the physical tip ends.
class CheckingSink : public MotionSink {
  public:
    CheckingSink(const Setup& setup, const EffectModels& effects, CompensatedProgram& out)
        : corrector_(setup, effects), out_(out) {}

    MoveResult move(const AxisMove& move) override {
        const PathSampler path{move, tracker_, clock_s_, move.mode};
        if (next_ < out_.blocks.size()) {
            const CompensatedBlock& block = out_.blocks[next_++];
            include(out_.after, corrector_.truth(path, 1.0, move.to), block.meant, block.turned);
        }
        tracker_.advance(move.to);
        clock_s_ += move.duration_s;
        return {false, move.to};
    }
    bool complete() const { return next_ == out_.blocks.size(); }

  private:
    TipCorrector corrector_;
    CompensatedProgram& out_;
    AxisTracker tracker_;
    double clock_s_ = 0.0;
    std::size_t next_ = 0;
};

template <class Program>
RunResult execute(const Setup& setup, ProgramSource& programs, MotionSink& sink,
                  const Program& program) {
    Stores stores = setup.stores;
    Controller controller(control_config(setup), stores, programs, sink, [](std::string_view) {});
    for (const auto& [number, value] : setup.stores.variables)
        controller.set_variable(number, value);
    return controller.run(program);
}

}  // namespace

CompensatedProgram compensate_program(const Setup& setup, ProgramSource& programs,
                                      const ProgramChoice& program, const EffectModels& effects,
                                      const CompensationOptions& options) {
    CompensatedProgram out;
    RewritingSink sink(setup, effects, options, out);
    out.original =
        std::visit([&](const auto& p) { return execute(setup, programs, sink, p); }, program);
    out.notes.insert(out.notes.end(), out.original.notes.begin(), out.original.notes.end());
    if (out.original.reads_skip && sink.last_skip())
        throw InputError(
            "the program asks where G31 touched: what it does then cannot be written beforehand",
            *sink.last_skip());
    if (out.original.status != RunStatus::ok) return out;
    out.program = sink.take();
    CheckingSink check(setup, effects, out);
    ProgramsInMemory none;
    out.executed = execute(setup, none, check, ProgramText{"compensated", out.program, nullptr});
    if (out.executed.alarm)
        out.notes.push_back("the compensated program stops with alarm " +
                            std::to_string(out.executed.alarm->number) + ' ' +
                            out.executed.alarm->text);
    else if (!check.complete())
        out.notes.push_back("the compensated program makes fewer moves than were written");
    return out;
}

}  // namespace trunnion
