// Probing macros as three generations of a maker's set are written, each with the language that it
// leans on, on a web, a bore, a corner and a sphere: exact without noise.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/alarm.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {

namespace {

constexpr double exact = 1e-6;  // mm

setup::Setup mill() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w b X Y Z t\"\n"
        "axis.Z = { limits_mm = [-500, 600] }\n"
        "[control.work_offsets]\nG54 = { X = 100.0, Y = 50.0, Z = 20.0 }\n"
        "\"G54.1 P3\" = { X = 1.0 }\nexternal = { X = 0.5 }\n"
        "[control.signals]\n1004 = 1\n"
        "[control.tools]\n7 = { length_mm = 149.5, length_wear_mm = 0.5, diameter_mm = 6.0 }\n"
        "[probe]\ntool = 7\ntip_mm = [0, 0, -150]\nball_diameter_mm = 6.0\n"
        "[[artefact]]\nname = \"S\"\ncenter_mm = [250.6, 50.2, 40]\ndiameter_mm = 25.4\n"
        "[[body]]\nname = \"web\"\ncenter_mm = [110.5, 60, 15]\nsize_mm = [20.02, 30, 25]\n"
        "[[body]]\nname = \"bore\"\nkind = \"ring\"\ncenter_mm = [20.3, 49.8, 20]\n"
        "diameter_mm = 40.004\n"
        "[[body]]\nname = \"part\"\ncenter_mm = [100, -60, 20]\nsize_mm = [60, 40, 30]\n",
        "t.toml", notes);
}

emulator::RunLog log_of(const setup::Setup& setup, const std::string& main,
                        const std::string& library) {
    interpreter::ProgramFolders none({});
    const auto text = std::make_shared<const std::string>(
        "%\nO0001\nG90G21G17G40G80G54\nT7M6\nG43H7Z80.\n" + main + "M30\n" + library + "%\n");
    emulator::RunOptions options;
    for (int n = 100; n <= 199; ++n) options.wanted_variables.push_back(n);
    return emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", *text, text},
                                 options);
}

emulator::RunLog good_log(const std::string& main, const std::string& library) {
    const emulator::RunLog log = log_of(mill(), main, library);
    if (log.result.alarm)
        FAIL_CHECK(log.result.alarm->number << " " << log.result.alarm->text << " line "
                                            << log.result.alarm->where.line);
    return log;
}

/// M98 and common variables only; two touches; the length in force from the offset memory by
/// #4111; modes read and put back by computed G codes; positions compared with a tolerance.
const char* const first_generation = R"(
O8910(TWO TOUCHES TO #111 #112 #113, #114 FAST AND #116 SLOW: #121 #122 #123 THE BALL)
#118=#4003
#119=#4001
#117=#[11000+#4111]+#[10000+#4111]
#126=#5001
#127=#5002
#128=#5003
#130=SQRT[[#111-#126]*[#111-#126]+[#112-#127]*[#112-#127]+[#113-#128]*[#113-#128]]
G90G31X#111Y#112Z#113F#114
IF[[ABS[#5061-#111]+ABS[#5062-#112]+ABS[#5063-#117-#113]]LT.0001]GOTO9
G91G1X[-#115*[#111-#126]/#130]Y[-#115*[#112-#127]/#130]Z[-#115*[#113-#128]/#130]F#114
G90G31X#111Y#112Z#113F#116
#121=#5061
#122=#5062
#123=#5063-#117
G1X#126Y#127Z#128F#114
G#118G#119
M99
N9#3000=92(PROBE OPEN)
O8912(WEB ALONG X: #101 WIDTH, #102 DEPTH BELOW THE START, #103 RADIUS OF THE BALL)
#104=#5001
#105=#5003
#106=-1
WHILE[#106LE1]DO1
G90G1X[#104+#106*[#101/2+#103+8.]]F2000.
G91Z-#102
G90
#111=#104
#112=#5002
#113=#5003
M98P8910
#[150+#106]=#121
G91G1Z#102F2000.
G90X#104
#106=#106+2
END1
#107=[#149+#151]/2
#108=#151-#149-2*#103
M99
)";

/// G65 three deep with vacancy defaults; an input says that the probe is on, an output is set
/// while it measures; G53 home; the work offset is written by G10 and by #5221 on; a report.
const char* const second_generation = R"(
O9832(PROBE ON)
IF[#1004EQ1]GOTO1
#3000=93(PROBE NOT READY)
N1#1100=1
M99
O9833(PROBE OFF)
#1100=0
G53G0Z500.
M99
O9810(PROTECTED MOVE)
IF[#9EQ#0]THEN#9=3000.
#31=#4001
G31X#24Y#25Z#26F#9
IF[#24EQ#0]GOTO1
IF[ABS[#5061-#24]GT.02]GOTO9
N1IF[#25EQ#0]GOTO2
IF[ABS[#5062-#25]GT.02]GOTO9
N2IF[#26EQ#0]GOTO3
IF[ABS[#5063-#5083-#26]GT.02]GOTO9
N3G#31
M99
N9#3000=94(PATH OBSTRUCTED)
O9726(ONE TOUCH ALONG I J, Q FAR: #135 THE POSITION ALONG THEM)
#1=#5001
#2=#5002
G31X[#1+#4*#17]Y[#2+#5*#17]F#9
IF[ABS[#5061-#1]+ABS[#5062-#2]GE#17-.001]THEN#3000=95(NO SURFACE)
#135=#4*#5061+#5*#5062
G1X#1Y#2F#9
M99
O9814(BORE D, S WORK OFFSET 1 TO 6)
IF[#7EQ#0]THEN#3000=91(D MISSING)
IF[#9EQ#0]THEN#9=50.
#20=2
WHILE[#20GT0]DO1
G65P9726I-1.J0Q[#7/2+5.]F#9
#21=-#135
G65P9726I1.J0Q[#7/2+5.]F#9
#22=#135
G65P9810X[[#21+#22]/2]F3000.
G65P9726I0J-1.Q[#7/2+5.]F#9
#23=-#135
G65P9726I0J1.Q[#7/2+5.]F#9
#27=#135
G65P9810Y[[#23+#27]/2]F3000.
#20=#20-1
END1
#138=#22-#21+#12
#139=#27-#23+#12
#136=[#21+#22]/2
#137=[#23+#27]/2
IF[#19EQ#0]GOTO8
#28=5201+20*#19
G90G10L2P#19X[#[#28]+#136]Y[#[#28+1]+#137]
N8POPEN
DPRNT[BORE*D#138[34]*X#136[34]*Y#137[34]]
PCLOS
M99
O9000(12 IS THE DIAMETER OF THE BALL)
M99
)";

/// Argument specification II, G91 moves, checks switched off and on, messages, extended offsets by
/// number, tool memory, control parameters, a modal call, jumps by a computed number.
const char* const third_generation = R"(
O9701(CORNER: WAYS AND STEPS ALONG X AND Y AS TRIPLES I J K. #135 #136 THE CORNER)
#30=#4003
#3003=1
#31=#5001
#32=#5002
G91
G1Y#6F2000.
G31X#4F100.
#20=#5061
G90G1X#31F2000.
G91G1Y#6
G31X#4F100.
#21=#5061
G90G1X#31F2000.
Y#32
(THE SECOND I J K ARE #7 #8 #9)
G91G1X#9
G31Y#8F100.
#22=#5062
G90G1Y#32F2000.
G91G1X#9
G31Y#8F100.
#23=#5062
G90G1Y#32F2000.
#3003=0
#135=[#20+#21]/2+#10
#136=[#22+#23]/2+#11
GOTO[100+1]
N100#3000=96(NEVER)
N101G#30
M99
O9702(SPHERE: FIVE TOUCHES FROM ABOVE, D DIAMETER, A BALL. #140 #141 #142 CENTRE)
#3004=2
#29=#5043-#5003
#30=#5001
#31=#5002
#33=#5003
#1=[#1+#7]/2(DISTANCE OF THE CENTRES)
#10=0
WHILE[#10LT3]DO1
G90G0X#30Y#31Z#33
G31Z[#33-#7-20.]F200.
#20=#5063-#29(Z OF THE BALL ON TOP)
G1Z#33F2000.
#11=0
WHILE[#11LT4]DO2
#12=COS[90*#11]
#13=SIN[90*#11]
G1X[#30+#12*[#1+5.]]Y[#31+#13*[#1+5.]]F3000.
Z[#20-#1]
G31X#30Y#31F200.
#[21+#11]=#12*#5061+#13*#5062
G1X[#30+#12*[#1+5.]]Y[#31+#13*[#1+5.]]F3000.
Z#33
#11=#11+1
END2
#30=[#21-#23]/2
#31=[#22-#24]/2
#10=#10+1
END1
#3004=0
#140=#30
#141=#31
#142=#20-#1
#3006=1(LOOK AT THE SPHERE)
#143=#7001+40+#[7041]
#144=PRM[1020]
M99
O9703(MODAL: COUNTS)
#145=#145+1
M99
)";

}  // namespace

TEST_CASE("first generation: a web by M98 and common variables") {
    const auto log = good_log(
        "G0X10.3Y10.\nZ5.\n#101=20.\n#102=12.\n#103=3.\n#114=1000.\n#115=2.\n#116=30.\nM98P8912\n"
        "#109=#4003\n",
        first_generation);
    const auto& v = log.variables;
    CHECK(std::abs(v.at(107) - (110.5 - 100.5)) < exact);  // G54 and the external offset
    CHECK(std::abs(v.at(108) - 20.02) < exact);
    CHECK(v.at(109) == 90.0);
    const auto missed = log_of(mill(),
                               "G0X10.3Y10.\nZ30.\n#111=10.3\n#112=10.\n#113=20.\n#114=1000.\n"
                               "#115=2.\n#116=30.\nM98P8910\n",
                               first_generation);
    REQUIRE(missed.result.alarm);
    CHECK(missed.result.alarm->number == 3092);
    CHECK(missed.result.alarm->text.find("PROBE OPEN") != std::string::npos);
}

TEST_CASE("second generation: a bore sets its work offset, and the report says so") {
    const auto log = good_log("G0X-79.Y1.\nG65P9832\nG65P9810Z-8.\nG65P9814D40.M6.S2\nG65P9833\n",
                              second_generation);
    const auto& v = log.variables;
    CHECK(std::abs(v.at(136) - (20.3 - 100.5)) < exact);
    CHECK(std::abs(v.at(137) - (49.8 - 50.0)) < exact);
    // The ball is 6 mm, given as M: #13, so #12 is vacant and the widths are those of its centre.
    CHECK(std::abs(v.at(138) - 34.004) < exact);
    CHECK(std::abs(v.at(139) - 34.004) < exact);
    // G55 was 0: what was found in G54 is added to it, as macros do that trust the old offset.
    CHECK(std::abs(log.stores.work.standard[1][Axis::X] - (20.3 - 100.5)) < exact);
    CHECK(log.printed.find("BORE D") != std::string::npos);
    CHECK(log.stores.signals.at(1100) == 0.0);
    setup::Setup off = mill();
    off.stores.signals[1004] = 0.0;
    const auto refused = log_of(off, "G65P9832\n", second_generation);
    REQUIRE(refused.result.alarm);
    CHECK(refused.result.alarm->number == 3093);
    const auto hit = log_of(mill(), "G0X10.Y10.\nG65P9832\nG65P9810Z-20.\n", second_generation);
    REQUIRE(hit.result.alarm);
    CHECK(hit.result.alarm->number == 3094);
}

TEST_CASE("third generation: a corner with argument specification II") {
    // The corner stands at X 70, Y -80 in the machine; the ball starts outside of both faces.
    const auto log =
        good_log("G0X-45.Y-140.\nZ-10.\nG65P9701I20.J0K15.I0J20.K20.I3.J3.\n", third_generation);
    const auto& v = log.variables;
    CHECK(std::abs(v.at(135) - (70.0 - 100.5)) < exact);
    CHECK(std::abs(v.at(136) - (-80.0 - 50.0)) < exact);
}

TEST_CASE("third generation: a sphere in three rounds of five touches") {
    const auto log = good_log(
        "G0X149.7Y0.5\nZ60.\nG65P9702D25.4A6.\n#145=0\nG66P9703\nG0X140.\n"
        "X141.\nG67\nX142.\n",
        third_generation);
    const auto& v = log.variables;
    CHECK(std::abs(v.at(140) - (250.6 - 100.5)) < exact);
    CHECK(std::abs(v.at(141) - 0.2) < exact);
    CHECK(std::abs(v.at(142) - 20.0) < exact);
    CHECK(std::abs(v.at(143) - 41.0) < exact);  // #7001: G54.1 P1, #7041: P3
    CHECK(v.at(145) == 2.0);
}

}  // namespace trunnion
