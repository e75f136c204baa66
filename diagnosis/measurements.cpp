#include "diagnosis/measurements.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "geometry/units.h"

namespace trunnion {
namespace {

constexpr double pose_s = 40.0;  ///< time of one found sphere, with the move to it

/// Builds the rows of one measurement.
class Plan {
  public:
    Plan(std::string name, std::string text, const Setup& setup, double start_s)
        : time_s_(start_s), start_s_(start_s) {
        result_.name = std::move(name);
        result_.text = std::move(text);
        result_.setup = setup;
        for (const AxisGeometry& axis : setup.machine.chain.axes()) {
            result_.table.axes.push_back(axis.axis);
            if (axis.rotary) rotary_.push_back(axis);
        }
        result_.table.path = "measurement";
        for (const Artefact& a : setup.artefacts)
            (a.kind == Artefact::Kind::sphere ? spheres_ : pivots_).push_back(a);
    }

    bool has_sphere() const { return !spheres_.empty() && result_.setup.probe.has_value(); }
    bool has_bar() const { return !pivots_.empty() && result_.setup.ballbar.has_value(); }
    Reading& state() { return state_; }
    Setup& setup() { return result_.setup; }
    void wait(double seconds) { time_s_ += seconds; }
    std::size_t rotary_count() const { return rotary_.size(); }
    Axis rotary(std::size_t k) const { return rotary_[k].axis; }

    /// A found sphere at rotary angles (deg), approached by `approach` deg.
    void sphere(std::size_t which, const std::vector<double>& angles_deg, double approach_deg) {
        const Artefact& sphere = spheres_[which % spheres_.size()];
        Reading row = state_;
        row.test = result_.name;
        row.feature = sphere.name;
        for (const double back : {approach_deg, 0.0}) {
            for (std::size_t k = 0; k < rotary_.size() && k < angles_deg.size(); ++k)
                row.commanded[rotary_[k].axis] = rad_from_deg(angles_deg[k] - back);
            aim(row, sphere.center_W_mm, result_.setup.probe->tip_S_mm);
            row.time_s = time_s_ += 0.5 * pose_s;
            row.device = back == 0.0 ? Device::sphere : Device::none;
            if (back != 0.0) result_.table.rows.push_back(row);
        }
        for (int d = 0; d < 3; ++d) {
            row.direction_M = Vector3::Unit(d);
            result_.table.rows.push_back(row);
        }
    }

    /// Touches around the sphere at azimuths (deg), rotaries where they are in `angles_deg`.
    void touches(std::size_t which, const std::vector<double>& angles_deg, int azimuths) {
        const Artefact& sphere = spheres_[which % spheres_.size()];
        Reading row = state_;
        row.test = result_.name;
        row.feature = sphere.name;
        row.device = Device::touch;
        row.feed_mm_min = 100.0;
        for (std::size_t k = 0; k < rotary_.size() && k < angles_deg.size(); ++k)
            row.commanded[rotary_[k].axis] = rad_from_deg(angles_deg[k]);
        const double reach = 0.5 * (sphere.diameter_mm + result_.setup.probe->ball_diameter_mm);
        for (int k = 0; k < azimuths; ++k) {
            const double a = 2.0 * pi * k / azimuths;
            row.direction_M = -Vector3(std::cos(a), std::sin(a), 0.0);
            aim(row, sphere.center_W_mm, result_.setup.probe->tip_S_mm + reach * row.direction_M);
            row.time_s = time_s_ += 5.0;
            result_.table.rows.push_back(row);
        }
    }

    /// A pass of the ballbar; `place` sets the row for an angle.
    void pass(const std::string& name, double feed, double from_deg, double to_deg,
              const std::function<void(Reading&, double)>& place) {
        constexpr int samples = 72;
        const double length = result_.setup.ballbar->length_mm;
        const double step_s =
            std::abs(rad_from_deg(to_deg - from_deg)) * length / samples / (feed / 60.0);
        for (int k = 0; k <= samples; ++k) {
            Reading row = state_;
            row.test = name;
            row.device = Device::ballbar;
            row.feature = pivots_.front().name;
            row.feed_mm_min = feed;
            row.time_s = time_s_ += step_s;
            place(row, rad_from_deg(from_deg + (to_deg - from_deg) * k / samples));
            result_.table.rows.push_back(row);
        }
        time_s_ += 20.0;
    }

    void circle(int plane, double feed, bool clockwise) {
        const double sweep = plane == 0 ? 360.0 : 180.0;
        pass(fmt::format("{}_{}_{:.0f}",
                         plane == 0   ? "xy"
                         : plane == 1 ? "yz"
                                      : "zx",
                         clockwise ? "cw" : "ccw", feed),
             feed, clockwise ? sweep : 0.0, clockwise ? 0.0 : sweep,
             [&](Reading& row, double angle) {
                 // Upper half in the vertical planes.
                 const Vector3 bar = plane == 0   ? Vector3(std::cos(angle), std::sin(angle), 0.0)
                                     : plane == 1 ? Vector3(0.0, std::cos(angle), std::sin(angle))
                                                  : Vector3(std::cos(angle), 0.0, std::sin(angle));
                 aim(row, pivots_.front().center_W_mm,
                     result_.setup.ballbar->cup_S_mm - result_.setup.ballbar->length_mm * bar);
             });
    }

    void turn(std::size_t k, double from_deg, double to_deg, int bar_direction) {
        const std::string name = fmt::format("turn_{}_{}_{:.0f}", letter_of(rotary_[k].axis),
                                             "xyz"[bar_direction], to_deg);
        pass(name, 1000.0, from_deg, to_deg, [&](Reading& row, double angle) {
            row.mode = PositioningMode::rtcp;
            row.commanded[rotary_[k].axis] = angle;
            const Vector3 bar = Vector3::Unit(bar_direction);
            aim(row, pivots_.front().center_W_mm,
                result_.setup.ballbar->cup_S_mm - result_.setup.ballbar->length_mm * bar);
        });
    }

    Measurement done() {
        result_.minutes = (time_s_ - start_s_) / 60.0 + 5.0;  // five minutes to get ready
        return std::move(result_);
    }

  private:
    /// Linear axes so that `tip_S` meets a point of the table.
    void aim(Reading& row, const Vector3& target_W, const Vector3& tip_S) const {
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) row.commanded[axis] = 0.0;
        const Vector3 at = result_.setup.machine.poses(row.commanded).pose_MW * target_W - tip_S;
        row.commanded[Axis::X] = at.x();
        row.commanded[Axis::Y] = at.y();
        row.commanded[Axis::Z] = at.z();
    }

    Measurement result_;
    Reading state_;
    std::vector<AxisGeometry> rotary_;
    std::vector<Artefact> spheres_, pivots_;
    double time_s_, start_s_;
};

/// Twelve poses spread over both rotary axes, off any regular grid.
void spread(Plan& plan, double approach_deg, int poses = 12) {
    for (int k = 0; k < poses; ++k)
        plan.sphere(static_cast<std::size_t>(k),
                    {-80.0 + 160.0 * std::fmod(0.618 * k, 1.0), std::fmod(137.5 * k, 360.0)},
                    k % 2 ? approach_deg : -approach_deg);
}

}  // namespace

std::vector<Measurement> ready_measurements(const Setup& setup, double start_s) {
    std::vector<Measurement> list;
    const auto make = [&](const char* name, const char* text, bool bar,
                          const std::function<void(Plan&)>& fill) {
        Plan plan(name, text, setup, start_s);
        if (bar ? !plan.has_bar() : !plan.has_sphere()) return;
        fill(plan);
        list.push_back(plan.done());
    };
    make("both_ways", "find spheres at 12 poses, each rotary axis approached from both sides",
         false, [](Plan& p) { spread(p, 6.0); });
    make("long_stylus", "find spheres at 12 poses with a stylus 60 mm longer", false, [](Plan& p) {
        p.setup().probe->tip_S_mm.z() -= 60.0;
        spread(p, 6.0);
    });
    make("reference_sphere", "return to one sphere every 10 minutes for an hour", false,
         [](Plan& p) {
             for (int k = 0; k < 7; ++k) {
                 p.sphere(0, {0.0, 0.0}, 6.0);
                 p.wait(560.0);
             }
         });
    make("two_modes", "find spheres at 8 poses in each of dpp and rtcp", false, [](Plan& p) {
        for (const PositioningMode mode : {PositioningMode::dpp, PositioningMode::rtcp}) {
            p.state().mode = mode;
            spread(p, 6.0, 8);
        }
    });
    make("spindle_turned", "find spheres at 6 poses with the spindle at 0 and at 180 degrees",
         false, [](Plan& p) {
             for (const double angle : {0.0, pi}) {
                 p.state().spindle_rad = angle;
                 spread(p, 6.0, 6);
             }
         });
    make("eight_azimuths", "touch a sphere from 8 directions at 4 table angles", false,
         [](Plan& p) {
             for (const double c : {0.0, 50.0, 130.0, 260.0}) p.touches(0, {0.0, c}, 8);
         });
    make("added_load", "find spheres at 8 poses empty and at 8 with 80 kg on the table", false,
         [](Plan& p) {
             for (const double load : {0.0, 80.0}) {
                 p.state().load_kg = load;
                 spread(p, 6.0, 8);
             }
         });
    make("clamped", "find spheres at 6 poses with the clamps open and closed", false, [](Plan& p) {
        for (const bool closed : {false, true}) {
            p.state().clamped = closed;
            spread(p, 6.0, 6);
        }
    });
    make("warm", "find spheres at 10 poses after warming the machine by 4 K", false, [](Plan& p) {
        p.state().temperature_c = 24.0;
        spread(p, 6.0, 10);
    });
    make("ballbar_planes", "ballbar circles in XY, YZ, ZX, both senses, 1000 and 4000 mm/min", true,
         [](Plan& p) {
             for (int plane = 0; plane < 3; ++plane)
                 for (const double feed : {1000.0, 4000.0})
                     for (const bool cw : {false, true}) p.circle(plane, feed, cw);
         });
    make("long_cup", "ballbar circles in XY, YZ, ZX with the tool cup 60 mm lower", true,
         [](Plan& p) {
             p.setup().ballbar->cup_S_mm.z() -= 60.0;
             for (int plane = 0; plane < 3; ++plane)
                 for (const bool cw : {false, true}) p.circle(plane, 1000.0, cw);
         });
    make("ballbar_turns",
         "ballbar with each rotary axis turning, bar along X, Y and Z, out and back", true,
         [](Plan& p) {
             for (std::size_t k = 0; k < p.rotary_count(); ++k)
                 for (int d = 0; d < 3; ++d) {
                     const double end = k == 0 ? 80.0 : 360.0, begin = k == 0 ? -80.0 : 0.0;
                     p.turn(k, begin, end, d);
                     p.turn(k, end, begin, d);
                 }
         });
    return list;
}

std::string nc_program(const Measurement& m) {
    constexpr double above_mm = 40.0;  // where O8100 starts over a sphere
    std::string zeros;
    for (const Axis axis : m.table.axes) zeros += fmt::format(" {}0.", letter_of(axis));
    std::string text = fmt::format(
        "%\nO8900 ({})\n({})\n(G59 IS SET TO MACHINE ZERO)\n"
        "G90 G17 G21 G40 G49 G80\nG10 L2 P6{}\nG59\n",
        m.name, m.text, zeros);
    const auto words = [&](const Reading& row, bool linear, double lift_mm) {
        std::string line;
        for (const Axis axis : m.table.axes) {
            if (is_rotary(axis) == linear) continue;
            double v = is_rotary(axis) ? deg_from_rad(row.commanded[axis]) : row.commanded[axis];
            if (axis == Axis::Z) v += lift_mm;
            line += fmt::format(" {}{:.4f}", letter_of(axis), std::abs(v) < 5e-5 ? 0.0 : v);
        }
        return line;
    };
    std::string test;
    const Reading* last = nullptr;
    for (const Reading& row : m.table.rows) {
        const bool bar = row.device == Device::ballbar;
        if (bar && row.test == test) {
            text += fmt::format("G1{}{} F{:.0f}\n", words(row, true, 0.0), words(row, false, 0.0),
                                row.feed_mm_min);
        } else if (!last || row.time_s != last->time_s) {
            text += fmt::format("G0{}\nG0{}\n", words(row, false, 0.0),
                                words(row, true, bar ? 0.0 : above_mm));
            if (row.device == Device::sphere || row.device == Device::touch) {
                const Artefact* sphere = m.setup.find_artefact(row.feature);
                text += fmt::format("G65 P8100 D{:.3f} S{:.3f} H{:.1f}\n", sphere->diameter_mm,
                                    m.setup.probe->ball_diameter_mm, above_mm);
            }
        }
        test = row.test;
        last = &row;
    }
    return text + "M30\n%\n";
}

}  // namespace trunnion
