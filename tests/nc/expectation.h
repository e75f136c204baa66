// What an NC test program expects, read from its own comments.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "controller/controller.h"

namespace trunnion::nc {

/// One EXPECT MOVE: kind, axis words (machine mm and deg), I J K the arc's centre (machine mm), F.
struct ExpectedMove {
    std::string kind;  ///< "G0" .. "G3", empty: any
    std::map<char, double> words;
};

/// Comments of a program, one thing each:
///   (EXPECT #100 = 3.5) (EXPECT #100 = VACANT) (EXPECT MOVE G1 X10. Y5.) all moves in order
///   (EXPECT LAST X1.) (EXPECT MOVES 3) (EXPECT ALARM 128) (EXPECT ALARM 10 LINE 4)
///   (EXPECT ALARM 10 LINE 4 COLUMN 3)
///   (EXPECT TEXT IMPROPER) of the alarm (EXPECT PRINT text) next line printed
///   (EXPECT NOTE part) (EXPECT NO NOTE) (EXPECT TIME 1.5) (EXPECT MODAL G01) (EXPECT MCODE 8)
///   (EXPECT LIMIT) (EXPECT HALFWAY X1. Z2.) axes half way along the last move
///   (SET PARAMETER 3410 = 0.05) (SET BIT 5003#0 = 1) (SET TOOL 1 = 100. 5.) length, radius
///   (SET SKIP 0.25) (SET LIMIT X -100. 100.) (SET CLAMP C 10 11) (SET DIALECT HURCO)
///   (SET SWITCH 2) (SET SIGNAL 1000 = 1) (SET #100 = 5.) (SET BLOCKS 100)
///   (SET G53 UNDER G91 MOVES)
///   (SET GROUP 12 IS THE WORK OFFSET) (SET POSITIONS WITHOUT LENGTH) (SET REFERENCE 2 Z 50.)
///   (SET STROKE X -10. 50.) parameters 1321, 1320
///   (SET TABLE 10. 0. -100. 5. 0. -50.) left-handed BC table: 19700-19702, 19703-19705
///   (SET OUTSIDE 50) the folder has this file as O50 (M198) (SET OPTIONAL STOP)
///   (SET TCP FRAME ROTARY ZERO) (SET AXES XYZAC)
///   (SET AC 10. 0. -100. 5. 0. -50.) the same as TABLE with A instead of B
///   (SET DIALECT HURCO BNC) (SET HURCO CLAMPS ALARM) turns a switch of [control.hurco] round
struct Expectation {
    std::map<int, std::optional<double>> variables;
    std::vector<ExpectedMove> moves;
    std::optional<ExpectedMove> last, halfway;
    std::optional<std::size_t> move_count;
    std::optional<int> alarm, alarm_line, alarm_column;
    std::string alarm_text;
    std::vector<std::string> printed, notes, modal;
    std::vector<int> m_codes;
    bool no_note = false, limit = false;
    std::optional<double> time_s;
    std::size_t count = 0;  ///< of EXPECT comments: a program without any tests nothing

    controller::ControlConfig config;
    offsets::Stores stores;
    std::map<int, double> preset;
    std::vector<int> outside;  ///< the file stands in the program folder under these numbers too
    double skip_at = -1.0;
};

/// Throws std::runtime_error for a comment that starts with EXPECT or SET and cannot be read.
Expectation read_expectation(const std::string& text);

}  // namespace trunnion::nc
