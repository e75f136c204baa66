// Passes of the ballbar: rows and program of a measurement.
#include <fmt/format.h>

#include <cmath>

#include "base/units.h"
#include "diagnosis/advice/measurement_plan.h"
#include "setup/program_language.h"

namespace trunnion::diagnosis {
namespace {

constexpr double sample_deg = 5.0;  ///< between samples of a pass

}  // namespace

void MeasurementPlan::begin_pass(const std::string& words_of_name, const AxisPositions& start) {
    AxisPositions high = start;
    go_clear();
    go(start, false);
    high[Axis::Z] = last_[Axis::Z];
    go(high, true);
    go(start, true);
    stop("MOUNT THE BALLBAR");
    tell("SAMPLE " + fmt::format("{:.0f}", sample_deg));
    tell("BALLBAR ON " + words_of_name);
    time_s_ += 60.0;
}

void MeasurementPlan::bar_row(const AxisPositions& at, double feed_mm_min, double step_s) {
    records::Reading row = state_;
    row.commanded = at;
    row.device = records::Device::ballbar;
    row.feature = pivots_.front().name;
    row.feed_mm_min = feed_mm_min;
    row.time_s = time_s_ += step_s;
    result_.table.rows.push_back(row);
    last_ = at;
}

void MeasurementPlan::circle(int plane, double feed_mm_min, bool clockwise) {
    const double length = setup_.ballbar->length_mm;
    const double sweep = plane == 0 ? 360.0 : 180.0;
    const auto bar = [&](double degrees) -> Vector3 {
        const double c = std::cos(rad_from_deg(degrees)), s = std::sin(rad_from_deg(degrees));
        return plane == 0 ? Vector3(c, s, 0.0) : plane == 1 ? Vector3(0.0, c, s) : Vector3(c, 0, s);
    };
    const auto place = [&](double degrees) {
        return aim({}, pivots_.front().center_W_mm, cup_S() - length * bar(degrees));
    };
    for (double a = 0.0; a <= sweep; a += 30.0)
        if (!place(a).reachable) return;
    const std::string pass_words = fmt::format("{} {} {:.0f}",
                                               plane == 0   ? "XY"
                                               : plane == 1 ? "YZ"
                                                            : "ZX",
                                               clockwise ? "CW" : "CCW", feed_mm_min);
    const double from = clockwise ? sweep : 0.0, to = sweep - from;
    const AxisPositions start = place(from).at, end = place(to).at;
    begin_pass(pass_words, start);
    // X towards Z is clockwise in G18, whose second axis is X; BNC exchanges G2 and G3 there, and
    // I J K are the place of the centre.
    const bool bnc = setup::language_of(setup_) == setup::ProgramLanguage::bnc;
    const bool g2 = plane == 2 && !bnc ? !clockwise : clockwise;
    Vector3 center = -length * bar(from);
    if (bnc) center += Vector3(start[Axis::X], start[Axis::Y], start[Axis::Z]);
    result_.program +=
        fmt::format("{} G{}{} I{:.4f} J{:.4f} K{:.4f} F{:.0f}\nG17\n",
                    plane == 0   ? "G17"
                    : plane == 1 ? "G19"
                                 : "G18",
                    g2 ? 2 : 3, words(end, true), plan_rounded(center.x(), 1e-4),
                    plan_rounded(center.y(), 1e-4), plan_rounded(center.z(), 1e-4), feed_mm_min);
    tell("BALLBAR OFF");
    const std::string before =
        std::exchange(state_.test, fmt::format("{}_{}_{:.0f}",
                                               plane == 0   ? "xy"
                                               : plane == 1 ? "yz"
                                                            : "zx",
                                               clockwise ? "cw" : "ccw", feed_mm_min));
    const double step_s = rad_from_deg(sample_deg) * length / (feed_mm_min / 60.0);
    for (double a = 0.0; a <= sweep + 1e-9; a += sample_deg)
        bar_row(place(clockwise ? sweep - a : a).at, feed_mm_min, step_s);
    state_.test = before;
}

void MeasurementPlan::turn(std::size_t rotary, bool up, int bar_direction) {
    constexpr double feed_mm_min = 1000.0;
    const auto [low, high] = range_deg(rotary);
    const double from = sample_deg * std::ceil(low / sample_deg);
    const double to = sample_deg * std::floor(high / sample_deg);
    const Vector3 bar = Vector3::Unit(bar_direction);
    const Axis axis = rotary_[rotary].axis;
    const auto place = [&](double degrees) {
        AxisPositions angles;
        angles[axis] = rad_from_deg(degrees);
        return aim(angles, pivots_.front().center_W_mm, cup_S() - setup_.ballbar->length_mm * bar);
    };
    for (double a = from; a <= to; a += 10.0)
        if (!place(a).reachable) return;
    const double begin = up ? from : to, end = up ? to : from, sense = up ? 1.0 : -1.0;
    const std::string letter(1, letter_of(axis));
    const std::string bar_letter(1, "XYZ"[bar_direction]);
    begin_pass("TURN " + letter + ' ' + bar_letter + (up ? " UP" : " DOWN"), place(begin).at);
    const std::string before =
        std::exchange(state_.test, "turn_" + letter + '_' + bar_letter + (up ? "_up" : "_down"));
    bar_row(place(begin).at, feed_mm_min, 1.0);
    result_.program += "G93\n";
    for (double a = begin; std::abs(a - end) > 1e-6; a += sense * sample_deg) {
        const AxisPositions half = place(a + 0.5 * sense * sample_deg).at;
        const AxisPositions next = place(a + sense * sample_deg).at;
        double way = 0.0;
        for (const Axis linear : {Axis::X, Axis::Y, Axis::Z})
            way += std::pow(next[linear] - last_[linear], 2);
        const double step_s = std::max(0.3, std::sqrt(way) / (feed_mm_min / 60.0));
        result_.program += fmt::format("G1{} F{:.4f}\nG1{} F{:.4f}\n", all_words(half),
                                       120.0 / step_s, all_words(next), 120.0 / step_s);
        bar_row(next, feed_mm_min, step_s);
    }
    result_.program += "G94\n";
    tell("BALLBAR OFF");
    state_.test = before;
}

}  // namespace trunnion::diagnosis
