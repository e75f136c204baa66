// Modal state: what remains active from block to block.
#pragma once

#include <array>
#include <optional>

#include "controller/modal_groups.h"
#include "controller/settings.h"
#include "controller/sorted_words.h"
#include "motion/block_marks.h"
#include "motion/plane_axes.h"

namespace trunnion::controller {

struct SpindleState {
    double programmed = 0.0;  ///< the last S as written (#4119)
    double rpm = 0.0;         ///< active speed, unsigned
    int direction = 0;        ///< +1 M3, -1 M4, 0 M5
    // Constant surface speed, G96.
    bool by_surface = false;
    double surface = 0.0;   ///< S under G96: m/min, or ft/min in inch
    double most_rpm = 0.0;  ///< G92 S; 0: no limit
    Axis radius_axis = Axis::X;

    double signed_rpm() const { return rpm * direction; }
};

/// Numbers last selected by words and codes.
struct NumbersInForce {
    int tool = 0;    ///< T, selected tool
    int length = 0;  ///< H
    int radius = 0;  ///< D
    int work = 0;    ///< P of G54.1, 0 for G54-G59
    int m = 0;       ///< last M code, #4113
};

struct Modal {
    ModalCodes codes;
    ControlSettings settings;
    WordUnits units;
    /// The largest value of each address, with and without decimal point.
    std::array<double, 26> largest{}, largest_bare{};
    /// Least input increments in a unit of each address, to which the values of variables are
    /// rounded; 0: they keep all digits.
    std::array<double, 26> steps_per_unit{};
    motion::BlockMarks block;
    SpindleState spindle;
    NumbersInForce number;
    double polar_angle_deg = 0.0;  ///< G16: active angle
    bool shortest_way = false;     ///< M126: rotary words take the shorter way
    /// M200: preferred sign of the tilt for a tool vector.
    std::optional<positioning::Branch> tilt;
    bool touches_twice = false;  ///< M42: G31 touches a second time at a lower feed

    bool is(ModalGroup group, int code10) const { return codes.is(group, code10); }
    bool absolute() const { return is(ModalGroup::distance, 900); }
    bool cutter_is_off() const { return is(ModalGroup::cutter, 400); }
    bool in_cycle() const { return !is(ModalGroup::cycle, 800); }
    const motion::PlaneAxes& plane() const;
    bool has_axis(Axis axis) const {
        return (settings.axis_letters & SortedWords::bit(letter_of(axis))) != 0;
    }

    /// After a change of G20, G21 or parameters.
    void units_changed();
    /// After a change of F, S, M3-M5 or the feed mode.
    void feed_changed();

  private:
    void set_limits_of_words();
};

}  // namespace trunnion::controller
