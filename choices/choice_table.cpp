#include "choices/choice_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "choices/store_table.h"

namespace trunnion::choices {

namespace {

using controller::HurcoChoices;
using setup::Setup;

struct Bit {
    int number, index;
    const char *off, *on;  ///< behaviour of a control with the bit 0, with the bit 1
};
constexpr Bit bits[] = {
    {1001, 0, "the machine counts in mm", "the machine counts in inches"},
    {1008, 0, "rotary axes do not roll over", "rotary axes roll over"},
    {1008, 1, "a roll-over axis takes the short way", "a roll-over axis turns by the word's sign"},
    {3401, 0, "a number without a point counts least increments",
     "a number without a point counts mm, inches or degrees"},
    {3402, 0, "G00 is in force at power-on", "G01 is in force at power-on"},
    {3402, 1, "G18 is not in force at power-on", "G18 is in force at power-on"},
    {3402, 2, "G19 is not in force at power-on", "G19 is in force at power-on"},
    {3402, 3, "G90 is in force at power-on", "G91 is in force at power-on"},
    {3403, 5, "an arc without R and centre is a line", "an arc without R and centre is an alarm"},
    {3403, 6, "of two codes of a group the last counts", "two codes of a group are an alarm"},
    {5001, 0, "tool length along Z (type A)", "tool length across the plane (type B)"},
    {5001, 1, "tool length by 5001#0", "tool length along the axis of the block (type C)"},
    {5003, 0, "cutter compensation starts by type A", "cutter compensation starts by type B"},
    {5003, 1, "cutter compensation starts by 5003#0", "cutter compensation starts by type C"},
    {5004, 2, "D holds radii", "D holds diameters"},
    {5006, 6, "G43 and G49 move the tool", "G43 and G49 shift the coordinates and move nothing"},
    {5400, 0, "the angle of G68 is absolute", "the angle of G68 adds under G91"},
    {6000, 3, "#2001 and on are wear", "#2001 and on are geometry"},
    {6001, 5, "T codes call no program", "T codes call O9000"},
    {6004, 0, "ATAN counts to 360 degrees", "ATAN counts from -180 to 180 degrees"},
    {6004, 5, "#2401 and on are work offsets", "#2401 and on are D offsets"},
    {7570, 0, "a rotary word under G54.2 moves the linear axes, too",
     "the vector of G54.2 shifts the coordinates behind the block"},
    {19607, 2, "outside corners of G41 by lines", "outside corners of G41 by arcs"},
    {19696, 5, "G43.4 counts on the table", "G43.4 counts in the work frame (WKP)"},
};

/// A parameter with a value; `absent`: what the control takes without it.
struct Value {
    int number;
    double value, absent;
    const char* what;
};
constexpr Value values[] = {
    {3410, 0.0, 0.0, "the radii at both ends of an arc are not compared"},
    {3410, 1.0, 0.0, "the radii at both ends of an arc may differ by 1 mm"},
    {5460, 1.0, 1.0, "G12.1 takes the first axis as its linear axis"},
    {5460, 2.0, 1.0, "G12.1 takes the second axis as its linear axis"},
    {5460, 3.0, 1.0, "G12.1 takes the third axis as its linear axis"},
    {5461, 4.0, 0.0, "G12.1 takes the fourth axis as its rotary axis"},
    {5461, 5.0, 0.0, "G12.1 takes the fifth axis as its rotary axis"},
    {12321, 0.0, 0.0, "G68.3 takes the axis of the tool as its vertical"},
    {12321, 1.0, 0.0, "G68.3 takes X as its vertical"},
    {12321, 2.0, 0.0, "G68.3 takes Y as its vertical"},
    {12321, 3.0, 0.0, "G68.3 takes Z as its vertical"},
    {19625, 3.0, 3.0, "cutter compensation reads 3 blocks ahead"},
    {19625, 4.0, 3.0, "cutter compensation reads 4 blocks ahead"},
    {19625, 5.0, 3.0, "cutter compensation reads 5 blocks ahead"},
    {19625, 6.0, 3.0, "cutter compensation reads 6 blocks ahead"},
    {19625, 7.0, 3.0, "cutter compensation reads 7 blocks ahead"},
    {19625, 8.0, 3.0, "cutter compensation reads 8 blocks ahead"},
};

Choice bit_choice(const Bit& bit, bool on) {
    return {std::to_string(bit.number) + '#' + std::to_string(bit.index), on ? "1" : "0",
            on ? bit.on : bit.off,
            [bit, on](const Setup& s) {
                return s.stores.parameters.find(bit.number).has_value() &&
                       s.stores.parameters.bit(bit.number, bit.index) == on;
            },
            [bit, on](Setup& s) { s.stores.parameters.set_bit(bit.number, bit.index, on); }};
}

struct Switch {
    const char* key;
    bool Setup::*on;
    const char *said_off, *said_on;
};
constexpr Switch switches[] = {
    {"work_positions_with_length", &Setup::work_positions_with_length,
     "#5041 and on leave the tool length out", "#5041 and on include the tool length"},
    {"work_offset_is_group_12", &Setup::work_offset_is_group_12,
     "#4012 reads G66 and G67, #4014 G54 to G59", "#4012 reads G54 to G59, #4014 G66 and G67"},
    {"g89_feeds_to_initial", &Setup::g89_feeds_to_initial, "G89 under G98 feeds out to R only",
     "G89 under G98 feeds out to the initial level"},
    {"g53_under_g91_moves", &Setup::g53_under_g91_moves, "G53 under G91 does not move",
     "G53 under G91 moves by its words"},
    {"rapids_are_doglegs", &Setup::rapids_are_doglegs, "rapids are straight lines",
     "rapids are doglegs, each axis at its own speed (1401#1 = 0)"},
    {"optional_stop", &Setup::optional_stop, "M01 goes on", "M01 stops"},
    {"threading", &Setup::threading, "there is no G33", "there is G33"},
};

struct HurcoSwitch {
    const char* key;
    bool HurcoChoices::*on;
    const char *said_off, *said_on;
};
constexpr HurcoSwitch hurco_switches[] = {
    {"bnc", &HurcoChoices::bnc, "ISNC", "BNC"},
    {"length_from_tool_change", &HurcoChoices::length_from_tool_change,
     "the tool length comes with G43", "the tool length comes with M6"},
    {"g49_keeps_tool_length", &HurcoChoices::g49_keeps_tool_length, "G49 ends every length",
     "G49 leaves the length of M6"},
    {"rapids_are_interpolated", &HurcoChoices::rapids_are_interpolated, "rapids are doglegs",
     "rapids are straight"},
    {"m128_keeps_tip_between_ends", &HurcoChoices::m128_keeps_tip_between_ends,
     "M128 alone keeps the tip at block ends", "M128 alone keeps the tip all along"},
    {"planes_stack", &HurcoChoices::planes_stack, "G68.2 inside G68.2 is an alarm",
     "G68.2 inside G68.2 counts from the plane before"},
    {"g68_2_moved_axes", &HurcoChoices::g68_2_moved_axes, "G68.2 turns about fixed axes",
     "G68.2 turns about moved axes"},
    {"g86_feeds_out", &HurcoChoices::g86_feeds_out, "G86 leaves the hole as a rapid",
     "G86 feeds out"},
    {"g98_feeds_from_r", &HurcoChoices::g98_feeds_from_r, "the feed starts where the cycle began",
     "the feed starts at R"},
    {"clamps_alarm", &HurcoChoices::clamps_alarm, "clamped axes move", "clamped axes alarm"},
};

struct TiltName {
    const char *name, *what;
    positioning::Branch tilt;
};
constexpr TiltName tilts[] = {
    {"nearest", "I J K take the nearest tilt", positioning::Branch::nearest},
    {"positive", "I J K take the positive tilt", positioning::Branch::positive},
    {"negative", "I J K take the negative tilt", positioning::Branch::negative}};

struct GenerationName {
    const char* name;
    interpreter::ControlGeneration generation;
};
constexpr GenerationName generations[] = {{"16i", interpreter::ControlGeneration::fanuc_16i},
                                          {"30i", interpreter::ControlGeneration::fanuc_30i},
                                          {"0i-F", interpreter::ControlGeneration::fanuc_0i_f}};

void add_controls(std::vector<Choice>& out) {
    out.push_back({"dialect", "fanuc", "a Fanuc of the 30i generation",
                   [](const Setup& s) { return !is_hurco(s); },
                   [](Setup& s) { s.dialect = interpreter::fanuc_dialect(); }});
    for (const bool bnc : {false, true})
        out.push_back({"dialect", bnc ? "hurco-bnc" : "hurco",
                       bnc ? "a Hurco that reads BNC" : "a Hurco that reads ISNC",
                       [bnc](const Setup& s) { return is_hurco(s) && s.hurco.bnc == bnc; },
                       [bnc](Setup& s) {
                           s.dialect = interpreter::hurco_dialect();
                           s.hurco.bnc = bnc;
                       }});
    for (const GenerationName& row : generations)
        out.push_back(
            {"generation", row.name, std::string("a Fanuc ") + row.name,
             [row](const Setup& s) {
                 return is_hurco(s) || s.dialect.generation == row.generation;
             },
             [row](Setup& s) { s.dialect = interpreter::fanuc_dialect(row.generation); }});
}

void add_frames(std::vector<Choice>& out) {
    using positioning::TcpFrame;
    for (const TcpFrame frame : {TcpFrame::start, TcpFrame::rotary_zero})
        out.push_back({"tcp_frame", frame == TcpFrame::start ? "start" : "rotary_zero",
                       frame == TcpFrame::start
                           ? "G43.4 counts on the table as it stands where G43.4 begins"
                           : "G43.4 counts on the table with the rotary axes at zero",
                       [frame](const Setup& s) { return s.tcp_frame == frame; },
                       [frame](Setup& s) { s.tcp_frame = frame; }});
}

void add_roundings(std::vector<Choice>& out) {
    for (const controller::VariableRoundingName& row : controller::variable_roundings)
        out.push_back({"variable_rounding", row.name, row.what,
                       [&row](const Setup& s) { return s.variable_rounding == row.rounding; },
                       [&row](Setup& s) { s.variable_rounding = row.rounding; }, true});
}

void add_switches(std::vector<Choice>& out) {
    for (const Switch& row : switches)
        for (const bool on : {false, true})
            out.push_back({row.key, on ? "true" : "false", on ? row.said_on : row.said_off,
                           [row, on](const Setup& s) { return s.*row.on == on; },
                           [row, on](Setup& s) { s.*row.on = on; }});
    for (const HurcoSwitch& row : hurco_switches)
        for (const bool on : {false, true})
            out.push_back(
                {std::string("hurco.") + row.key, on ? "true" : "false",
                 on ? row.said_on : row.said_off,
                 [row, on](const Setup& s) { return !is_hurco(s) || s.hurco.*row.on == on; },
                 [row, on](Setup& s) { s.hurco.*row.on = on; }});
    for (const TiltName& row : tilts)
        out.push_back({"hurco.tilt", row.name, row.what,
                       [row](const Setup& s) { return !is_hurco(s) || s.hurco.tilt == row.tilt; },
                       [row](Setup& s) { s.hurco.tilt = row.tilt; }});
}

void add_block_skip(std::vector<Choice>& out) {
    for (int n = 1; n <= 9; ++n)
        for (const bool on : {false, true})
            out.push_back({"block_skip." + std::to_string(n), on ? "on" : "off",
                           on ? "blocks with / of this number are skipped"
                              : "blocks with / of this number run",
                           [n, on](const Setup& s) {
                               const auto& list = s.block_skip;
                               return (std::find(list.begin(), list.end(), n) != list.end()) == on;
                           },
                           [n, on](Setup& s) {
                               std::erase(s.block_skip, n);
                               if (on) s.block_skip.push_back(n);
                           }});
}

void add_values(std::vector<Choice>& out) {
    for (const Value& row : values)
        out.push_back({std::to_string(row.number), fmt::format("{}", row.value), row.what,
                       [row](const Setup& s) {
                           return s.stores.parameters.get(row.number, row.absent) == row.value;
                       },
                       [row](Setup& s) { s.stores.parameters.set(row.number, row.value); }});
}

/// G60 without an overrun is one move and with one it is two, so no derivative leads from 0 to the
/// overrun of the log: from these values the store 5440 begins.
void add_overruns(std::vector<Choice>& out) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        for (const double mm : {1.0, -1.0, 0.2, -0.2})
            out.push_back({fmt::format("5440.{}", letter_of(axis)), fmt::format("{}", mm),
                           fmt::format("G60 has an overrun of {} mm in {}", mm, letter_of(axis)),
                           [axis, mm](const Setup& s) {
                               Setup copy = s;
                               return !s.machine.chain.find(axis) ||
                                      axis_value(copy, 5440, axis) == mm;
                           },
                           [axis, mm](Setup& s) { axis_value(s, 5440, axis) = mm; }});
}

/// The clamps of a setup: which there are is the builder's.
void add_clamps(std::vector<Choice>& out) {
    for (const bool alarm : {false, true})
        out.push_back({"clamps.alarm", alarm ? "true" : "false",
                       alarm ? "a move of a clamped axis is an alarm" : "clamped axes move",
                       [alarm](const Setup& s) {
                           return std::all_of(s.clamps.begin(), s.clamps.end(),
                                              [alarm](const controller::ClampCode& clamp) {
                                                  return clamp.alarm == alarm;
                                              });
                       },
                       [alarm](Setup& s) {
                           for (controller::ClampCode& clamp : s.clamps) clamp.alarm = alarm;
                       }});
}

std::vector<Choice> whole_table() {
    std::vector<Choice> out;
    add_frames(out);
    add_switches(out);
    add_roundings(out);
    for (const Bit& bit : bits)
        for (const bool on : {false, true}) out.push_back(bit_choice(bit, on));
    add_values(out);
    add_overruns(out);
    add_clamps(out);
    add_block_skip(out);
    add_controls(out);  // last, because of equal rows the smaller change is named first
    return out;
}

}  // namespace

const std::vector<Choice>& choice_table() {
    static const std::vector<Choice> table = whole_table();
    return table;
}

std::optional<Choice> find_choice(const std::string& text) {
    for (const Choice& choice : choice_table())
        if (choice.name() == text) return choice;
    return std::nullopt;
}

}  // namespace trunnion::choices
