#include "cli/setup_rules.h"

#include <algorithm>
#include <memory>

#include "controller/alarms.h"
#include "controller/arcs.h"
#include "controller/block_trial.h"
#include "controller/code_calls.h"
#include "controller/g_codes.h"
#include "controller/hurco_codes.h"
#include "controller/m_codes.h"
#include "controller/missing_codes.h"
#include "emulator/run.h"

namespace trunnion::cli {

namespace {

/// True for codes that call programs by parameters 6050-6089 and 6001#5.
bool calls_program(const interpreter::CodeCalls& calls, char letter, int code10) {
    if (letter == 'T') return calls.t_calls_9000;
    return letter == 'G' ? calls.g.contains(code10)
                         : code10 % 10 == 0 && calls.m.contains(code10 / 10);
}

bool has_code(const controller::BuilderProfile& builder, char letter, int code10) {
    const auto in = [code10](const std::vector<int>& codes) {
        return std::find(codes.begin(), codes.end(), code10 / 10) != codes.end();
    };
    if (letter == 'M') return in(builder.m_codes) || in(builder.m_codes_after);
    return std::any_of(builder.g_codes.begin(), builder.g_codes.end(),
                       [code10](const controller::GCode& own) { return own.code10 == code10; });
}

bool has_axis(const setup::Setup& setup, Axis axis) {
    const auto axes = emulator::control_config(setup).axes;
    return std::any_of(axes.begin(), axes.end(),
                       [axis](const controller::ControlAxis& entry) { return entry.axis == axis; });
}

bool knows_g(const setup::Setup& setup, int code10) {
    const bool hurco = setup.dialect.family == interpreter::DialectFamily::hurco;
    const controller::GCode* code =
        hurco ? controller::find_hurco_g_code(code10 / 10.0, setup.hurco.bnc)
              : controller::find_g_code(code10 / 10.0);
    if (code) return code->action != controller::Action::thread || setup.threading;
    const bool of_language = code10 == 650 || code10 == 660 || code10 == 661 || code10 == 670;
    return of_language || has_code(setup.builder, 'G', code10);
}

}  // namespace

SetupRules::SetupRules(const setup::Setup& setup)
    : setup_(setup), calls_(controller::decode_code_calls(setup.stores.parameters)) {}

check::CheckOptions SetupRules::options() {
    check::CheckOptions out;
    out.dialect = setup_.dialect;
    out.arc_centres_are_places =
        setup_.hurco.bnc && setup_.dialect.family == interpreter::DialectFamily::hurco;
    out.work_offset_is_group_12 = setup_.work_offset_is_group_12;
    out.missing_option = [this](int code10) {
        const bool fanuc = setup_.dialect.family == interpreter::DialectFamily::fanuc;
        const char* option = fanuc ? controller::missing_option(code10) : nullptr;
        return std::string(option ? option : "");
    };
    out.knows_g = [this](int code10) {
        return knows_g(setup_, code10) || cli::calls_program(calls_, 'G', code10);
    };
    out.knows_m = [config = emulator::control_config(setup_)](int code) {
        return controller::knows_m(code, config);
    };
    out.builders_code = [this](char letter, int code10) {
        return has_code(setup_.builder, letter, code10);
    };
    out.has_u_axis = has_axis(setup_, Axis::U);
    out.calls_program = [this](char letter, int code10) {
        return cli::calls_program(calls_, letter, code10);
    };
    out.alarm_text = [](int number) {
        const controller::AlarmRow* row = controller::find_alarm(number);
        return controller::alarm_title(number, row ? row->text : "");
    };
    out.variable_alarm = [this](int number, bool writes) {
        const auto [known, fresh] = variables_.try_emplace({number, writes}, 0);
        if (fresh)
            known->second = trunnion::controller::variable_alarm(
                number, writes, emulator::control_config(setup_), setup_.stores);
        return known->second;
    };
    const auto bare = setup_.stores.parameters.find(3401);
    out.bare_is_unit = !bare || setup_.stores.parameters.bit(3401, 0);
    const double tolerance_mm = setup_.stores.parameters.get(3410);
    out.arc_fit = [tolerance_mm](double start_mm, double end_mm) {
        switch (controller::fit_of_radii(start_mm, end_mm, tolerance_mm)) {
            case controller::ArcFit::open: return check::ArcFit::open;
            case controller::ArcFit::refused: return check::ArcFit::refused;
            default: return check::ArcFit::good;
        }
    };
    out.chord_exceeds = [tolerance_mm](double chord_mm, double radius_mm) {
        return controller::chord_exceeds(chord_mm, radius_mm, tolerance_mm);
    };
    out.skip_switches = emulator::control_config(setup_).skip_switches;
    out.start_trial = [this] {
        return std::make_unique<check::TrialBy<controller::BlockTrial>>(
            emulator::control_config(setup_), setup_.stores);
    };
    return out;
}

}  // namespace trunnion::cli
