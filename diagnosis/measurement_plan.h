// Builds one ready measurement: the readings it would give, row by row, and the NC program that
// takes them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/measurements.h"

namespace trunnion::diagnosis {

constexpr double sphere_start_mm = 40.0;  ///< over a sphere's centre, where O8100 begins
/// To the step that the program prints (0.0001 mm or deg).
double plan_rounded(double v, double step);

/// Rows and program grow together, so that what is predicted is what the program does. Spheres are
/// found by O8100 (programs/sphere9.nc): nine touches. Positions are machine coordinates rounded to
/// 0.0001 mm or deg; those that the machine cannot reach are left out.
class MeasurementPlan {
  public:
    /// `start_s`: when it begins, on the clock of the readings so far.
    MeasurementPlan(const setup::Setup& setup, std::string name, std::string text, double start_s);

    /// First of all: every axis but Z goes 1 mm or deg aside and back, so that its side is known. Z
    /// comes down to whatever it measures.
    void define_sides();

    bool has_sphere() const { return !spheres_.empty() && setup_.probe.has_value(); }
    bool has_bar() const { return !pivots_.empty() && setup_.ballbar.has_value(); }
    std::size_t rotary_count() const { return rotary_.size(); }
    /// Range of a rotary axis inside its limits and +-80 degrees (first axis) or a whole turn.
    std::pair<double, double> range_deg(std::size_t k) const;

    // What the operator sets up; told to the PC by the program.
    void spindle(double degrees);
    void load(double kilograms);
    void temperature(double celsius);
    void clamps(bool closed_while_probing) { clamped_ = closed_while_probing; }
    void extension(double longer_mm);
    void wait(double seconds);

    /// Finds a sphere at rotary angles (deg) reached from `approach` deg below. False, and nothing
    /// added, when an axis would leave its range.
    bool sphere(std::size_t which, const std::vector<double>& angles_deg, double approach_deg);
    /// Finds the first sphere at home, then at these angles by way of a store: dpp (the program
    /// turns the point about G54) or rtcp (G43.4, parameters 19700-19705).
    void sphere_by_store(PositioningMode mode, const std::vector<std::vector<double>>& angles_deg,
                         double approach_deg);
    /// Touches around a sphere's equator at `azimuths` equal steps.
    void azimuth_touches(const std::vector<double>& angles_deg, int azimuths);

    /// Circle about the centre pivot, plane 0 XY (whole), 1 YZ, 2 ZX (upper halves).
    void circle(int plane, double feed_mm_min, bool clockwise);
    /// A rotary axis turns and the linear axes follow, bar along direction 0 X, 1 Y, 2 Z.
    void turn(std::size_t rotary, bool up, int bar_direction);

    Measurement done();

  private:
    struct Target {
        AxisPositions at;  ///< gauge point and rotary axes, machine coordinates
        bool reachable = true;
    };
    Target aim(const AxisPositions& rotary, const Vector3& target_W, const Vector3& tip_S) const;
    AxisPositions rotary_at(const std::vector<double>& angles_deg, double back_deg) const;
    void pass_through(const AxisPositions& at);
    void go(const AxisPositions& at, bool linear);
    void go_clear();
    /// Machine Z for changing the rotary angles, as far up as the axis allows.
    double clear_mm() const;
    void print_place();
    std::string head_text() const;
    std::string sheet() const;
    void tell(const std::string& words);
    void stop(const std::string& what);
    /// Rows of the nine touches of O8100, begun `above` over the sphere at `center`.
    void nine_touches(const setup::Artefact& sphere, const AxisPositions& center);
    void touch(const AxisPositions& stand_off, const AxisPositions& end, const Vector3& direction,
               const std::string& feature);
    void call_sphere(const setup::Artefact& sphere, const AxisPositions& center);
    void keep_home(bool dpp);
    void lead_by_g54(const AxisPositions& rotary);
    void lead_by_tcp(const AxisPositions& before, const AxisPositions& rotary);
    void begin_pass(const std::string& words, const AxisPositions& start);
    void bar_row(const AxisPositions& at, double feed_mm_min, double step_s);
    std::string words(const AxisPositions& at, bool linear) const;
    std::string all_words(const AxisPositions& at) const;
    Vector3 tip_S() const { return setup_.probe->tip_with(state_.extension_mm); }
    Vector3 cup_S() const { return setup_.ballbar->cup_with(state_.extension_mm); }

    const setup::Setup& setup_;
    Measurement result_;
    records::Reading state_;
    AxisPositions last_;
    bool clamped_ = false;
    std::vector<kinematics::AxisGeometry> rotary_;
    std::vector<setup::Artefact> spheres_, pivots_;
    double time_s_, start_s_;
    std::vector<std::string> stops_;  ///< what the operator is asked for
    std::string overwrites_ = "G59";
};

}  // namespace trunnion::diagnosis
