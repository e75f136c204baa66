#include "pivot/pivot_program.h"

#include <fmt/format.h>

#include <cmath>

#include "setup/store_prints.h"

namespace trunnion::pivot {

namespace {

using Words = std::map<std::string, std::string>;

/// The text with {NAME} replaced.
std::string filled(std::string text, const Words& words) {
    for (const auto& [name, value] : words) {
        const std::string mark = "{" + name + "}";
        for (std::size_t at = text.find(mark); at != std::string::npos;
             at = text.find(mark, at + value.size()))
            text.replace(at, mark.size(), value);
    }
    return text;
}

/// A number for an NC word: always with a decimal point.
std::string number(double value) {
    std::string text = fmt::format("{:.10g}", value + 0.0);
    if (text.find('.') == std::string::npos) text += ".";
    return text;
}

std::string point(const char* letters, const Vector3& v) {
    std::string text;
    for (int i = 0; i < 3; ++i) text += letters[i] + (v[i] == 0.0 ? "0" : number(v[i]));
    return text;
}

/// Line that rotates #545 #546 #547 (or the given point) about an axis by the angle in `angle`.
std::string turn(const offsets::PivotAxis& axis, const std::string& angle,
                 const std::string& from = "X#545Y#546Z#547") {
    return "G65P8140" + from + point("IJK", axis.direction()) + "A" + angle + "\n";
}

/// Sets #545 #546 #547 to the tool direction seen from the table; with tilting heads also #540 #541
/// #542 to the direction seen from the machine.
std::string tool_direction(const PivotPlan& plan) {
    const offsets::PivotParameters& pivot = plan.stores.pivot;
    std::string from = point("XYZ", pivot.tool_direction), text;
    const auto add = [&](const offsets::PivotAxis& axis, const char* angle) {
        text += turn(axis, angle, from);
        from = "X#545Y#546Z#547";
    };
    const bool head = pivot.unit != offsets::MechanicalUnit::table_table;
    if (pivot.unit == offsets::MechanicalUnit::tool_tool) add(pivot.second, "#531");
    if (head) {
        add(pivot.first, "#530");
        text += "#540=#545\n#541=#546\n#542=#547\n";
    } else {
        add(pivot.first, "[0-#530]");
    }
    if (pivot.unit != offsets::MechanicalUnit::tool_tool) add(pivot.second, "[0-#531]");
    return text;
}

/// The point measured at home, rotated with the table about G54.
std::string turned_point(const PivotPlan& plan) {
    const offsets::PivotParameters& pivot = plan.stores.pivot;
    std::string text = turn(pivot.second, "#531", "X#520Y#521Z#522");
    if (pivot.unit == offsets::MechanicalUnit::table_table) text += turn(pivot.first, "#530");
    return text;
}

const char* const main_text = R"(%
O{O} ({TITLE})
{NOTE}M98P8110
POPEN
DPRNT[PIVOT*{NAME}*AXES*{1}*{2}*MAPS*{FROM}*TO*{TO}]
M98P8115
#590={FROM}
WHILE[#590LE{TO}]DO1
DPRNT[TEST*ZERO*{NAME}*MAP#590[10]]
M98P8120
DPRNT[{NAME}*ZERO#590[10]*X#500[47]*Y#501[47]*Z#502[47]]
DPRNT[TEST*{NAME}*MAP#590[10]]
{BEGIN}#591=1
WHILE[#591NE#0]DO2
G65P8130A#590B#591
{LEAD}#7=#5021
#8=#5022
#9=#5023
{CANCEL}G90G49G53G0X#7Y#8Z#9
M98P8102
G65P8100D#503S#504H#510{TILT}
DPRNT[{NAME}*MAP#590[10]*{1}#530[44]*{2}#531[44]*X#100[17]*Y#101[17]*Z#102[17]]
G90G53G0Z#505
M98P8102
#591=#591+1
IF[#591GT#532]THEN#591=#0
END2
#590=#590+1
END1
G53G0Z#505
G0{1}0{2}0
DPRNT[{NAME}*END]
#149=#0
PCLOS
M30
%
)";

struct FunctionText {
    std::string title, note, begin, lead, cancel;
};

/// Texts by name of the function. O8102 prints each move for the PC; MODE prints the positioning
/// function. lead: the tip #510 above the sphere along the tool.
FunctionText text_of(const std::string& name, bool hurco) {
    if (name == "DPP")
        return {"DPP: DIRECT PIVOT POINT, KINEMATICS IN THE PROGRAM",
                "(G54 HOLDS THE PIVOT. THE PROGRAM TURNS THE POINT AS A POSTPROCESSOR WOULD.)\n",
                "",
                "G54\nDPRNT[MODE*DPP]\nG0{1}#530{2}#531\nM98P8102\n{TURNED}G0X#545Y#546\nM98P8102\n"
                "G43H#506Z[#547+#510]\nM98P8102\n",
                ""};
    if (name == "RTDFO")
        return {"RTDFO: ROTARY TABLE DYNAMIC FIXTURE OFFSET, G54 AND G54.2",
                "(G54 HOLDS THE PIVOT, FIXTURE OFFSET 1 THE SPHERE WITH BOTH ROTARIES AT 0.)\n",
                "G90G10L21P1X#520Y#521Z#522{1}0{2}0\n",
                "G54\nDPRNT[MODE*DPP]\nG0{1}#530{2}#531\nM98P8102\nDPRNT[MODE*RTDFO]\nG54.2P1\n"
                "M98P8102\nG0X0Y0\nM98P8102\nG43H#506Z#510\nM98P8102\n",
                "G54.2P0\n"};
    if (name == "TW")
        return {
            "TW: TILTED WORKING PLANE, G68.2 AND G53.1",
            "(G55 HOLDS THE SPHERE WITH BOTH ROTARIES AT 0. THE PIVOT COMES FROM 19700-19714.)\n"
            "(EULER ANGLES LAY Z OF THE PLANE ALONG THE TOOL.)\n",
            "G90G10L2P2X[#5221+#520]Y[#5222+#521]Z[#5223+#522]{1}0{2}0\n",
            "G55\nDPRNT[MODE*DPP]\nG0{1}#530{2}#531\nM98P8102\n{TOOL}#7=SQRT[#545*#545+#546*#546]"
            "\n#8=0\n"
            "IF[#7GT.0000001]THEN#8=ATAN[#545]/[0-#546]\n"
            "G68.2X0Y0Z0I#8J[ATAN[#7]/[#547]]K0\nDPRNT[MODE*TW]\nG53.1\nM98P8102\n"
            "G43H#506X0Y0Z[#510+60.]\nM98P8102\nZ#510\nM98P8102\n",
            "G69\n"};
    return {
        hurco ? "RTCP: TOOL CENTRE POINT MANAGEMENT, M128"
              : "RTCP: ROTATION TOOL CENTRE POINT, G43.4",
        "(G55 HOLDS THE SPHERE WITH BOTH ROTARIES AT 0. THE PIVOT COMES FROM THE CONTROL.)\n"
        "(THE TIP IS LED TO A POINT ABOVE THE SPHERE, ALONG THE TOOL, THEN PROBES WITHOUT IT.)\n",
        "G90G10L2P2X[#5221+#520]Y[#5222+#521]Z[#5223+#522]{1}0{2}0\n",
        std::string("G55\nDPRNT[MODE*DPP]\nG0{1}0{2}0\nM98P8102\n") +
            (hurco ? "G43H#506X0Y0Z[#510+60.]\nM98P8102\nDPRNT[MODE*RTCP]\nM128\nG43.4\n"
                   : "DPRNT[MODE*RTCP]\nG43.4H#506X0Y0Z[#510+60.]\nM98P8102\n") +
            "{TOOL}G0X[#510*#545]Y[#510*#546]Z[#510*#547]{1}#530{2}#531\nM98P8102\n",
        hurco ? "M129\n" : ""};
}

std::string main_program(const PivotPlan& plan, const PivotFunction& function) {
    const FunctionText text = text_of(function.name, setup::is_hurco(plan.language));
    const bool head = plan.stores.pivot.unit != offsets::MechanicalUnit::table_table;
    std::string program = filled(main_text, {{"BEGIN", text.begin},
                                             {"LEAD", text.lead},
                                             {"CANCEL", text.cancel},
                                             {"NOTE", text.note},
                                             {"TITLE", text.title}});
    return filled(program, {{"O", fmt::format("{}", function.program)},
                            {"NAME", function.name},
                            {"1", std::string(1, letter_of(plan.first()))},
                            {"2", std::string(1, letter_of(plan.second()))},
                            {"FROM", fmt::format("{}", plan.first_map(function))},
                            {"TO", fmt::format("{}", plan.maps.size())},
                            {"TILT", head ? "I#540J#541K#542" : ""},
                            {"TOOL", tool_direction(plan)},
                            {"TURNED", turned_point(plan)}});
}

const char* const common_text = R"(%
O8110 (PIVOT TESTS: OPERATOR'S DATA AND SAFE STATE)
(MOUNT THE TOUCH PROBE IN THE SPINDLE AND ONE SPHERE ON THE TABLE, WHERE ALL MAPS REACH IT)
(SET THE PC TO KEEP ALL THAT IS PRINTED, FROM THE FIRST LINE TO END)
(TYPE WHAT DIFFERS FROM THE NUMBERS BELOW, OR SET #500 TO #506 BEFORE THE RUN)
(#500 #501 #502 STYLUS BALL ROUGHLY AT THE SPHERE, ROTARIES AT 0, MACHINE COORDINATES OF THE TIP)
(#503 SPHERE DIAMETER, #504 STYLUS BALL DIAMETER)
(#505 MACHINE Z THAT CLEARS EVERYTHING, #506 TOOL OFFSET NUMBER OF THE PROBE)
(TOOL OFFSET MEMORY A, ONE VALUE A TOOL: CHANGE THE LINE THAT O8115 NAMES)
IF[#500EQ#0]THEN#500={X}
IF[#501EQ#0]THEN#501={Y}
IF[#502EQ#0]THEN#502={Z}
IF[#503EQ#0]THEN#503={D}
IF[#504EQ#0]THEN#504={S}
IF[#505EQ#0]THEN#505={SAFE}
IF[#506EQ#0]THEN#506={H}
(#149 O8101 AND O8102 PRINT EVERY MOVE AND TOUCH FOR THE PC, TRUNNION IMPORT DPRNT)
#149=1
#510=40.(HEIGHT ABOVE THE SPHERE'S CENTRE BEFORE PROBING)
#540=0
#541=0
#542=1.
{START}G17G40G49G80G90G94
M99

O8115 (PIVOT TESTS: PRINT THE STORES IN FORCE)
{STORES}M99

O8120 (PIVOT TESTS: ZERO THE SPHERE AT HOME)
(BACK: #500 #501 #502 SPHERE CENTRE AS THE TIP FOUND IT, #520 #521 #522 THE SAME IN G54)
(EVERY AXIS COMES FROM A KNOWN SIDE: TRAVELLING +)
M98P8102
G90G53G0Z#505
M98P8102
G54
DPRNT[MODE*DPP]
G0{1}-1.{2}-1.
M98P8102
G0{1}0{2}0
M98P8102
G0X[#500-#5201-#5221-1.]Y[#501-#5202-#5222-1.]
M98P8102
G0X[#500-#5201-#5221]Y[#501-#5202-#5222]
M98P8102
G43H#506Z[#502-#5203-#5223+#510]
M98P8102
G65P8100D#503S#504H#510
#500=#500+#100
#501=#501+#101
#502=#502+#102
#520=#500-#5201-#5221
#521=#501-#5202-#5222
#522=#502-#5203-#5223
G90G49G53G0Z#505
M98P8102
M99

O8130 (PIVOT TESTS: THE ERROR MAPS)
(CALL: G65 P8130 A.. MAP FROM 1, B.. INDEXATION FROM 1)
(BACK: #530 {1}, #531 {2}, #532 NUMBER OF INDEXATIONS)
{MAPS}#3000=105(PIVOT: NO SUCH MAP)

O8140 (PIVOT TESTS: A POINT TURNED ABOUT A LINE THROUGH ZERO)
(CALL: G65 P8140 X Y Z POINT, I J K UNIT VECTOR, A DEGREES)
(BACK: #545 #546 #547)
#10=COS[#1]
#11=SIN[#1]
#12=[1-#10]*[#4*#24+#5*#25+#6*#26]
#545=#10*#24+#11*[#5*#26-#6*#25]+#12*#4
#546=#10*#25+#11*[#6*#24-#4*#26]+#12*#5
#547=#10*#26+#11*[#4*#25-#5*#24]+#12*#6
M99
%
)";

std::string maps_text(const PivotPlan& plan) {
    std::string text;
    const char moving[] = {letter_of(plan.first()), letter_of(plan.second())};
    for (std::size_t m = 0; m < plan.maps.size(); ++m) {
        const PlannedMap& map = plan.maps[m];
        const std::string arc =
            fmt::format("{}+{}*[#2-1]", number(map.start_deg), number(map.step_deg));
        const std::string fixed = number(map.fixed_deg);
        text += fmt::format("IF[#1NE{0}]GOTO{0}\n({1} ARC AT {2}{3:g})\n", m + 1,
                            moving[map.first_moves ? 0 : 1], moving[map.first_moves ? 1 : 0],
                            map.fixed_deg);
        text += fmt::format("#530={}\n#531={}\n#532={}\nM99\nN{}\n", map.first_moves ? arc : fixed,
                            map.first_moves ? fixed : arc, map.count, m + 1);
    }
    return text;
}

std::string common_program(const PivotPlan& plan) {
    return filled(
        common_text,
        {{"X", number(plan.sphere_mm.x())},
         {"Y", number(plan.sphere_mm.y())},
         {"Z", number(plan.sphere_mm.z())},
         {"D", number(plan.sphere_diameter_mm)},
         {"S", number(plan.ball_diameter_mm)},
         {"SAFE", number(plan.safe_z_mm)},
         {"H", fmt::format("{}", plan.tool_offset)},
         {"1", std::string(1, letter_of(plan.first()))},
         {"2", std::string(1, letter_of(plan.second()))},
         {"STORES", setup::store_prints(plan.stores, setup::is_hurco(plan.language), "#506")},
         {"START", setup::start_codes(plan.language)},
         {"MAPS", maps_text(plan)}});
}

}  // namespace

std::map<std::string, std::string> pivot_programs(const PivotPlan& plan) {
    std::map<std::string, std::string> programs{{"common.nc", common_program(plan)}};
    for (const PivotFunction& function : plan.functions)
        programs[fmt::format("O{}.nc", function.program)] = main_program(plan, function);
    return programs;
}

}  // namespace trunnion::pivot
