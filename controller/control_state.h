// Everything a running control knows. Plain data; the subjects (arcs, cycles, ...) work on it.
#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "controller/alarms.h"
#include "controller/controller.h"
#include "controller/coordinates.h"
#include "controller/feed_state.h"
#include "controller/five_axis_state.h"
#include "controller/modal.h"
#include "controller/path_queue.h"
#include "controller/settings.h"
#include "controller/sorted_words.h"
#include "motion/axis_limits.h"
#include "motion/pace.h"

namespace trunnion {

struct SpindleState {
    double programmed = 0.0;  ///< the last S as written (#4119)
    double rpm = 0.0;         ///< in force, without sign
    int direction = 0;        ///< +1 M3, -1 M4, 0 M5
    // Constant surface speed, G96.
    bool by_surface = false;
    double surface = 0.0;   ///< S under G96: m/min, or ft/min in inch
    double most_rpm = 0.0;  ///< G92 S; 0: none
    Axis radius_axis = Axis::X;
};

/// What the skip signal left behind.
struct SkipState {
    ControlPosition work;  ///< #5061..: work frame, mm and deg
    bool triggered = false;
};

/// Canned cycle data that stay until G80.
struct CycleState {
    double initial_level =
        0.0;               ///< program coordinate along the drilling axis when the cycle began
    double depth = 0.0;    ///< Z as programmed (absolute, or from R under G91)
    double level_r = 0.0;  ///< R as programmed (absolute, or from the initial level under G91)
    double peck = 0.0;     ///< Q
    double dwell_s = 0.0;  ///< P
    bool r_from_initial = false;  ///< R was given under G91
    bool depth_from_r = false;    ///< Z was given under G91
    bool rigid_tap = false;       ///< M29
};

/// What the blocks after G10 L3, L50, L52 hold until G11.
enum class DataEntry : std::uint8_t { none, parameters, tool_life };

/// G12.1 in force: radius axis and angle axis, and where the figure stands in their plane.
struct PolarMotion {
    Axis linear = Axis::X, rotary = Axis::C;
    double x_mm = 0.0, y_mm = 0.0;
};
/// G7.1 in force.
struct CylinderMotion {
    Axis rotary = Axis::C;
    double radius_mm = 0.0;
};

struct ControlState {
    ControlState(ControlConfig config_, Stores& stores_, MotionSink& sink_);

    ControlConfig config;
    Stores& stores;
    MotionSink& sink;
    std::function<int()> program_number, sequence_number;  ///< #4115, #4114; empty: 0

    ControlSettings settings;
    AxisLimits limits;
    std::uint32_t axis_letters = 0;  ///< letters of the machine's axes, as in SortedWords

    ModalState modal;
    Coordinates coordinates;
    ControlPosition program;  ///< where the control stands: program coordinates of the tip
    ControlPosition machine;  ///< the same point as machine coordinates of the gauge point
    SortedWords words;        ///< of the block that runs

    double unit_mm = 1.0;      ///< mm in one programmed unit: 1 or 25.4
    double bare_linear = 1.0;  ///< mm for one unit of a word without a point
    double bare_rotary = 1.0;  ///< deg for the same
    /// The largest value of each address, written with a point and without.
    std::array<double, 26> largest{}, largest_bare{};
    FeedState feed;
    SpindleState spindle;
    SkipState skip;
    CycleState cycle;
    FiveAxisState five_axis;
    std::optional<PolarMotion> polar;
    std::optional<CylinderMotion> cylinder;
    DataEntry data_entry = DataEntry::none;
    bool moved = false;            ///< the block that ran moved an axis: G66 calls follow it
    bool units_switched = false;   ///< G20, G21: the language's increment changes
    bool ended = false;            ///< M2, M30
    bool length_moves = false;     ///< G43, G49 without axis words: the axis moves by the offset
    bool exact_stop_once = false;  ///< G9
    bool length_parked = false;    ///< G28, G30, G53 left the length out until the axis moves again
    int tool_selected = 0;         ///< T
    int length_number = 0;         ///< H in force
    int radius_number = 0;         ///< D in force
    int work_number = 0;           ///< P of G54.1 in force, 0 for G54-G59
    int fixture_number = 0;        ///< P of G54.2 in force
    int last_m = 0;                ///< #4113
    double polar_angle_deg = 0.0;  ///< G16: angle in force
    ControlPosition intermediate;  ///< of G28, for G29: program coordinates
    std::array<bool, axis_count> clamped{};

    PathQueue path;
    Pace pace;
    AxisMove move;  ///< the one that goes out; fields that rarely change stay
    RunResult result;
    std::set<std::string, std::less<>> noted;
    double clock_offset_ms = 0.0;      ///< #3001 = value
    std::array<double, 8> controls{};  ///< #3003, #3004, ...: [n] = #3000+n

    /// One line in the result's notes, the first time it is said.
    void note(std::string text);
    /// Carries an M code out: the block behind it waits for its completion.
    void send_m_code(int code) {
        pace.stop();
        sink.m_code(code);
    }
    /// After a coordinate stage changed: compiles and derives the program position anew.
    void frame_changed();
    /// After parameters changed.
    void parameters_changed();
    /// After G20/G21, F, S or the feed mode changed.
    void units_changed();
    void set_largest_words();
    void feed_changed();
    /// Takes the active work offset and the external one from the stores.
    void read_work_offset();
    /// After G54.2 sets changed.
    void fixture_changed();
    void stand_at(const ControlPosition& machine_position);
    /// The program position of a place of the axes, by all that is in force (TCP too).
    ControlPosition program_at(const ControlPosition& machine_position) const;
    double spindle_rpm() const;

    bool inch() const { return unit_mm != 1.0; }
    bool absolute() const { return modal.is(ModalGroup::distance, 900); }
    bool has_axis(Axis axis) const {
        return (axis_letters & SortedWords::bit(letter_of(axis))) != 0;
    }
    /// Cutter radius in force, signed: + to the left of the path (G41), - to the right (G42).
    double cutter_offset_mm() const;
    /// Value of a dimension word (X I R Q ..) in mm.
    double length_word(char letter) const {
        return words.get(letter) * (words.is_bare(letter) ? bare_linear : unit_mm);
    }
    /// Value of an axis word in mm or deg.
    double axis_word(Axis axis) const;
    /// A word that must be a whole number: H D P L T ...; PS0007 otherwise.
    int whole_word(char letter) const;
    /// The program position that the axis words of this block command (G90, G91, polar words).
    ControlPosition target();
};

/// The two axes of the plane in force and the one normal to it, in right-handed order.
struct PlaneAxes {
    Axis first, second, normal;
    char centre_first, centre_second;  ///< I J, K I, J K
};
const PlaneAxes& plane_axes(const ModalState& modal);

}  // namespace trunnion
