#include "regression/two_controls.h"

#include <fmt/format.h>

#include <cmath>

#include "controller/alarms.h"
#include "controller/control.h"
#include "interpreter/program_source.h"

namespace trunnion::regression {

namespace {

constexpr double end_tolerance = 1e-4;  // mm, deg
constexpr double way_tolerance = 1e-3;

/// One executed block.
struct Step {
    const std::string* program = nullptr;
    int line = 0;
    offsets::ControlPosition end, half_way;
    bool moved = false;
};

class LastMove : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove& m) override {
        half_way = offsets::control_position_of(m.at(0.5));
        moved = true;
        return {};
    }
    offsets::ControlPosition half_way;
    bool moved = false;
};

/// The blocks of a run and its end; program names are stored in `names`.
struct Steps {
    std::vector<Step> step;
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
    LastMove sink;
    controller::Controller control(reading.config, stores, programs, sink, [](std::string_view) {});
    for (const auto& [number, value] : reading.stores.variables)
        control.set_variable(number, value);
    control.watch([&](const controller::Control& c) {
        if (!c.modal.block.program) return;
        out.step.push_back({out.name(*c.modal.block.program), c.modal.block.line, c.frames.machine,
                            sink.half_way, std::exchange(sink.moved, false)});
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
        } else if (x.moved && y.moved && largest(now, {}) <= end_tolerance &&
                   largest(x.half_way, y.half_way) > way_tolerance) {
            tell(x, text_of("is half way at", x.half_way, y.half_way, way_tolerance),
                 largest(x.half_way, y.half_way));
        }
        apart_ = now;
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
