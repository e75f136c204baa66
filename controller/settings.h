// Parameters that the control needs at each block, decoded once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "controller/control_config.h"
#include "cutter/beside_path.h"
#include "offsets/stores.h"

namespace trunnion::controller {

/// Automatic tool length measurement, G37.
struct ToolMeasuring {
    double feed_mm_min = 0.0;   ///< 6241
    double slow_mm = 0.0;       ///< 6251: distance before the setter at which that feed starts
    double tolerance_mm = 0.0;  ///< 6254: the signal must come within it
};

/// Decoded CNC parameters. The parameter number follows each field; the initial value is used when
/// the store has no entry.
struct ControlSettings {
    std::vector<ControlAxis> axes;          ///< number 1 is [0]
    std::uint32_t axis_letters = 0;         ///< letters of the axes, bits as in SortedWords
    double largest_position = 999999999.0;  ///< limit of a position word, in least increments
    bool has_rotary_axis = false;
    bool threading = false;  ///< G33
    BuilderProfile builder;
    interpreter::DialectFamily family = interpreter::DialectFamily::fanuc;
    HurcoChoices hurco;  ///< no meaning on a Fanuc
    bool is_hurco() const { return family == interpreter::DialectFamily::hurco; }
    bool is_bnc() const { return is_hurco() && hurco.bnc; }
    bool g89_feeds_to_initial = true;  ///< own option, see ControlConfig
    positioning::TcpFrame tcp_frame =
        positioning::TcpFrame::start;  ///< G43.4 with the table turned
    bool bare_is_unit =
        true;  ///< 3401#0 DPI: X58 is 58 mm; 0: 58 least increments. Absent: 1 (assumed)
    bool bare_is_noted = false;      ///< 3401 absent: the first such word gives a note
    bool duplicates_alarm = false;   ///< 3403#6 AD2
    bool arc_needs_centre = false;   ///< 3403#5 CIR
    double arc_tolerance_mm = 0.0;   ///< 3410; 0: start and end radius are not compared
    double peck_return_mm = 1.0;     ///< 5114: G73 retreat (absent: 1 mm, assumed)
    double peck_clearance_mm = 1.0;  ///< 5115: G83 clearance (absent: 1 mm, assumed)
    bool length_shifts = false;      ///< 5006#6 TOS: G43 shifts the coordinates instead of moving
    int length_axis_type =
        0;  ///< 5001#0 TLC, #1 TLB: 0 A (always Z), 1 B (normal of plane), 2 C (axis of the block)
    bool radius_is_diameter = false;         ///< 5004#2 ODI: D holds diameters
    cutter::CutterSettings cutter;           ///< 5003, 19607, 19625
    bool work_positions_with_length = true;  ///< #5041, #5061 include length (own option, see docs)
    bool work_offset_is_group_12 = false;    ///< exchanges #4012 and #4014 (own option)
    bool wear_first = false;                 ///< 6000#3 V15: #2001 geometry instead of wear
    bool d_offsets_from_2401 = false;        ///< 6004#5 D10: #2401.. D offsets, no work offsets
    bool has_six_digit_variables = true;     ///< #100001.. of a 30i and 0i-F
    bool g53_under_g91_moves = false;        ///< own option, see ControlConfig
    bool rapids_are_doglegs = false;         ///< the same, or that of a Hurco
    /// Own option, see ControlConfig.
    VariableRounding variable_rounding = VariableRounding::none;
    std::uint16_t rollover = 0;         ///< 1008#0 ROA by axis letter bit
    std::uint16_t rollover_signed = 0;  ///< 1008#1 RAB: such an axis turns by the word's sign
    double least_surface_rpm = 0.0;     ///< 3771: minimum speed under G96
    double most_rpm = 99999.0;          ///< 3772; absent or 0: five digits (assumed)
    int surface_axis_number = 1;        ///< 3770: radius axis of G96 without P; 0 or absent: 1
    ToolMeasuring measuring;
    std::array<double, axis_count> overrun{};      ///< 5440, mm and deg: G60
    std::array<double, axis_count> corner_jump{};  ///< 1783, mm/min and deg/min; 0: 400 (assumed)
    std::array<std::array<double, axis_count>, 4> reference{};  ///< 1240-1243, mm and deg
};

/// Axis number of each letter: parameter 1020 where it is set, else X Y Z A B C U V W with
/// auxiliary axes last.
void sort_axes(std::vector<ControlAxis>& axes, const offsets::Parameters& parameters);
/// Reads stroke limits 1320, 1321 (mm, deg; no limit when the positive one is below the negative
/// one) and rapid speeds 1420 (mm/min, deg/min) that are in the store. `axes` in the order of their
/// numbers.
void take_strokes(std::vector<ControlAxis>& axes, const offsets::Parameters& parameters);
/// `config.axes` in the order of their numbers.
ControlSettings decode_settings(const offsets::Parameters& parameters, const ControlConfig& config);

}  // namespace trunnion::controller
