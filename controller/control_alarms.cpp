// Number, text, cause, remedy. Texts are quoted from memory of 30i / 0i-F screens (assumed unless
// docs/sources.md marks the alarm). PS = program, OT = overtravel, MC = macro.
#include "controller/control_alarms.h"

#include <iterator>

#include "positioning/tilted_plane.h"

namespace trunnion::controller {

namespace {

constexpr AlarmRow alarm_rows[] = {
    {10, "PS", "IMPROPER G-CODE", "The control does not have this G code.",
     "Use a G code of this dialect."},
    {11, "PS", "FEED ZERO ( COMMAND )", "A cutting move with feed rate 0.", "Command F."},
    {20, "PS", "OVER TOLERANCE OF RADIUS",
     "The end point of an arc is not on the circle (parameter 3410).",
     "Correct I J K, R or the end point."},
    {21, "PS", "ILLEGAL PLANE SELECT", "Axes of the arc do not lie in the plane selected.",
     "Select the plane of these axes with G17, G18 or G19."},
    {22, "PS", "R OR I,J,K COMMAND NOT FOUND", "An arc without R and without I J K (3403#5 = 1).",
     "Give R or the centre."},
    {27, "PS", "NO AXES COMMANDED IN G43/G44", "Type C length compensation needs an axis.",
     "Command the axis with G43."},
    {30, "PS", "ILLEGAL OFFSET NUMBER", "H, D or P names an offset that does not exist.",
     "Use a number in the table."},
    {31, "PS", "ILLEGAL P COMMAND IN G10", "G10 has no P, or a P out of range.", "Correct P."},
    {32, "PS", "ILLEGAL OFFSET VALUE IN G10", "R of G10 is missing or too large.", "Correct R."},
    {36, "PS", "CAN NOT COMMANDED G31", "G31 under cutter compensation.",
     "Command G40 before G31."},
    {37, "PS", "CAN NOT CHANGE PLANE IN G41/G42", "G17-G19 changed under compensation.",
     "Command G40 before the plane."},
    {42, "PS", "G45/G48 NOT ALLOWED IN CRC", "G45 to G48 under cutter compensation.",
     "Command G40 first."},
    {44, "PS", "G27-G30 NOT ALLOWED IN FIXED CYC", "G27 to G30 in a canned cycle.",
     "Command G80 first."},
    {45, "PS", "ADDRESS Q NOT FOUND (G73/G83)", "A pecking cycle without Q.", "Give Q above 0."},
    {46, "PS", "ILLEGAL REFERENCE RETURN COMMAND", "P of G30 is not 2, 3 or 4.", "Correct P."},
    {80, "PS", "G37 ARRIVAL SIGNAL NOT ASSERTED",
     "G37: no skip signal within 6254 of the setter's position.",
     "Check the setter, its position, the offset of the tool, 6251 and 6254."},
    {81, "PS", "OFFSET NUMBER NOT FOUND IN G37", "G37 without an active H.",
     "Command H in an earlier block."},
    {82, "PS", "H-CODE NOT ALLOWED IN G37", "H in the block of G37.",
     "Command H in an earlier block."},
    {83, "PS", "ILLEGAL AXIS COMMAND IN G37",
     "G37 names no linear axis, or several, or is commanded under G91.",
     "Name one linear axis under G90."},
    {92, "PS", "ZERO RETURN CHECK (G27) ERROR", "G27 did not end at the reference position.",
     "Correct the position."},
    {142, "PS", "ILLEGAL SCALE RATE", "A scaling factor of 0.", "Correct P, I, J or K."},
    {145, "PS", "ILLEGAL USE OF G12.1/G13.1",
     "Polar interpolation started or ended in a wrong state.", "Cancel compensation first."},
    {146, "PS", "ILLEGAL USE OF G-CODE", "A G code that polar interpolation does not allow.",
     "Command G13.1 first."},
    {175, "PS", "ILLEGAL G07.1 AXIS", "G7.1 names no rotary axis or an axis that it cannot use.",
     "Name one rotary axis with the radius."},
    {176, "PS", "ILLEGAL G-CODE USE(G07.1 MODE)",
     "A G code that cylindrical interpolation does not allow.",
     "Command G7.1 with radius 0 first."},
    {190, "PS", "ILLEGAL AXIS SELECT (G96)", "P of G96 or parameter 3770 names no linear axis.",
     "Correct P or the parameter."},
    {231, "PS", "ILLEGAL FORMAT IN G10 L52",
     "Parameter entry without N or R, or with a wrong value.", "Correct the block."},
    {500, "OT", "+ OVERTRAVEL ( SOFT 1 )", "The move ends beyond the positive stored stroke limit.",
     "Correct the program, the offset or the set-up."},
    {501, "OT", "- OVERTRAVEL ( SOFT 1 )", "The move ends beyond the negative stored stroke limit.",
     "Correct the program, the offset or the set-up."},
    {1202, "PS", "NO F COMMAND AT G93", "A cutting block in inverse time feed without F.",
     "Command F in each block."},
    {5074, "PS", "ADDRESS DUPLICATION ERROR",
     "One address twice, or two G codes of one group, in a block (3403#6 = 1).", "Keep one."},
    {5420, "PS", "ILLEGAL PARAMETER IN G43.4/G43.5",
     "Parameters of tool centre point control are wrong.", "Check 19680-19714."},
    {5421, "PS", "ILLEGAL COMMAND IN G43.4/G43.5",
     "A command that tool centre point control does not allow.", "Cancel it with G49 first."},
    {5456, "PS", "TOO MANY G68.2 NESTING", "G68.2 inside G68.2.", "Command G69 first."},
    {5457, "PS", positioning::plane_format_error_text,
     "An address of G68.2, G68.3 or G68.4 is missing or wrong.", "Correct the block."},
    {5458, "PS", "ILLEGAL USE OF G53.1/G53.6",
     "G53.1 or G53.6 without a tilted plane, or out of reach.", "Command G68.2 first."},
    {5459, "PS", "MACHINE PARAMETER INCORRECT", "Parameters 19665 to 19714 are wrong.",
     "Correct the parameters."},
    {5460, "PS", "ILLEGAL USE OF CUTTER COMPENSATION FOR 5-AXIS MACHINING",
     "G41.2, G42.2 and related codes, which this control does not execute.",
     "Program the cutter's centre, or G41/G42 in a tilted plane."},
    {9001, "EX", "MOVE OF A CLAMPED AXIS",
     "The axis is clamped by an M code and the setup forbids its moves.",
     "Release the clamp before the move."},
    {9002, "EX", "G41/G42 UNDER G7.1 OR G12.1",
     "A real control compensates the developed contour; this emulator does not.",
     "Program the cutter's centre there."},
    {9003, "EX", "NOT EMULATED ON A HURCO",
     "The code moves or reverses an axis in a way that is not emulated, or it reads data that "
     "only a Fanuc has.",
     "Remove the code, or run the program on its machine."},
    {9004, "EX", "3-D ARC NOT COMPLETE",
     "The block after G2.4 or G3.4 must give its end point, and the three points must not lie "
     "on a line.",
     "Write the end point of the arc in the next block."},
    {9005, "EX", "NOT EMULATED IN THIS STATE",
     "G37, G45 to G48 or G60 in a state in which the emulator does not know the motion: an "
     "arc, a canned cycle, cutter compensation, G44.",
     "Write the positions themselves."},
    {9006, "EX", "SKIP NOT EMULATED",
     "G31 P98 ends at a torque limit, not at the skip signal, and something is in its way; G31 "
     "P90 latches positions without a stop.",
     "Use G31 or G31 P99, which end at the skip signal."},
    {9007, "EX", "TOO MANY PECKS", "A block asks for more than a million pecks.",
     "Increase Q or write fewer repeats."},
};

}  // namespace

const std::vector<AlarmRow>& control_alarms() {
    static const std::vector<AlarmRow> rows(std::begin(alarm_rows), std::end(alarm_rows));
    return rows;
}

}  // namespace trunnion::controller
