// Pitch error data as printed, typed into a control and measured again: the error is gone, whatever
// carries the axis and whatever else of its scale was found beside the table.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "diagnosis/beyond_command.h"
#include "diagnosis/diagnosis.h"
#include "report/error_table.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double length_mm = 300.0;

setup::Setup mill(const std::string& chain, const std::string& direction) {
    std::vector<std::string> notes;
    return setup::parse_setup("[machine]\nname = \"m\"\nchain = \"" + chain +
                                  "\"\n[machine.axis.Y]\ndirection = " + direction +
                                  "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
                                  "tool_mm = [0, 0, 0]\n[model]\nmodelled = []\n"
                                  "noise_um = { linear = 0.2 }\n",
                              "m.toml", notes);
}

/// How far the axis goes too far, mm, in its own sense.
double error_mm(double y_mm, double ppm) {
    const double turn = 2.0 * pi * y_mm / length_mm;
    return 1e-6 * ppm * y_mm + 6e-3 * std::sin(0.5 * turn) - 3e-3 * std::sin(turn + 1.0);
}

/// What a laser along Y reads, of a control that adds `added_mm` to the command, from its first
/// place on.
template <typename Added>
records::ReadingTable read(double ppm, Added added_mm, std::uint64_t seed) {
    SeededNoise noise(seed);
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before.fill(1);
    double zero_mm = 0.0;
    for (int pass = 0; pass < 6; ++pass)
        for (int k = 0; k <= 30; ++k) {
            records::Reading row;
            const double y_mm = 10.0 * (pass % 2 ? 30 - k : k), sent_mm = y_mm + added_mm(y_mm);
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * row.index;
            row.commanded[Axis::Y] = y_mm;
            row.test = "Y";
            row.device = records::Device::linear;
            row.feature = "R1";
            const double too_far_mm = sent_mm + error_mm(sent_mm, ppm) - y_mm;
            if (table.rows.empty()) zero_mm = too_far_mm;
            row.value_mm = too_far_mm - zero_mm + 2e-4 * noise.normal();
            table.rows.push_back(row);
        }
    return table;
}

/// The laser's + direction is that in which the tool moves from the work when Y counts up.
records::ReadingTable along(records::ReadingTable table, double direction) {
    for (records::Reading& row : table.rows) row.direction_M = Vector3(0.0, direction, 0.0);
    return table;
}

double rms_um(const records::ReadingTable& table) {
    double sum = 0.0, square = 0.0;
    for (const records::Reading& row : table.rows) {
        sum += 1e3 * *row.value_mm;
        square += 1e6 * *row.value_mm * *row.value_mm;
    }
    const auto n = static_cast<double>(table.rows.size());
    return std::sqrt(square / n - sum * sum / (n * n));
}

}  // namespace

TEST_CASE("pitch error data typed as printed take the error of the axis away",
          "[diagnosis][pitch_data]") {
    struct Build {
        const char *chain, *direction;
        double tool;  ///< of + Y, in M, of the tool against the work
    };
    for (const Build& build :
         {Build{"w b X Y Z t", "[0, 1, 0]", 1.0}, Build{"w b X Y Z t", "[0, -1, 0]", -1.0},
          Build{"w Y b X Z t", "[0, -1, 0]", 1.0}, Build{"w Y b X Z t", "[0, 1, 0]", -1.0}})
        for (const double ppm : {0.0, 80.0}) {
            const records::ReadingTable before = read(
                ppm, [](double) { return 0.0; }, 3);
            diagnosis::DiagnosisOptions options;
            options.plan_next = false;
            const diagnosis::Diagnosis d = diagnosis::diagnose(mill(build.chain, build.direction),
                                                               along(before, build.tool), options);
            INFO(build.chain << ' ' << build.direction << ' ' << ppm << " ppm\n" << said(d));
            std::optional<report::PitchErrorData> data;
            for (const diagnosis::Cause& cause : d.causes)
                if (!data) data = report::pitch_error_data(cause);
            REQUIRE(data);
            const auto typed = [&](double y_mm) {
                const double place = (y_mm - data->first) / data->interval;
                double sum = 0.0;
                for (std::size_t k = 0; k < data->value.size(); ++k)
                    sum += data->value[k] * std::clamp(place - static_cast<double>(k), 0.0, 1.0);
                return data->unit * sum;
            };
            CHECK(rms_um(before) > 3.0);
            // A twentieth of the gap is a scale that is listed, not claimed, where ppm is 0.
            CHECK(rms_um(read(ppm, typed, 4)) < (ppm > 0.0 ? 0.5 : 1.2));
        }
}

namespace {

/// B goes too far by two harmonics of its turn, rad, and with `more` by higher ones.
double turn_error_rad(double b_rad, double more) {
    return 150e-6 * std::cos(b_rad) + 300e-6 * std::sin(3.0 * b_rad + 0.4) +
           more * (60e-6 * std::sin(4.0 * b_rad) + 120e-6 * std::cos(13.0 * b_rad + 1.0));
}

/// What an autocollimator reads of B, of a control that adds `added_rad` to the command. `tool`:
/// sense of + B, about Y, of the tool against the work.
template <typename Added>
records::ReadingTable turned(double tool, double more, Added added_rad, std::uint64_t seed) {
    SeededNoise noise(seed);
    records::ReadingTable table;
    table.path = "angles.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z, Axis::B};
    table.side_before.fill(1);
    for (int pass = 0; pass < 5; ++pass)
        for (int k = 0; k <= 47; ++k) {
            records::Reading row;
            const double b_rad = rad_from_deg(7.5 * k), sent_rad = b_rad + added_rad(b_rad);
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * row.index;
            row.commanded[Axis::B] = b_rad;
            row.test = "B";
            row.device = records::Device::angle;
            row.angular = true;
            row.feature = "R1";
            row.direction_M = Vector3(0.0, 1.0, 0.0);
            row.value_mm =
                tool * (sent_rad + turn_error_rad(sent_rad, more) - b_rad) + 2e-6 * noise.normal();
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

TEST_CASE("pitch error data of a rotary axis take its error away, and add up to zero in a turn",
          "[diagnosis][pitch_data]") {
    struct Build {
        const char *chain, *direction;
        double tool;
    };
    const double more = GENERATE(0.0, 1.0);
    for (const Build& build :
         {Build{"w B b X Y Z t", "[0, 1, 0]", -1.0}, Build{"w B b X Y Z t", "[0, -1, 0]", 1.0},
          Build{"w b X Y Z B t", "[0, 1, 0]", 1.0}, Build{"w b X Y Z B t", "[0, -1, 0]", -1.0}}) {
        std::vector<std::string> notes;
        const setup::Setup setup = setup::parse_setup(
            std::string("[machine]\nname = \"m\"\nchain = \"") + build.chain +
                "\"\n[machine.axis.B]\npoint_mm = [0, 0, 0]\ndirection = " + build.direction +
                "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
                "[model]\nmodelled = []\n",
            "m.toml", notes);
        const records::ReadingTable before = turned(
            build.tool, more, [](double) { return 0.0; }, 3);
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, before, options);
        INFO(build.chain << ' ' << build.direction << '\n' << said(d));
        std::optional<report::PitchErrorData> data;
        for (const diagnosis::Cause& cause : d.causes)
            if (!data) data = report::pitch_error_data(cause);
        REQUIRE(data);
        CHECK(data->rotary);
        // The curve shows order 13: three points a period.
        for (const diagnosis::Cause& cause : d.causes)
            CHECK((more == 0.0 || cause.points.empty() || cause.points.size() >= 39));
        CHECK(std::accumulate(data->value.begin(), data->value.end(), 0) == 0);
        const auto typed = [&](double b_rad) {
            const double place = (deg_from_rad(b_rad) - data->first) / data->interval;
            double sum = 0.0;
            for (std::size_t k = 0; k < data->value.size(); ++k)
                sum += data->value[k] * std::clamp(place - static_cast<double>(k), 0.0, 1.0);
            return rad_from_deg(data->unit * sum);
        };
        // Half a unit of 0.001 deg (17 urad), and the chords of the highest harmonic.
        CHECK(1e3 * rms_um(before) > 200.0);
        CHECK(1e3 * rms_um(turned(build.tool, more, typed, 4)) < 12.0);
    }
}

TEST_CASE("data of a part of a turn end with it, a whole turn beside them too", "[diagnosis]") {
    const auto cause_over = [](double from_rad, double to_rad, int steps) {
        diagnosis::Cause cause;
        cause.effect = "C.positioning";
        cause.probability = 0.9;
        cause.beyond.axis = "C";
        cause.beyond.rotary = true;
        for (int k = 0; k <= steps; ++k) {
            const double q = from_rad + (to_rad - from_rad) * k / steps;
            cause.beyond.at.push_back(q);
            cause.beyond.too_far.push_back(1e-4 * std::sin(q));
        }
        return cause;
    };
    const double from = -0.5 * pi, to = rad_from_deg(100.0);
    std::vector<diagnosis::Cause> causes{cause_over(from, to, 38), cause_over(0.0, 2.0 * pi, 72)};
    if (GENERATE(false, true)) std::swap(causes[0], causes[1]);
    diagnosis::join_of_axis({}, causes);
    const diagnosis::BeyondCommand& beyond = causes[0].beyond;
    CHECK(causes[0].includes == "C.positioning");
    CHECK(causes[1].beyond.at.empty());
    CHECK(beyond.at.front() == Approx(from));
    CHECK(beyond.at.back() == Approx(to));
    for (const double q : {-1.4, -0.3, 0.7, 1.6})
        CHECK(beyond(q) == Approx(2e-4 * std::sin(q)).margin(1e-6));
}

}  // namespace trunnion
