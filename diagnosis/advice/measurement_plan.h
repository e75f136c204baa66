// Builds one ready measurement, its rows and its NC program; the kinds are measurement_*.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/advice/measurements.h"

namespace trunnion::diagnosis {

constexpr double sphere_start_mm = 40.0;  ///< above the centre of a sphere, where O8100 starts
/// Rounds to the step printed by the program (0.0001 mm or deg).
double plan_rounded(double v, double step);

/// Rows and program are built together, so that the predicted rows are those of the program.
/// Spheres are measured by O8100 (programs/sphere9.nc) with nine touches. Positions are machine
/// coordinates rounded to 0.0001 mm or deg; unreachable positions are omitted.
class MeasurementPlan {
  public:
    /// `start_s`: start time on the clock of the present readings.
    MeasurementPlan(const setup::Setup& setup, std::string name, std::string text, double start_s);

    /// Must be called first: every axis but Z moves 1 mm or deg aside and back, so that its side is
    /// known. Z is approached from above in any case.
    void define_sides();

    bool has_sphere() const { return !spheres_.empty() && setup_.probe.has_value(); }
    bool has_bar() const { return !pivots_.empty() && setup_.ballbar.has_value(); }
    std::size_t rotary_count() const { return rotary_.size(); }
    /// Range of a rotary axis within its limits, at most +-80 degrees (first axis) or a whole turn.
    std::pair<double, double> range_deg(std::size_t k) const;

    // Settings of the operator, told to the PC by the program.
    void spindle(double degrees);
    void load(double kilograms);
    void temperature(double celsius);
    void clamps(bool closed_while_probing) { clamped_ = closed_while_probing; }
    void extension(double longer_mm);
    void wait(double seconds);

    /// Measures a sphere at rotary angles (deg) approached from `approach` deg below. False, and
    /// nothing is added, when an axis would leave its range.
    bool sphere(std::size_t which, const std::vector<double>& angles_deg, double approach_deg);
    /// Measures the first sphere at home, then at these angles by means of a store: dpp (the
    /// program rotates the point about G54) or rtcp (G43.4, parameters 19700-19705).
    void sphere_by_store(PositioningMode mode, const std::vector<std::vector<double>>& angles_deg,
                         double approach_deg);
    /// Directions of touch from one height of a sphere, in equal steps.
    struct Ring {
        double lift_deg;  ///< 0 the equator, 90 the pole
        int touches;
    };
    /// Touches from rings of a sphere. The equator alone shows nothing of its height; a sphere that
    /// reaches up to where the touches start is touched there only.
    void azimuth_touches(const std::vector<double>& angles_deg, const std::vector<Ring>& rings);

    /// Circle about the centre pivot, plane 0 XY (full), 1 YZ, 2 ZX (upper halves).
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
    /// One angle for each rotary axis.
    AxisPositions rotary_at(const std::vector<double>& angles_deg, double back_deg) const;
    void pass_through(const AxisPositions& at);
    void go(const AxisPositions& at, bool linear);
    void go_clear();
    /// Machine Z for changing the rotary angles, as high as the axis allows.
    double clear_mm() const;
    void print_place();
    std::string head_text() const;
    std::string sheet() const;
    void tell(const std::string& words);
    void stop(const std::string& what);
    /// Rows of the nine touches of O8100, starting above the sphere at `center`.
    void nine_touches(const setup::Artefact& sphere, const AxisPositions& center);
    void touch(const AxisPositions& stand_off, const AxisPositions& end, const Vector3& direction,
               const std::string& feature);
    void call_sphere(const setup::Artefact& sphere, const AxisPositions& center);
    void ring_touch(const Target& target, const AxisPositions& over, const Vector3& out);
    void keep_home(bool dpp);
    void lead_by_g54(const AxisPositions& rotary);
    bool can_lead_by_tcp(const AxisPositions& before, const Vector3& center_W) const;
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
    std::vector<std::string> stops_;  ///< requests to the operator
    std::string overwrites_ = "G59";
};

}  // namespace trunnion::diagnosis
