#include "controller/controller.h"

#include "controller/block_execution.h"
#include "controller/code_calls.h"
#include "controller/system_variables.h"
#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"

namespace trunnion {

struct Controller::State {
    State(ControlConfig config, Stores& stores, ProgramSource& programs, MotionSink& sink,
          Interpreter::Print print)
        : control(std::move(config), stores, sink),
          variables(control),
          language(programs, language_options(), variables, std::move(print)) {
        control.program_number = [this] { return language.program_number(); };
        control.sequence_number = [this] { return language.sequence_number(); };
    }

    InterpreterOptions language_options() const;
    template <typename Program>
    RunResult run(const Program& program);
    void run_blocks();
    void release_held(Alarm& alarm);
    void switch_units();
    void finish();

    ControlState control;
    ControlVariables variables;
    Interpreter language;
};

InterpreterOptions Controller::State::language_options() const {
    InterpreterOptions options;
    options.dialect = control.config.dialect;
    options.skip_switches = control.config.skip_switches;
    options.asin_0_to_minus_90 = control.stores.parameters.bit(6004, 0);
    options.max_blocks = control.config.max_blocks;
    options.go_on = control.config.go_on;
    options.calls = decode_code_calls(control.stores.parameters);
    options.whole_arguments_as_written = control.settings.bare_is_unit;
    options.print_suppresses_blanks = control.stores.parameters.bit(6001, 1);
    options.increment_digits = control.inch() ? 4 : 3;
    return options;
}

/// ROUND in a word rounds to the least input increment: 0.001 mm or 0.0001 inch.
void Controller::State::switch_units() {
    language.set_increment_digits(control.inch() ? 4 : 3);
    control.units_switched = false;
}

void Controller::State::run_blocks() {
    while (const BlockWords* block = language.next()) {
        control.move.program = &language.program_name();
        execute_block(control, *block);
        if (control.moved) language.block_moved();
        if (control.units_switched) switch_units();
        if (control.ended) language.end_program();
    }
}

/// Compensated moves that were worked out before the alarm's block still go out, unless their path
/// is the fault; an alarm of theirs comes first.
void Controller::State::release_held(Alarm& alarm) {
    for (const int number : {33, 34, 38, 41})
        if (alarm.number == number) return;
    try {
        release_path(control);
    } catch (const Alarm& earlier) {
        alarm = earlier;
    }
}

namespace {

/// The line of an alarm, when its program is this one.
std::string line_of(const SourceRef& where, const ProgramText& program) {
    if (where.program != program.name) return {};
    for (LineScan scan(program.text, start_of_text(program.text)); scan.next();) {
        const TextPlace place = scan.head().place;
        if (place.line != where.line) continue;
        const char* const first = program.text.data() + place.byte;
        return {first, find_line_end(first, program.text.data() + program.text.size())};
    }
    return {};
}
std::string line_of(const SourceRef&, int) {
    return {};
}

}  // namespace

template <typename Program>
RunResult Controller::State::run(const Program& program) {
    control.result = {};
    control.noted.clear();
    control.ended = false;
    control.path = {};
    control.move.arc.reset();
    control.move.curve = nullptr;
    control.move.until_skip = false;
    control.pace.stop();
    try {
        language.open(program);
        run_blocks();
        flush_path(control);
        if (language.limit_reached()) control.result.status = RunStatus::limit;
    } catch (Alarm& alarm) {
        const SourceRef place = language.where();
        if (alarm.where.line == 0) alarm.where.line = place.line;
        release_held(alarm);
        if (alarm.where.program.empty()) alarm.where.program = place.program;
        if (alarm.block.empty())
            alarm.block = alarm.where.line == place.line && alarm.where.program == place.program
                              ? language.block_text()
                              : line_of(alarm.where, program);
        control.result.status = RunStatus::alarm;
        control.result.alarm = alarm;
    }
    finish();
    return control.result;
}

void Controller::State::finish() {
    RunResult& result = control.result;
    result.blocks = language.blocks_executed();
    result.machine = axis_positions_of(control.machine);
    result.work = axis_positions_of(control.coordinates.shaped_from_program(control.program));
    result.modal = control.modal.texts();
}

Controller::Controller(ControlConfig config, Stores& stores, ProgramSource& programs,
                       MotionSink& sink, Interpreter::Print print)
    : state_(std::make_unique<State>(std::move(config), stores, programs, sink, std::move(print))) {
}
Controller::~Controller() = default;

RunResult Controller::run(const ProgramText& program) {
    return state_->run(program);
}
RunResult Controller::run(int o_number) {
    return state_->run(o_number);
}

void Controller::set_variable(int number, double value) {
    if (number < 1000)
        state_->language.set_variable(number, value);
    else
        state_->variables.set(number, value, "");
}

double Controller::variable(int number) const {
    return number < 1000 ? state_->language.variable(number) : state_->variables.get(number);
}

std::vector<int> Controller::used_common_variables() const {
    return state_->language.used_common_variables();
}

void Controller::place(const AxisPositions& machine) {
    state_->control.stand_at(control_position_of(machine));
}

}  // namespace trunnion
