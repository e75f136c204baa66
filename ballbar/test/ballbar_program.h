// Generates the NC programs of the single-set-up ballbar test for a table machine.
#pragma once

#include <string>

#include "ballbar/test/ballbar_tests.h"
#include "setup/program_language.h"

namespace trunnion::ballbar::test {

/// Input of a generated program; every value can be changed at its head.
struct BallbarProgramData {
    /// `inside` reverses the bar in the two tests in which it is horizontal (axial of the first
    /// axis, radial of the second). In the other two the cup stays above the pivot, because below
    /// it the spindle would collide with the table.
    BallbarLayout layout;
    int tool_offset = 2;          ///< H number of the tool cup
    double safe_z_mm = 450.0;     ///< machine Z above all obstacles
    double feed_mm_min = 2000.0;  ///< planar tests
    double turn_deg_min = 720.0;  ///< rotary tests
    double overshoot_deg = 5.0;   ///< before and after each measured arc
    /// A Hurco: M128 with its linearisation, and M129. BNC: G71, arcs with absolute centres.
    setup::ProgramLanguage language = setup::ProgramLanguage::fanuc;
};

/// Defaults from a machine, its bar and the position of the centre pivot: ranges within travel, A
/// or B -30 to 90 deg and C one turn where possible. Throws InputError when the pivot is not where
/// the single set-up requires it (vertically above the first rotary axis, offset along it from the
/// second).
BallbarProgramData ballbar_program_data(const kinematics::Machine& nominal,
                                        const BallbarLayout& layout);

/// Main program O8200 and its subprograms in one file: set-up circles XY, YZ, ZX, radial and axial
/// tests of both rotary axes in one run with one set-up. Macro B.
std::string ballbar_program(const kinematics::Machine& nominal, const BallbarProgramData& data);

/// O8300: kinematic tests BK1 (tilting axis), BK2 (rotating axis) and BK4 (all five axes
/// simultaneously) for two rotary table axes, with the same set-up and data.
std::string kinematic_test_program(const kinematics::Machine& nominal,
                                   const BallbarProgramData& data);

}  // namespace trunnion::ballbar::test
