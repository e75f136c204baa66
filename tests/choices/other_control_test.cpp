// Logs of another control: its roundings, its numbers of blocks, offsets that are empty here.
#include "choices/offset_words.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

const std::string levels = R"(N10 G21 G90 G17 G54
N20 G0 X10. Y10. Z30.
N30 G1 Z-2.1256 F600
N40 X60.
N50 Y40.
N60 Z-4.3744
N70 X10.
N80 Y10.
N90 G0 Z30.
N100 M30
)";
constexpr const char* offset = "work_offsets.G54 = { X = -12.3456, Y = 8.7544, Z = -100.7044 }\n";

/// The levels at G54, `up` higher, printed with an increment of `step`.
records::PositionLog levels_log(double up, double step) {
    constexpr double x = -12.3456, y = 8.7544;
    const double z = -100.7044 + up;
    SampledLog log({0, 0, 0});
    log.to(20, {x + 10, y + 10, z + 30}, 2.0);
    const double cut = 0.25;
    log.to(30, {x + 10, y + 10, z - 2.1256}, cut);
    log.to(40, {x + 60, y + 10, z - 2.1256}, cut);
    log.to(50, {x + 60, y + 40, z - 2.1256}, cut);
    log.to(60, {x + 60, y + 40, z - 4.3744}, cut);
    log.to(70, {x + 10, y + 40, z - 4.3744}, cut);
    log.to(80, {x + 10, y + 10, z - 4.3744}, cut);
    log.to(90, {x + 10, y + 10, z + 30}, 2.0);
    for (records::LoggedPosition& row : log.log.rows)
        for (const Axis axis : log.log.axes) row.at[axis] = step * std::round(row.at[axis] / step);
    log.log.step = step;
    return log.log;
}

const std::string tools = R"(G90 G54
(H7 IS NO TOOL OF THIS PROGRAM)
G0 X5. Y7. Z90.
X6. Z80.
G43 H3 G0 X10. Y10. Z30.
G1 Z-2. F600
X60.
Y40.
G0 Z30.
X0.
Z50.
M30
)";

}  // namespace

TEST_CASE("the rounding of printed positions is alike in all rows at rest, and no stale store") {
    CHECK(gap_of(mill_of(offset), levels_log(0.0, 0.01), levels).verdict == GapVerdict::no_gap);
    CHECK(gap_of(mill_of(offset), levels_log(0.0, 0.001), levels).verdict == GapVerdict::no_gap);
    const auto higher = gap_of(mill_of(offset), levels_log(0.03, 0.01), levels);
    REQUIRE(higher.causes.size() == 1);
    CHECK(higher.causes[0].numbers.size() == 1);
    CHECK(std::abs(higher.causes[0].numbers[0].to - higher.causes[0].numbers[0].from - 0.03) <
          0.006);
}

TEST_CASE("an offset that is empty on this control and called by the program may be the cause") {
    CHECK(choices::offset_words({log_bench::program_of(tools)}) == std::set<int>{3});
    CHECK(choices::offset_words({log_bench::program_of("G41D12X1.T0305(D4)\nH#3 #5=LENGTH2")}) ==
          std::set<int>{12, 305});
    const auto there = mill_of("tools.3 = { length_mm = 85.25, diameter_mm = 0 }\n");
    const auto gap = gap_of(mill_of(), log_bench::log_of(there, tools), tools);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "H3");
    CHECK(gap.causes[0].numbers[0].to == Approx(85.25).margin(1e-3));
    const auto back = gap_of(there, log_bench::log_of(mill_of(), tools), tools);
    REQUIRE(back.causes.size() == 1);
    CHECK(back.causes[0].name == "H3");
}

TEST_CASE("a log without numbers of a whole program shows a length far from this control's") {
    const std::string program = R"(G90 G54
G0 X5. Y5.
Z60.
X49. Y13.
Z40.
G1 Z-5. F100
X30. Y20.
X10.
G0 Z60.
G43 H3
G0 X70. Y-2. Z60.
Z10.
G1 Z-3.
X60. Y10.
X20.
G0 Z60.
M30
)";
    const auto there = mill_of("tools.3 = { length_mm = 65.5, diameter_mm = 0 }\n");
    records::PositionLog log = log_bench::log_of(there, program);
    log.blocks = records::BlockColumn::none;
    const auto here = mill_of("tools.3 = { length_mm = 12, diameter_mm = 0 }\n");
    const auto gap = gap_of(here, log, program);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "H3");
    REQUIRE(gap.causes[0].numbers.size() == 1);
    CHECK(gap.causes[0].numbers[0].to == Approx(65.5).margin(1e-3));
}

TEST_CASE("an edited block far away hides neither a stale store nor an option beside it") {
    const auto program = [](const char* edited) {
        return std::string(R"(G90 G54
G0 X5. Y5. Z90.
X6. Z80.
G43 H3
G0 X10. Y10. Z30.
G1 Z-2. F600
X60.
)") + edited + R"(
X20. Y15.
Y30.
X40. Y50.
G0 Z30.
X0. Y0.
Z50.
M30
)";
    };
    const auto mill = [](double length, const char* bits) {
        return mill_of("tools.3 = { length_mm = " + std::to_string(length) +
                       ", diameter_mm = 0 }\n[control.parameters]\n5006 = \"" + bits + "\"\n");
    };
    const std::string here = program("Y40."), there = program("Y88.");
    const auto stale =
        gap_of(mill(60.0, "01000000"), log_bench::log_of(mill(60.04, "01000000"), there), here);
    CHECK(stale.verdict == GapVerdict::partly_explained);
    REQUIRE(stale.causes.size() == 2);
    const auto length = std::find_if(stale.causes.begin(), stale.causes.end(),
                                     [](const auto& cause) { return cause.name == "H3"; });
    REQUIRE(length != stale.causes.end());
    CHECK(length->probability > 0.5);
    CHECK(length->numbers[0].to == Approx(60.04).margin(1e-3));
    const auto option =
        gap_of(mill(60.0, "00000000"), log_bench::log_of(mill(60.0, "01000000"), there), here);
    CHECK(option.verdict == GapVerdict::partly_explained);
    CHECK(option.causes[0].name == "5006#6=1");
    const auto edited =
        gap_of(mill(60.0, "01000000"), log_bench::log_of(mill(60.0, "01000000"), there), here);
    CHECK(edited.verdict == GapVerdict::unexplained);
}

TEST_CASE("a control that rounds to its least increment on arcs does not hide an exact cause") {
    const std::string program = R"(G90 G54 G17
G0 X10. Y10. Z30.
G43 H1
G0 X20.
G1 Z2. F300
G2 X40. Y30. R20.
G3 X60. Y10. R20.
G2 X80. Y30. R20.
G3 X60. Y50. R20.
G1 X30.
G0 Z30.
M30
)";
    const auto mill = [](const char* bits) {
        return mill_of(
            "tools.1 = { length_mm = 10.5, diameter_mm = 0 }\n[control.parameters]\n"
            "5006 = \"" +
            std::string(bits) + "\"\n");
    };
    records::PositionLog log = log_bench::log_of(mill("01000000"), program);
    for (std::size_t k = 0; k < log.rows.size(); ++k)  // within half an increment of 0.001 mm
        log.rows[k].at[Axis::X] += (k % 2 == 0 ? 0.0005 : -0.0004);
    const auto gap = gap_of(mill("00000000"), log, program);
    REQUIRE_FALSE(gap.causes.empty());
    CHECK(gap.causes[0].name == "5006#6=1");
    // Its two rivals have the same share of what two blocks can prove.
    CHECK(gap.causes[0].probability * (1.0 + static_cast<double>(gap.causes[0].rivals.size())) >
          0.7);
    CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
}

TEST_CASE("a short move of a repeated subprogram may have a sample in one of its passes only") {
    const std::string main = "N1 M98 P200 L2\nN2 M30\n";
    const std::string sub = R"(O200
N40 G91 G1 X20. F600
N50 Y15.
N60 G0 Z1.
N70 G1 X5.
N80 M99
)";
    SampledLog log({0, 0, 0});
    log_bench::Place at = {0, 0, 0};
    for (const bool sampled : {false, true}) {
        const auto by = [&](int block, double x, double y, double z, double step) {
            at = {at[0] + x, at[1] + y, at[2] + z};
            log.to(block, at, step);
        };
        by(40, 20, 0, 0, 0.5);
        by(50, 0, 15, 0, 0.5);
        if (!sampled) {
            // Its one period passes before a sample is taken: the next one is at the same block.
            at[2] += 1;
            log.to(70, at, 1.5);
        } else {
            by(60, 0, 0, 1, 1.5);
            log.add(60, at);
        }
        by(70, 5, 0, 0, 0.5);
    }
    interpreter::ProgramsInMemory none;
    const std::string all = main + sub;
    const interpreter::ProgramText text = log_bench::program_of(all);
    const auto gap = choices::control_gap({mill_of(), log.log, text, 1'000'000, {}}, none,
                                          [&text] { return std::vector{text}; });
    CHECK(gap.verdict == GapVerdict::no_gap);
}

TEST_CASE("numbers of the block that is read ahead do not make a gap of positions that agree") {
    records::PositionLog log = log_bench::log_of(mill_of(offset), levels);
    for (std::size_t k = 0; k + 1 < log.rows.size(); ++k) log.rows[k].block = log.rows[k + 1].block;
    const auto gap = gap_of(mill_of(offset), log, levels);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(has_note(gap, "the positions agree in their order"));
    const auto stale = gap_of(mill_of(), log, levels);
    CHECK(stale.verdict == GapVerdict::ambiguous);  // G54 or the external offset
    REQUIRE_FALSE(stale.causes.empty());
    CHECK(stale.causes[0].numbers.size() == 3);
}

TEST_CASE("a rapid without interpolation is compared with its corner") {
    const auto there = log_bench::setup_of(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[control]\ndialect = \"hurco\"\n");
    const choices::ControlPath path = [&] {
        interpreter::ProgramsInMemory none;
        return choices::path_of(there, log_bench::program_of("N10 G0 X50. Y-30. Z7.\nN20 M30\n"),
                                none, {});
    }();
    // All axes at the same speed: Z arrives first, then Y, then X.
    for (const Vector3& corner : {Vector3(7, -7, 7), Vector3(30, -30, 7), Vector3(50, -30, 7)}) {
        double nearest = 1e9;
        for (const choices::PathNode& node : path.nodes)
            nearest = std::min(
                nearest,
                (Vector3(node.at.value[0], node.at.value[1], node.at.value[2]) - corner).norm());
        CHECK(nearest < 0.001);
    }
    CHECK(path.nodes.size() < 100);
}

TEST_CASE("a Fanuc whose rapids are doglegs is no Hurco alone") {
    const std::string program =
        "N10 G21 G90 G17 G54\nN20 G0 X40. Y-10.\nN30 X5. Y-60. Z20.\nN40 G1 X20. F600\nN50 G0 "
        "X-30. Y0. Z10.\nN60 X10. Y25.\nN70 M30\n";
    SampledLog log({0, 0, 0});
    const auto rapid = [&](int block, log_bench::Place end) {
        // All axes at one speed: each stops where it arrives.
        for (;;) {
            const log_bench::Place from = log.at();
            double least = 0.0;
            for (std::size_t k = 0; k < 3; ++k)
                if (const double way = std::abs(end[k] - from[k]); way > 1e-9)
                    least = least > 0.0 ? std::min(least, way) : way;
            if (least == 0.0) return;
            log_bench::Place next = from;
            double moving = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::abs(end[k] - from[k]) <= 1e-9) continue;
                next[k] += std::copysign(least, end[k] - from[k]);
                moving += 1.0;
            }
            log.to(block, next, std::sqrt(moving));
        }
    };
    rapid(20, {40, -10, 0});
    rapid(30, {5, -60, 20});
    log.to(40, {20, -60, 20}, 0.3);
    rapid(50, {-30, 0, 10});
    rapid(60, {10, 25, 10});
    const auto gap = gap_of(mill_of(), log.log, program);
    REQUIRE(gap.causes.size() == 1);
    const choices::GapCause& cause = gap.causes[0];
    CHECK(cause.name == "rapids_are_doglegs=true");
    CHECK(gap.verdict == GapVerdict::ambiguous);
    CHECK(std::find(cause.rivals.begin(), cause.rivals.end(), "dialect=hurco") !=
          cause.rivals.end());
    CHECK(gap.setup.rapids_are_doglegs);
}

TEST_CASE("rows behind a stop that are left to earlier moves do not ask for another control") {
    const std::string twice = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y2. Z30.
N30 G1 X40. F400
N40 Y30.
N50 X0. Y9.
N60 G4 P0.5
N70 G1 X42. Y3.
N80 Y33.
N90 X4. Y11.
N100 X40. Y1.
N110 Y28.
N120 M30
)";
    const auto there = log_bench::setup_of(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[control]\ndialect = \"hurco\"\n"
        "hurco = { rapids_are_interpolated = true }\n");
    records::PositionLog log = log_bench::log_of(there, twice);
    log.blocks = records::BlockColumn::none;
    for (records::LoggedPosition& row : log.rows) row.block = 0;
    const auto gap = gap_of(mill_of(), log, twice);
    REQUIRE(!gap.causes.empty());
    for (const choices::GapCause& cause : gap.causes) CHECK(cause.probability < 0.7);
    CHECK(gap.causes[0].name == "dialect=hurco");
    REQUIRE(!gap.causes[0].rivals.empty());
    CHECK(gap.causes[0].rivals.back() == "another meaning of the block that stops");
}

TEST_CASE("a log that begins at the end of the first move shows the offset that ends there") {
    const std::string first = R"(N10 G21 G90 G17 G54
N20 G43 H1 Z50.
N30 G0 X10. Y10.
N40 Z30.
N50 G1 Z-2. F600
N60 X60.
N70 Y40.
N80 X10. Y12.
N90 G0 Z30.
N100 M30
)";
    const auto here = mill_of(
        "work_offsets.G54 = { X = 12.5, Y = -8.0, Z = 3.25 }\n"
        "tools.1 = { length_mm = 150, diameter_mm = 0 }\n");
    constexpr double x = 12.6, y = -8.0, z = 153.05;
    SampledLog log({0, 0, z + 50});
    log.add(20, {0, 0, z + 50});
    log.add(30, {x + 10, y + 10, z + 50});
    log.add(40, {x + 10, y + 10, z + 30});
    log.add(50, {x + 10, y + 10, z - 2});
    log.add(60, {x + 60, y + 10, z - 2});
    log.add(70, {x + 60, y + 40, z - 2});
    log.add(80, {x + 10, y + 12, z - 2});
    log.add(90, {x + 10, y + 12, z + 30});
    const auto gap = gap_of(here, log.log, first);
    double up = 0.0;
    for (const choices::GapCause& cause : gap.causes)
        for (const choices::FittedNumber& number : cause.numbers)
            if (number.name.back() == 'Z' || number.name == "H1") up += number.to - number.from;
    CHECK(up == Approx(-0.2).margin(1e-4));
}

}  // namespace trunnion
