#include "analysis/ballbar_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/ballbar_published.h"
#include "geometry/alarm.h"
#include "geometry/units.h"

namespace trunnion {

namespace {

// Letters in braces are filled in: {R} {C} rotary axes, {U} linear axis along the first of them,
// {ZU} plane of Z and U with the angle {Z} of Z in it, {ACROSS} plane across U with {ZX} of Z.
const char* const main_program = R"(O8200 (SINGLE SET-UP BALLBAR TEST, {R}-{C} TABLE, ONE RUN)
(THE BAR STAYS IN PLACE FROM THE FIRST TEST TO THE LAST: PLANAR ARCS ABOUT THE PIVOT,)
(TCP OFF, LEAD FROM ONE STATION OF THE CUP TO THE NEXT.)
M98P8210
M98P8215
(LOCATION OF THE PIVOT)
G65P8220A18B[-#566/2.]C[#566/2.]H0
G65P8220A19B[90.-#566/2.]C[90.+#566/2.]H90.
M98P8216
G65P8230A17B#568C#569
G65P8220A17B#569C[#569+360.]H#569
G65P8230A17B#569C#568
M98P8217
M98P8218
M30
)";

const char* const kinematic_program =
    R"(O8300 (KINEMATIC TESTS BK1 BK2 BK4 AFTER ISO 10791-6, {R}-{C} TABLE)
(TWO ROTARY AXES UNDER THE WORKPIECE: THE CUP KEEPS ITS PLACE ON THE TABLE WHILE THEY TURN.)
(BK1: TILTING AXIS {R} WITH THE LINEAR AXES, BK2: TURNING AXIS {C} WITH THE LINEAR AXES,)
(BK4: ALL FIVE AXES AT ONCE.)
M98P8210
M98P8215
M98P8216
M98P8217
(BK4: {R} OVER ITS RANGE WHILE {C} GOES OVER ITS OWN)
G65P8260X0Y0Z#550
G93G1{R}#562{C}#564F[#560/90.]
DPRNT[BALLBAR*ON*BK4*POS]
{R}#563{C}#565F[#560/ABS[#565-#564]]
DPRNT[BALLBAR*OFF]
DPRNT[BALLBAR*ON*BK4*NEG]
{R}#562{C}#564F[#560/ABS[#565-#564]]
DPRNT[BALLBAR*OFF]
{R}0{C}0F[#560/90.]
G94
G65P8261X0Y0Z#550
M98P8218
M30
)";

const char* const data_program = R"(
O8210 (BALLBAR: OPERATOR'S DATA, GIVEN OR AS WRITTEN HERE)
(#550 L0 LENGTH OF THE BAR)
IF[#550EQ#0]THEN#550={L0}
(#551 #552 OX OY PIVOT FROM THE {C} AXIS, #553 OZ PIVOT ABOVE THE {R} AXIS)
IF[#551EQ#0]THEN#551={OX}
IF[#552EQ#0]THEN#552={OY}
IF[#553EQ#0]THEN#553={OZ}
(#554 #555 #556 MACHINE COORDINATES X Y Z WHERE THE ROTARY AXES MEET)
IF[#554EQ#0]THEN#554={PX}
IF[#555EQ#0]THEN#555={PY}
IF[#556EQ#0]THEN#556={PZ}
(#557 OFFSET NUMBER OF THE TOOL CUP, #558 MACHINE Z THAT CLEARS EVERYTHING)
IF[#557EQ#0]THEN#557={H}
IF[#558EQ#0]THEN#558={SAFE}
(#559 FEED OF THE CIRCLES, #560 TURNING SPEED IN DEG/MIN, #561 OVERSHOOT IN DEG)
IF[#559EQ#0]THEN#559={FEED}
IF[#560EQ#0]THEN#560={TURN}
IF[#561EQ#0]THEN#561={OVER}
(#562 #563 RANGE OF {R}, #564 #565 RANGE OF {C}, #566 ARC OF THE YZ AND ZX CIRCLES)
IF[#562EQ#0]THEN#562={R1}
IF[#563EQ#0]THEN#563={R2}
IF[#564EQ#0]THEN#564={C1}
IF[#565EQ#0]THEN#565={C2}
IF[#566EQ#0]THEN#566={ARC}
(STATIONS OF THE CUP: ABOVE THE PIVOT, AXIAL {C}.)
(#567 RADIAL {R}: ANGLE IN THE PLANE ACROSS {U})
#567={RADIAL1}
(#568 #571 AXIAL {R}: ANGLE IN XY AND IN THE PLANE OF Z AND {U})
#572=1.
IF[{OU}LT0]THEN#572=-1.
#568={AXIAL1XY}
#571={AXIAL1}
(#569 RADIAL {C}: ANGLE IN XY, THE SHORT WAY FROM THERE)
#569=ATAN[#552]/[#551]
IF[[#569-#568]GT180.]THEN#569=#569-360.
IF[[#569-#568]LT-180.]THEN#569=#569+360.
M99

O8215 (BALLBAR: ORIGIN AT THE PIVOT, CUP ABOVE IT)
G21G17G40G49G80G90G94
G10L2P6X[#554+#551]Y[#555+#552]Z[#556+#553]{R}0{C}0
POPEN
G53G0Z#558
G59
G0{R}0{C}0
G0X0Y0
G43H#557Z[#550+10.]
M0(MOUNT THE BAR)
(TELLS THE PC THAT PASSES WILL BE ANNOUNCED)
DPRNT[BALLBAR*ON*SETUP]
DPRNT[BALLBAR*OFF]
G1Z#550F500.
M99

O8216 (BALLBAR: TESTS OF {R}, THEN THE CUP BESIDE THE PIVOT ALONG {U})
G65P8230A{ACROSS}B{ZX}C#567
G65P8260{RADIAL1POINT}
G65P8240A1
G65P8261{RADIAL1POINT}
G65P8230A{ACROSS}B#567C{ZX}
G65P8230A{ZU}B{Z}C#571
G65P8260{AXIAL1POINT}
G65P8240A2
G65P8261{AXIAL1POINT}
M99

O8217 (BALLBAR: TESTS OF {C}, THEN THE CUP ABOVE THE PIVOT)
G65P8230A17B#568C#569
G65P8260X[#550*COS[#569]]Y[#550*SIN[#569]]Z0
G65P8250A1
G65P8261X[#550*COS[#569]]Y[#550*SIN[#569]]Z0
G65P8230A17B#569C#568
G65P8230A{ZU}B#571C{Z}
G65P8260X0Y0Z#550
G65P8250A2
G65P8261X0Y0Z#550
M99

O8218 (BALLBAR: END)
M0(TAKE THE BAR OFF)
G0Z[#550+10.]
PCLOS
G53G0Z#558
G49
M99

O8220 (BALLBAR: PLANAR TEST, BOTH WAYS)
(A #1 PLANE 17 18 19, B #2 FROM, C #3 TO, H #11 ANGLE WHERE THE CUP STANDS)
#21=ROUND[#559]
G65P8230A#1B#11C[#2-#561]
G65P8230A#1B[#2-#561]C#2
IF[#1EQ18]GOTO18
IF[#1EQ19]GOTO19
DPRNT[BALLBAR*ON*XY*CCW*#21[50]]
GOTO20
N18DPRNT[BALLBAR*ON*ZX*CCW*#21[50]]
GOTO20
N19DPRNT[BALLBAR*ON*YZ*CCW*#21[50]]
N20G65P8230A#1B#2C#3
DPRNT[BALLBAR*OFF]
G65P8230A#1B#3C[#3+#561]
G65P8230A#1B[#3+#561]C#3
IF[#1EQ18]GOTO28
IF[#1EQ19]GOTO29
DPRNT[BALLBAR*ON*XY*CW*#21[50]]
GOTO30
N28DPRNT[BALLBAR*ON*ZX*CW*#21[50]]
GOTO30
N29DPRNT[BALLBAR*ON*YZ*CW*#21[50]]
N30G65P8230A#1B#3C#2
DPRNT[BALLBAR*OFF]
G65P8230A#1B#2C[#2-#561]
G65P8230A#1B[#2-#561]C#11
M99

O8230 (BALLBAR: ARC ABOUT THE PIVOT, TCP OFF)
(A #1 PLANE, B #2 FROM, C #3 TO, COUNTER-CLOCKWISE POSITIVE)
IF[ABS[#2-#3]LT.001]GOTO99
#20=#550*COS[#2]
#21=#550*SIN[#2]
#22=#550*COS[#3]
#23=#550*SIN[#3]
#24=3
IF[#3LT#2]THEN#24=2
IF[#1EQ18]GOTO18
IF[#1EQ19]GOTO19
G17G#24X#22Y#23I-#20J-#21F#559
GOTO99
N18G18G#24Z#22X#23K-#20I-#21F#559
GOTO98
N19G19G#24Y#22Z#23J-#20K-#21F#559
N98G17
N99M99
)";

// {N} number of the test, {L} letter, {LOW} {HIGH} range: once for each rotary axis.
const char* const rotary_program = R"(
O{N}0 (BALLBAR: TEST OF {L}, BOTH WAYS, TCP ON: THE CUP KEEPS ITS PLACE ON THE TABLE)
(A #1 KIND: 1 RADIAL, 2 AXIAL)
#570=0
G65P{N}1A[{LOW}-#561]
G65P{N}1A{LOW}
IF[#1EQ2]GOTO2
DPRNT[BALLBAR*ON*RADIAL*{L}*POS]
GOTO3
N2DPRNT[BALLBAR*ON*AXIAL*{L}*POS]
N3G65P{N}1A{HIGH}
DPRNT[BALLBAR*OFF]
G65P{N}1A[{HIGH}+#561]
G65P{N}1A{HIGH}
IF[#1EQ2]GOTO4
DPRNT[BALLBAR*ON*RADIAL*{L}*NEG]
GOTO5
N4DPRNT[BALLBAR*ON*AXIAL*{L}*NEG]
N5G65P{N}1A{LOW}
DPRNT[BALLBAR*OFF]
G65P{N}1A[{LOW}-#561]
G65P{N}1A0
M99

O{N}1 (BALLBAR: TURN {L} TO #1, INVERSE TIME, SO THAT THE SPEED IS IN DEG/MIN)
IF[#1EQ#570]GOTO9
G93G1{L}#1F[#560/ABS[#1-#570]]
G94
#570=#1
N9M99
)";

// Switching names the point where the cup stands, so that nothing moves whatever parameters say.
const char* const switch_program = R"(
O8260 (BALLBAR: TCP ON, THE CUP STANDS AT X #24 Y #25 Z #26)
{ON}
M99

O8261 (BALLBAR: TCP OFF, THE CUP STANDS AT X #24 Y #25 Z #26)
{OFF}
M99
)";

using Words = std::map<std::string, std::string>;

std::string fill(std::string text, const Words& words) {
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at)) {
        const std::size_t end = text.find('}', at);
        const std::string value = words.at(text.substr(at + 1, end - at - 1));
        text.replace(at, end - at + 1, value);
    }
    return text;
}

/// NC number: always with a decimal point, no more digits than needed.
std::string nc(double value) {
    std::string text = fmt::format("{:.6f}", value == 0.0 ? 0.0 : value);
    while (text.back() == '0') text.pop_back();
    return text;
}

char linear_along(const AxisGeometry& axis) {
    return std::abs(axis.direction.x()) > 0.5 ? 'X' : 'Y';
}

/// Planes, angles and points of the stations; U is X or Y.
void add_stations(Words& words, bool along_x) {
    const std::string c = "[#550*COS[#567]]", s = "[#550*SIN[#567]]";
    const auto put = [&](const char* name, const char* for_x, const char* for_y) {
        words[name] = along_x ? for_x : for_y;
    };
    put("OU", "#551", "#552");
    put("ZU", "18", "19");
    put("Z", "0", "90.");
    put("ACROSS", "19", "18");
    put("ZX", "90.", "0");
    put("RADIAL1", "ATAN[#553]/[#552]", "ATAN[#551]/[#553]");
    put("AXIAL1", "90.*#572", "90.-90.*#572");
    put("AXIAL1XY", "90.-90.*#572", "90.*#572");
    put("AXIAL1POINT", "X[#572*#550]Y0Z0", "X0Y[#572*#550]Z0");
    words["RADIAL1POINT"] = along_x ? "X0Y" + c + "Z" + s : "X" + s + "Y0Z" + c;
}

Words words_of(const Machine& nominal, const BallbarProgramData& data) {
    const auto [first, second] = table_axes(nominal.chain);
    const Vector3 meet = nominal_intersection(first, second).first;
    const Vector3 offset = data.layout.pivot_W_mm - meet;
    const char u = linear_along(first);
    const auto deg = [](double rad) { return nc(deg_from_rad(rad)); };
    Words words = {{"R", std::string(1, letter_of(first.axis))},
                   {"C", std::string(1, letter_of(second.axis))},
                   {"U", std::string(1, u)},
                   {"L0", nc(data.layout.length_mm)},
                   {"OX", nc(offset.x())},
                   {"OY", nc(offset.y())},
                   {"OZ", nc(offset.z())},
                   {"PX", nc(meet.x())},
                   {"PY", nc(meet.y())},
                   {"PZ", nc(meet.z())},
                   {"H", std::to_string(data.tool_offset)},
                   {"SAFE", nc(data.safe_z_mm)},
                   {"FEED", nc(data.feed_mm_min)},
                   {"TURN", nc(data.turn_deg_min)},
                   {"OVER", nc(data.overshoot_deg)},
                   {"R1", deg(data.layout.first_rad.first)},
                   {"R2", deg(data.layout.first_rad.second)},
                   {"C1", deg(data.layout.second_rad.first)},
                   {"C2", deg(data.layout.second_rad.second)},
                   {"ARC", deg(data.layout.partial_rad)}};
    add_stations(words, u == 'X');
    words["ON"] = data.hurco ? "M128" : "G43.4H#557X#24Y#25Z#26";
    words["OFF"] = data.hurco ? "M129" : "G0G49Z[#26+#5083]\nG43H#557Z#26";
    return words;
}

std::string subprograms(Words words) {
    std::string text = fill(data_program, words);
    for (const auto& [number, letter, low, high] :
         {std::tuple("824", "R", "#562", "#563"), std::tuple("825", "C", "#564", "#565")}) {
        words["N"] = number;
        words["L"] = words.at(letter);
        words["LOW"] = low;
        words["HIGH"] = high;
        text += fill(rotary_program, words);
    }
    return text + fill(switch_program, words);
}

/// Range wanted, cut to the travel limits with room for the overshoot.
std::pair<double, double> within(const AxisGeometry& axis, std::pair<double, double> wanted,
                                 double overshoot_rad) {
    if (axis.min) wanted.first = std::max(wanted.first, *axis.min + overshoot_rad);
    if (axis.max) wanted.second = std::min(wanted.second, *axis.max - overshoot_rad);
    return wanted;
}

}  // namespace

BallbarProgramData ballbar_program_data(const Machine& nominal, const BallbarLayout& layout) {
    const auto [first, second] = table_axes(nominal.chain);
    const Vector3 offset = layout.pivot_W_mm - nominal_intersection(first, second).first;
    if (std::abs(second.direction.z()) < 0.99 || std::abs(first.direction.z()) > 0.01)
        throw InputError(
            "the single-set-up ballbar test needs a tilting axis that carries a table axis along "
            "Z");
    if (std::hypot(offset.x(), offset.y()) < 5.0 || offset.z() < 5.0)
        throw InputError(fmt::format(
            "the ballbar's centre pivot must stand above the {} axis and beside the {} axis",
            letter_of(first.axis), letter_of(second.axis)));
    BallbarProgramData data;
    data.layout = layout;
    const double overshoot = rad_from_deg(data.overshoot_deg);
    data.layout.first_rad = within(first, layout.first_rad, overshoot);
    data.layout.second_rad = within(second, layout.second_rad, overshoot);
    if (const AxisGeometry* z = nominal.chain.find(Axis::Z); z && z->max)
        data.safe_z_mm = std::min(data.safe_z_mm, *z->max);
    return data;
}

std::string ballbar_program(const Machine& nominal, const BallbarProgramData& data) {
    const Words words = words_of(nominal, data);
    return "%\n" + fill(main_program, words) + subprograms(words) + "%\n";
}

std::string kinematic_test_program(const Machine& nominal, const BallbarProgramData& data) {
    const Words words = words_of(nominal, data);
    return "%\n" + fill(kinematic_program, words) + subprograms(words) + "%\n";
}

}  // namespace trunnion
