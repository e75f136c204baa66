// A program run on a control without devices, and what check says of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "check/check.h"
#include "controller/alarms.h"
#include "controller/arcs.h"
#include "controller/block_trial.h"
#include "controller/controller.h"
#include "controller/g_codes.h"

namespace law {

using namespace trunnion;

class NoAxes : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove&) override { return {}; }
};

inline controller::ControlConfig five_axes() {
    controller::ControlConfig config;
    config.dialect = interpreter::fanuc_dialect();
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C})
        config.axes.push_back({axis, is_rotary(axis), {}, {}, {}, {}});
    return config;
}

inline check::CheckOptions options_for(const controller::ControlConfig& config,
                                       const offsets::Stores& stores) {
    check::CheckOptions options;
    options.dialect = config.dialect;
    options.knows_g = [](int code10) {
        return controller::find_g_code(code10 / 10.0) || (code10 >= 650 && code10 <= 670);
    };
    options.finds_program = [](int) { return false; };
    options.alarm_text = [](int number) { return controller::alarm_title(number, ""); };
    options.variable_alarm = [&config, &stores](int number, bool writes) {
        return controller::variable_alarm(number, writes, config, stores);
    };
    options.arc_fit = [](double start_mm, double end_mm) {
        return static_cast<check::ArcFit>(controller::fit_of_radii(start_mm, end_mm, 0.0));
    };
    options.chord_exceeds = [](double chord_mm, double radius_mm) {
        return controller::chord_exceeds(chord_mm, radius_mm, 0.0);
    };
    options.start_trial = [&config, &stores] {
        return std::make_unique<check::TrialBy<controller::BlockTrial>>(config, stores);
    };
    return options;
}

inline std::string pick(SeededNoise& noise, const std::vector<std::string>& from) {
    return from[static_cast<std::size_t>(noise.uniform() * static_cast<double>(from.size()))];
}

/// How a run ends, and all findings of check.
struct Outcome {
    controller::RunResult run;
    std::vector<check::Finding> findings;

    /// An error in this line; 0: in any.
    bool refused_by_check(int line = 0) const {
        for (const check::Finding& f : findings)
            if (f.severity == check::Severity::error && (line == 0 || f.line == line)) return true;
        return false;
    }
};

inline Outcome judge(const std::string& program_text) {
    controller::ControlConfig config = five_axes();
    config.max_blocks = 2000;
    offsets::Stores stores;
    stores.parameters.set(3401, 1);
    const auto text = std::make_shared<const std::string>(program_text);
    const interpreter::ProgramText program{"p.nc", *text, text};
    offsets::Stores own = stores;
    NoAxes sink;
    interpreter::ProgramsInMemory none;
    controller::Controller control(config, own, none, sink, [](std::string_view) {});
    Outcome out;
    out.run = control.run(program);
    out.findings = check::check_program(program, options_for(config, stores));
    return out;
}

}  // namespace law
