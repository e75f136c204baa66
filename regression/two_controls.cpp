#include "regression/two_controls.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "controller/alarms.h"
#include "controller/control.h"
#include "interpreter/program_source.h"

namespace trunnion::regression {

namespace {

constexpr double end_tolerance = 1e-4;  // mm, deg
constexpr double way_tolerance = 1e-3;

/// Where moves are compared: half way, and at fractions at which no turn or half turn of an axis
/// brings them together again.
constexpr std::array<double, 3> looked_at{0.5, 0.29, 0.83};

/// One move of a block; a cycle has many.
struct Way {
    bool rapid = false;
    std::array<offsets::ControlPosition, looked_at.size()> at;
};

/// One executed block.
struct Step {
    const std::string* program = nullptr;
    int line = 0;
    offsets::ControlPosition end;
    std::size_t first = 0, moves = 0;  ///< in Steps::ways
};

class Ways : public motion::MotionSink {
  public:
    explicit Ways(std::vector<Way>& list) : list_(list) {}
    motion::MoveResult move(const motion::AxisMove& m) override {
        Way way{m.kind == motion::MotionKind::rapid, {}};
        for (std::size_t k = 0; k < looked_at.size(); ++k)
            way.at[k] = offsets::control_position_of(m.at(looked_at[k]));
        list_.push_back(way);
        return {};
    }

  private:
    std::vector<Way>& list_;
};

/// The blocks of a run and its end; program names are stored in `names`.
struct Steps {
    std::vector<Step> step;
    std::vector<Way> ways;
    controller::RunResult result;
    std::map<std::string, std::unique_ptr<const std::string>> names;

    const std::string* name(const std::string& text) {
        auto& kept = names[text];
        if (!kept) kept = std::make_unique<const std::string>(text);
        return kept.get();
    }
};

void run(const ControlReading& reading, const interpreter::ProgramText& program,
         interpreter::ProgramSource& programs, Steps& out) {
    offsets::Stores stores = reading.stores;
    Ways sink(out.ways);
    std::size_t told = 0;
    controller::Controller control(reading.config, stores, programs, sink, [](std::string_view) {});
    for (const auto& [number, value] : reading.stores.variables)
        control.set_variable(number, value);
    control.watch([&](const controller::Control& c) {
        if (!c.modal.block.program) return;
        const std::size_t first = std::exchange(told, out.ways.size());
        out.step.push_back({out.name(*c.modal.block.program), c.modal.block.line, c.frames.machine,
                            first, told - first});
    });
    out.result = control.run(program);
}

double largest(const offsets::ControlPosition& a, const offsets::ControlPosition& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        most = std::max(most, std::abs(a.value[i] - b.value[i]));
    return most;
}

offsets::ControlPosition apart(const offsets::ControlPosition& a,
                               const offsets::ControlPosition& b) {
    offsets::ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = a.value[i] - b.value[i];
    return out;
}

/// The axes that differ, with the positions of both controls.
std::string places_text(const offsets::ControlPosition& a, const offsets::ControlPosition& b,
                        double tolerance, bool of_a) {
    std::string out;
    for (const Axis axis : all_axes)
        if (std::abs(a[axis] - b[axis]) > tolerance)
            out += fmt::format("{}{}{:.4f}", out.empty() ? "" : " ", letter_of(axis),
                               (of_a ? a : b)[axis] + 0.0);
    return out;
}

/// Unit of the axis that differs most.
const char* unit_of(const offsets::ControlPosition& a, const offsets::ControlPosition& b) {
    const double most = largest(a, b);
    for (const Axis axis : all_axes)
        if (std::abs(a[axis] - b[axis]) == most) return is_rotary(axis) ? "deg" : "mm";
    return "mm";
}

class SideBySide {
  public:
    SideBySide(const ControlReading& a, const ControlReading& b, const Steps& of_a,
               const Steps& of_b)
        : a_(a), b_(b), of_a_(of_a), of_b_(of_b) {}

    std::vector<ReadingDifference> compare() {
        const std::size_t both = std::min(of_a_.step.size(), of_b_.step.size());
        for (std::size_t i = 0; i < both; ++i) {
            const Step &x = of_a_.step[i], &y = of_b_.step[i];
            if (x.line != y.line || *x.program != *y.program) {
                tell(x, fmt::format("from here {} goes on at line {}, {} at line {}", a_.name,
                                    x.line, b_.name, y.line));
                return std::move(out_);
            }
            compare(x, y);
        }
        compare_ends();
        return std::move(out_);
    }

  private:
    void tell(const Step& at, std::string text, double apart = 0.0) {
        out_.push_back({*at.program, at.line, 0, std::move(text), apart});
    }
    void compare(const Step& x, const Step& y) {
        const offsets::ControlPosition now = apart(x.end, y.end);
        if (largest(now, apart_) > end_tolerance) {
            const bool same = largest(x.end, y.end) <= end_tolerance;
            tell(x,
                 same ? fmt::format("both stand alike again behind this block")
                      : text_of("ends at", x.end, y.end, end_tolerance),
                 largest(x.end, y.end));
        } else if (x.moves > 0 && y.moves > 0 && largest(now, {}) <= end_tolerance) {
            compare_ways(x, y);
        }
        apart_ = now;
    }
    /// Of blocks that one control divides into more moves only the last ones are compared.
    void compare_ways(const Step& x, const Step& y) {
        const std::size_t count = x.moves == y.moves ? x.moves : 1;
        for (std::size_t k = 0; k < count; ++k) {
            const Way &of_x = of_a_.ways[x.first + x.moves - count + k],
                      &of_y = of_b_.ways[y.first + y.moves - count + k];
            for (std::size_t at = 0; at < (x.moves == y.moves ? looked_at.size() : 1); ++at) {
                const double far = largest(of_x.at[at], of_y.at[at]);
                if (far <= way_tolerance) continue;
                const char* const what = at == 0 && count == 1 ? "is half way at" : "passes";
                tell(x, text_of(what, of_x.at[at], of_y.at[at], way_tolerance), far);
                return;
            }
            if (x.moves == y.moves && of_x.rapid != of_y.rapid) {
                tell(x, fmt::format("moves at rapid speed on {}, at feed on {}",
                                    (of_x.rapid ? a_ : b_).name, (of_x.rapid ? b_ : a_).name));
                return;
            }
        }
    }
    std::string text_of(const char* what, const offsets::ControlPosition& x,
                        const offsets::ControlPosition& y, double tolerance) const {
        return fmt::format(
            "{} {} on {}, {} on {}: {:.4f} {} apart", what, places_text(x, y, tolerance, true),
            a_.name, places_text(x, y, tolerance, false), b_.name, largest(x, y), unit_of(x, y));
    }
    void compare_ends() {
        const auto &x = of_a_.result.alarm, &y = of_b_.result.alarm;
        if (x && y && x->number == y->number && x->where.line == y->where.line) return;
        if (x) tell_alarm(*x, a_.name);
        if (y) tell_alarm(*y, b_.name);
    }
    void tell_alarm(const Alarm& alarm, const std::string& name) {
        out_.push_back({alarm.where.program, alarm.where.line, alarm.where.column,
                        fmt::format("{} stops here: {}", name,
                                    controller::alarm_title(alarm.number, alarm.text)),
                        0.0});
    }

    const ControlReading &a_, &b_;
    const Steps &of_a_, &of_b_;
    offsets::ControlPosition apart_;
    std::vector<ReadingDifference> out_;
};

}  // namespace

std::vector<ReadingDifference> compare_controls(const ControlReading& a, const ControlReading& b,
                                                const interpreter::ProgramText& program,
                                                const OpenPrograms& programs) {
    Steps of_a, of_b;
    run(a, program, *programs(), of_a);
    run(b, program, *programs(), of_b);
    return SideBySide(a, b, of_a, of_b).compare();
}

}  // namespace trunnion::regression
