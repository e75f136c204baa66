#include "controller/controller.h"

#include "controller/block_execution.h"
#include "controller/code_calls.h"
#include "controller/system_variables.h"
#include "interpreter/lexical.h"
#include "interpreter/line_scan.h"
#include "interpreter/memory.h"

namespace trunnion::controller {

struct Controller::State {
    State(ControlConfig config, offsets::Stores& stores, interpreter::ProgramSource& programs,
          motion::MotionSink& sink, interpreter::Interpreter::Print print)
        : control(std::move(config), stores, sink),
          variables(control),
          language(programs, language_options(), variables, std::move(print)) {
        control.place.program_number = [this] { return language.program_number(); };
        control.place.sequence_number = [this] { return language.sequence_number(); };
    }

    interpreter::InterpreterOptions language_options() const;
    template <typename Program>
    RunResult run(const Program& program);
    void run_blocks();
    void release_held(Alarm& alarm);
    void start_run();
    template <typename Program>
    void place_alarm(Alarm& alarm, const Program& program);
    void finish(RunResult& result);

    Control control;
    ControlVariables variables;
    interpreter::Interpreter language;
    BlockWatch watch;
};

interpreter::InterpreterOptions Controller::State::language_options() const {
    interpreter::InterpreterOptions options;
    options.dialect = control.config.dialect;
    options.skip_switches = control.config.skip_switches;
    options.asin_0_to_minus_90 = control.stores.parameters.bit(6004, 0);
    options.max_blocks = control.config.max_blocks;
    options.go_on = control.config.go_on;
    options.calls = decode_code_calls(control.stores.parameters);
    options.whole_arguments_as_written = control.modal.settings.bare_is_unit;
    options.print_suppresses_blanks = control.stores.parameters.bit(6001, 1);
    options.increment_digits = control.modal.units.inch() ? 4 : 3;
    return options;
}

void Controller::State::run_blocks() {
    while (const interpreter::BlockWords* block = language.next()) {
        control.modal.block.program = &language.program_name();
        const bool inch = control.modal.units.inch();
        execute_block(control, *block);
        if (watch) watch(control);
        if (control.moved) language.block_moved();
        // ROUND in a word rounds to the least input increment: 0.001 mm or 0.0001 inch.
        if (control.modal.units.inch() != inch) language.set_increment_digits(inch ? 3 : 4);
        if (control.m_codes.ended()) language.end_program();
    }
}

/// Compensated moves completed before the alarm's block are still sent, unless their path is the
/// cause of the alarm. An alarm that they raise has priority.
void Controller::State::release_held(Alarm& alarm) {
    for (const int number : {33, 34, 38, 41})
        if (alarm.number == number) return;
    try {
        control.mover.cutter.release();
    } catch (const Alarm& earlier) {
        alarm = earlier;
    }
}

namespace {

/// The source line of an alarm, when it belongs to this program.
std::string line_of(const SourceRef& where, const interpreter::ProgramText& program) {
    if (where.program != program.name) return {};
    for (interpreter::LineScan scan(program.text, interpreter::start_of_text(program.text));
         scan.next();) {
        const interpreter::TextPlace place = scan.head().place;
        if (place.line != where.line) continue;
        const char* const first = program.text.data() + place.byte;
        return {first,
                interpreter::find_line_end(first, program.text.data() + program.text.size())};
    }
    return {};
}
std::string line_of(const SourceRef&, int) {
    return {};
}

}  // namespace

void Controller::State::start_run() {
    control.mover.axes.start_run();
    control.mover.cutter.reset();
    control.m_codes.start_run();
    variables.start_run();
}

template <typename Program>
void Controller::State::place_alarm(Alarm& alarm, const Program& program) {
    const SourceRef place = language.where();
    if (alarm.where.line == 0) alarm.where.line = place.line;
    release_held(alarm);
    if (alarm.where.program.empty()) alarm.where.program = place.program;
    if (!alarm.block.empty()) return;
    const bool here = alarm.where.line == place.line && alarm.where.program == place.program;
    alarm.block = here ? language.block_text() : line_of(alarm.where, program);
}

namespace {

/// What a control takes otherwise in the text of the main program and at its end.
void note_text(const interpreter::ProgramText& program, RunRecord& record) {
    const auto place = interpreter::first_small_letter(program.text);
    if (place)
        record.note("small letters are read as capitals (first in line " +
                    std::to_string(place->line) + "); a control may not take them");
}
void note_text(int, RunRecord&) {}

void note_end(interpreter::MainEnd end, bool hurco, RunRecord& record) {
    if (end == interpreter::MainEnd::returned)
        record.note(
            "M99 in the main program starts it again without end on a control; the run stops after "
            "the first pass");
    // A Hurco's last line is E; what it does without one is not known.
    if (end == interpreter::MainEnd::out_of_text && !hurco)
        record.note(
            "the program ends without M02, M30 or M99: a Fanuc stops there with alarm 5010 END OF "
            "RECORD");
}

}  // namespace

template <typename Program>
RunResult Controller::State::run(const Program& program) {
    RunResult result;
    start_run();
    note_text(program, control.mover.record());
    if (watch) watch(control);
    try {
        language.open(program);
        run_blocks();
        control.mover.cutter.flush();
        note_end(language.main_end(), control.modal.settings.is_hurco(), control.mover.record());
        if (language.limit_reached()) result.status = RunStatus::limit;
    } catch (Alarm& alarm) {
        place_alarm(alarm, program);
        result.status = RunStatus::alarm;
        result.alarm = alarm;
    }
    finish(result);
    return result;
}

void Controller::State::finish(RunResult& result) {
    const RunRecord& record = control.mover.record();
    const Frames& frames = control.frames;
    result.moves = record.moves;
    result.time_s = record.time_s;
    result.path_mm = record.path_mm;
    result.notes = record.notes;
    for (std::string& note : record.cautions.notes()) result.notes.push_back(std::move(note));
    result.turned_starts = record.turned_starts;
    result.reads_skip = variables.reads_skip();
    result.blocks = language.blocks_executed();
    result.machine = offsets::axis_positions_of(frames.machine);
    result.work = offsets::axis_positions_of(frames.stages.shaped_from_program(frames.program));
    result.modal = control.modal.codes.texts();
}

Controller::Controller(ControlConfig config, offsets::Stores& stores,
                       interpreter::ProgramSource& programs, motion::MotionSink& sink,
                       interpreter::Interpreter::Print print)
    : state_(std::make_unique<State>(std::move(config), stores, programs, sink, std::move(print))) {
}
Controller::~Controller() = default;

RunResult Controller::run(const interpreter::ProgramText& program) {
    return state_->run(program);
}
RunResult Controller::run(int o_number) {
    return state_->run(o_number);
}

namespace {

bool is_common(int number, const interpreter::Dialect& dialect) {
    return number < 1000 || interpreter::common_slot(number, dialect.has_98000) >= 0;
}

}  // namespace

void Controller::set_variable(int number, double value) {
    if (is_common(number, state_->control.config.dialect))
        state_->language.set_variable(number, value);
    else
        state_->variables.set(number, value, "");
}

double Controller::variable(int number) const {
    return is_common(number, state_->control.config.dialect) ? state_->language.variable(number)
                                                             : state_->variables.get(number);
}

std::vector<int> Controller::used_common_variables() const {
    return state_->language.used_common_variables();
}

void Controller::watch(BlockWatch watch) {
    state_->watch = std::move(watch);
}

void Controller::place(const AxisPositions& machine) {
    state_->control.frames.stand_at(offsets::control_position_of(machine));
}

}  // namespace trunnion::controller
