#include "emulator/run.h"

#include "controller/alarms.h"
#include "emulator/machine_sink.h"
#include "emulator/measure_station.h"
#include "setup/control_axes.h"

namespace trunnion::emulator {
namespace {

SinkOptions sink_options(const RunOptions& options, const ProgramChoice& program) {
    SinkOptions sink;
    sink.seed = options.seed;
    sink.trace = options.trace;
    sink.trace_step_mm = options.trace_step_mm;
    sink.trace_chord_mm = options.trace_chord_mm;
    sink.truth = options.truth;
    sink.automatic_ballbar = options.automatic_ballbar;
    sink.measure = options.measure;
    sink.trace_chunk = options.trace_chunk;
    if (const auto* number = std::get_if<int>(&program)) {
        sink.test = "O" + std::to_string(*number);
    } else {
        const std::string& name = std::get<interpreter::ProgramText>(program).name;
        const std::size_t slash = name.find_last_of('/');
        sink.test = name.substr(slash == std::string::npos ? 0 : slash + 1);
        sink.test = sink.test.substr(0, sink.test.find('.'));
    }
    return sink;
}

std::map<int, double> report_variables(const controller::Controller& controller,
                                       const RunOptions& options) {
    std::map<int, double> values;
    const std::vector<int>& numbers = options.wanted_variables.empty()
                                          ? controller.used_common_variables()
                                          : options.wanted_variables;
    for (const int number : numbers) values[number] = controller.variable(number);
    return values;
}

void append(std::vector<std::string>& to, std::vector<std::string> from) {
    for (std::string& note : from) to.push_back(std::move(note));
}

}  // namespace

controller::ControlConfig control_config(const setup::Setup& setup) {
    controller::ControlConfig config;
    for (const kinematics::AxisGeometry& axis : setup::control_axes(setup))
        config.axes.push_back({axis.axis, axis.rotary, axis.min, axis.max, axis.max_speed,
                               axis.max_acceleration, !setup.machine.chain.find(axis.axis)});
    config.dialect = setup.dialect;
    config.tcp_frame = setup.tcp_frame;
    config.work_positions_with_length = setup.work_positions_with_length;
    config.work_offset_is_group_12 = setup.work_offset_is_group_12;
    config.g89_feeds_to_initial = setup.g89_feeds_to_initial;
    config.g53_under_g91_moves = setup.g53_under_g91_moves;
    config.rapids_are_doglegs = setup.rapids_are_doglegs;
    config.variable_rounding = setup.variable_rounding;
    config.clamps = setup.clamps;
    config.optional_stop = setup.optional_stop;
    config.threading = setup.threading;
    config.builder = setup.builder;
    config.hurco = setup.hurco;
    for (const int n : setup.block_skip) config.skip_switches[static_cast<std::size_t>(n)] = true;
    return config;
}

RunLog run_program(const setup::Setup& setup, interpreter::ProgramSource& programs,
                   const ProgramChoice& program, const RunOptions& options) {
    RunLog log;
    log.stores = setup.stores;
    MachineSink sink(setup, options.effects, sink_options(options, program));
    sink.place(options.start);
    std::optional<CompensatingSink> compensating;
    if (options.compensation) compensating.emplace(sink, options.compensation);
    motion::MotionSink& door =
        compensating ? static_cast<motion::MotionSink&>(*compensating) : sink;
    controller::ControlConfig config = control_config(setup);
    BudgetMeter meter(options.budget);
    config.max_blocks = options.budget.blocks;
    config.go_on = [&](std::uint64_t blocks) {
        return meter.allows({blocks, log.printed.size(), sink.readings()});
    };
    controller::Controller controller(std::move(config), log.stores, programs, door,
                                      [&](std::string_view text) {
                                          log.printed += text;
                                          sink.printed(text);
                                      });
    controller.place(options.start);
    for (const auto& [number, value] : setup.stores.variables)
        controller.set_variable(number, value);
    for (const auto& [number, value] : options.variables) controller.set_variable(number, value);
    log.result = std::visit([&](const auto& choice) { return controller.run(choice); }, program);
    if (log.result.status == controller::RunStatus::limit)
        log.limit = meter.reached() == BudgetLimit::none ? BudgetLimit::blocks : meter.reached();
    log.variables = report_variables(controller, options);
    log.readings = sink.take_readings();
    fill_readings(setup, options.effects, options.seed ^ 0x9e3779b9u, log.readings);
    log.readings.comment["seed"] = std::to_string(options.seed);
    log.trace_csv = sink.take_trace();
    if (options.trace_chunk) {
        options.trace_chunk(log.trace_csv);
        log.trace_csv.clear();
    }
    log.notes = log.result.notes;
    append(log.notes, sink.take_notes());
    return log;
}

std::string title_of(const Alarm& alarm) {
    return controller::alarm_title(alarm.number, alarm.text);
}

}  // namespace trunnion::emulator
