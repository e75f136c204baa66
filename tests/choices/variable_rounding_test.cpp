// A control that rounds the value of a variable in a position word, and logs that are only printed
// so.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

/// Multiples of a third and of a seventh, then digits of the program.
const std::string macro = R"(N10 G21 G90 G17 G54
N20 G0 X0. Y0. Z10.
N30 #1=1
N40 WHILE[#1LE12]DO1
N50 G1 X[10.*#1/3.] Y[20.-10.*#1/7.] F600
N60 #1=#1+1
N70 END1
N80 G1 X3.00049 Y1.00051
N90 G0 Z30.
N100 M30
)";

double rounded(double value, double increment) {
    return increment > 0.0 ? increment * std::round(value / increment) : value;
}

/// The macro on a control with this increment; `up`: an offset along Z; `rests`: rows at each end.
records::PositionLog macro_log(double increment, double up = 0.0, int rests = 0) {
    SampledLog log({0, 0, up});
    log.to(20, {0, 0, 10 + up}, 2.0);
    const auto stop = [&](int block, const log_bench::Place& at) {
        log.to(block, at, 0.3);
        for (int k = 0; k < rests; ++k) log.add(block, at);
    };
    for (int k = 1; k <= 12; ++k)
        stop(50,
             {rounded(10.0 * k / 3, increment), rounded(20 - 10.0 * k / 7, increment), 10 + up});
    stop(80, {3.00049, 1.00051, 10 + up});
    log.to(90, {3.00049, 1.00051, 30 + up}, 2.0);
    return log.log;
}

const std::string inch_macro = R"(N10 G20 G90 G17 G54
N20 G0 X0. Y0. Z.4
N30 #1=1
N40 WHILE[#1LE12]DO1
N50 G1 X[#1/3.] Y[.8-#1/7.] F20.
N60 #1=#1+1
N70 END1
N80 G1 X.11813 Y.03937
N90 G0 Z1.2
N100 M30
)";

records::PositionLog inch_log(double increment) {
    constexpr double inch = 25.4;
    SampledLog log({0, 0, 0});
    log.to(20, {0, 0, 0.4 * inch}, 2.0);
    for (int k = 1; k <= 12; ++k)
        log.to(50,
               {inch * rounded(k / 3.0, increment), inch * rounded(0.8 - k / 7.0, increment),
                0.4 * inch},
               0.3);
    log.to(80, {0.11813 * inch, 0.03937 * inch, 0.4 * inch}, 0.3);
    log.to(90, {0.11813 * inch, 0.03937 * inch, 1.2 * inch}, 2.0);
    return log.log;
}

records::PositionLog printed(records::PositionLog log, double step) {
    for (records::LoggedPosition& row : log.rows)
        for (const Axis axis : log.axes) row.at[axis] = rounded(row.at[axis], step);
    log.step = step;
    return log;
}

setup::Setup rounding_mill(const std::string& name) {
    return mill_of("variable_rounding = \"" + name + "\"\n");
}

std::string name_of(const choices::ControlGap& gap) {
    return gap.causes.size() == 1 ? gap.causes[0].name : std::to_string(gap.causes.size());
}

}  // namespace

// A rounding to 0.001 mm may hide in the noise of a log that states none; one to 0.0001 inch does
// not.
TEST_CASE("a control that rounds variables to 0.01 mm or 0.0001 inch is named") {
    struct Case {
        const char* name;
        std::string program;
        records::PositionLog log;
    };
    for (const Case& c :
         {Case{"IS-A", macro, macro_log(0.01, 0.0, 20)}, {"IS-B", inch_macro, inch_log(1e-4)}}) {
        INFO(c.name);
        const auto gap = gap_of(mill_of(), c.log, c.program);
        CHECK(gap.verdict == GapVerdict::explained);
        REQUIRE(name_of(gap) == std::string("variable_rounding=") + c.name);
        CHECK(gap.causes[0].probability > 0.7);
        CHECK(gap.causes[0].first.line == 5);
        CHECK(gap.after.shrink > 0.9);
        const auto written = log_bench::setup_of(setup::format_setup(gap.setup));
        CHECK(gap_of(written, c.log, c.program).verdict == GapVerdict::no_gap);
    }
}

TEST_CASE("a control that keeps all digits is no gap, and is named where the setup rounds") {
    CHECK(gap_of(mill_of(), macro_log(0.0), macro).verdict == GapVerdict::no_gap);
    // What IS-C would change is within the noise: it is as likely.
    const auto gap = gap_of(rounding_mill("IS-B"), macro_log(0.0, 0.0, 20), macro);
    CHECK(name_of(gap) == "variable_rounding=none");
    CHECK(gap.verdict == GapVerdict::ambiguous);
    CHECK(gap.causes[0].rivals == std::vector<std::string>{"variable_rounding=IS-C"});
    CHECK(name_of(gap_of(rounding_mill("IS-B"), macro_log(0.01), macro)) ==
          "variable_rounding=IS-A");
}

TEST_CASE("a log that is printed to the increment does not show a rounding by the control") {
    for (const double step : {0.01, 0.001})
        for (const double increment : {0.0, step}) {
            INFO(step << ' ' << increment);
            const auto log = printed(macro_log(increment, 0.0, 20), step);
            CHECK(gap_of(mill_of(), log, macro).causes.empty());
            const auto higher = printed(macro_log(increment, 0.05, 20), step);
            for (const choices::GapCause& cause : gap_of(mill_of(), higher, macro).causes)
                CHECK_THAT(cause.name, !Catch::Contains("variable_rounding"));
        }
}

TEST_CASE("a rounding that adds up under G91 shows beyond the digits of the log") {
    std::string program = "N1 G21 G90 G17 G54\nN2 G0 X0. Y0. Z10.\nN3 G91\n";
    SampledLog log({0, 0, 0});
    log.to(2, {0, 0, 10}, 2.0);
    for (int k = 1; k <= 40; ++k) {
        program += "N" + std::to_string(10 + k) + " G1 X[4./3.] Y[2./3.] F600\n";
        log.to(10 + k, {1.333 * k, 0.667 * k, 10}, 0.3);
    }
    program += "N60 G90 G0 Z30.\nN70 M30\n";
    log.to(60, {1.333 * 40, 0.667 * 40, 30}, 2.0);
    const auto gap = gap_of(mill_of(), printed(log.log, 0.001), program);
    CHECK(name_of(gap) == "variable_rounding=IS-B");
    CHECK(gap.verdict == GapVerdict::explained);
}

TEST_CASE("a rounding stands beside a stale offset") {
    const auto gap = gap_of(mill_of(), macro_log(0.01, 0.05), macro);
    REQUIRE(gap.causes.size() == 2);
    CHECK(gap.causes[0].numbers.size() + gap.causes[1].numbers.size() == 1);
    CHECK((gap.causes[0].name == "variable_rounding=IS-A" ||
           gap.causes[1].name == "variable_rounding=IS-A"));
}

}  // namespace trunnion
