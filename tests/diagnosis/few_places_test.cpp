// Laser tests at few places: what they show between the places, which ripples an accident imitates,
// and errors that only repeats tell from noise.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

using laser_lines::stage;

using Error = std::function<double(double at_mm)>;  ///< mm

struct Laser {
    std::vector<double> at_mm;
    int runs = 3;
    double noise_mm = 0.0;
};

records::ReadingTable readings(const Laser& laser, const Error& error_mm, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before.fill(-1);
    std::vector<double> way = laser.at_mm;
    way.insert(way.end(), laser.at_mm.rbegin(), laser.at_mm.rend());
    for (int run = 0; run < laser.runs; ++run)
        for (std::size_t k = 0; k < way.size(); ++k) {
            records::Reading row;
            row.time_s = 60.0 * static_cast<double>(table.rows.size());
            const double outside_mm = k == 0 ? -1.0 : k == laser.at_mm.size() ? 1.0 : 0.0;
            if (outside_mm != 0.0) {  // so that the side is known
                row.commanded[Axis::X] = way[k] + outside_mm;
                row.index = static_cast<int>(table.rows.size());
                table.rows.push_back(row);
            }
            row.index = static_cast<int>(table.rows.size());
            row.commanded[Axis::X] = way[k];
            row.test = "X";
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = Vector3(1, 0, 0);
            row.value_mm = error_mm(way[k]) + laser.noise_mm * noise(engine);
            table.rows.push_back(row);
        }
    return table;
}

std::vector<double> even_places(std::size_t count, double length_mm) {
    std::vector<double> at_mm;
    for (std::size_t k = 0; k < count; ++k)
        at_mm.push_back(length_mm * static_cast<double>(k) / static_cast<double>(count - 1));
    return at_mm;
}

std::vector<double> uneven_places(std::size_t count, double length_mm, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> part(-0.3, 0.3);
    std::vector<double> at_mm = even_places(count, length_mm);
    const double step_mm = length_mm / static_cast<double>(count - 1);
    for (std::size_t k = 1; k + 1 < count; ++k) at_mm[k] += step_mm * part(engine);
    return at_mm;
}

/// Six waves of random phases, none shorter than half the travel.
Error smooth(double rms_mm, double length_mm, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<Vector3> waves;
    for (int k = 0; k < 6; ++k)
        waves.emplace_back(normal(engine),
                           std::clamp(5.0 * normal(engine), -12.0, 12.0) / length_mm,
                           6.28 * normal(engine));
    return [=](double at_mm) {
        double sum = 0.0;
        for (const Vector3& w : waves) sum += w.x() * std::cos(w.y() * at_mm + w.z());
        return rms_mm / std::sqrt(3.0) * sum;
    };
}

Error rough(double rms_mm, const std::vector<double>& at_mm, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, rms_mm);
    std::map<double, double> values;
    for (const double at : at_mm) values[at] = normal(engine);
    return [=](double at) { return values.at(at); };
}

diagnosis::Diagnosis diagnosed(const records::ReadingTable& table) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return diagnosis::diagnose(stage(), table, options);
}

/// Shrink by the written setup at many places without noise, zero apart.
double achieved(const diagnosis::Diagnosis& d, const Error& error_mm, double length_mm) {
    const records::ReadingTable fresh =
        readings({uneven_places(40, length_mm, 77), 1, 0.0}, error_mm, 1);
    const emulator::Replay replay(d.setup, fresh);
    const auto read = replay.predict(effects::active_models(d.setup));
    double sum[2] = {}, square[2] = {};
    for (std::size_t i = 0; i < read.size(); ++i)
        for (const int with : {0, 1}) {
            const double left = *fresh.rows[replay.table_row(i)].value_mm - with * read[i];
            sum[with] += left;
            square[with] += left * left;
        }
    const auto n = static_cast<double>(read.size());
    const auto spread = [&](int k) { return std::sqrt(square[k] / n - std::pow(sum[k] / n, 2)); };
    return 1.0 - spread(1) / spread(0);
}

}  // namespace

TEST_CASE("the interval of a table of few places holds between them", "[diagnosis][few_places]") {
    int below = 0, between = 0;
    for (unsigned seed = 1; seed <= 24; ++seed) {
        const Error error_mm = smooth(0.012, 300.0, seed);
        const std::size_t count = 5 + seed % 4;
        const diagnosis::Diagnosis d =
            diagnosed(readings({even_places(count, 300.0), 4, 8e-4}, error_mm, seed));
        if (!d.between_places || d.verdict == diagnosis::Verdict::no_gap) continue;
        ++between;
        const double fresh = achieved(d, error_mm, 300.0);
        if (fresh >= d.after.low - 0.02) continue;
        ++below;
        UNSCOPED_INFO(seed << ": " << count << " places, shrinks by " << fresh << ", said "
                           << d.after.shrink << " (" << d.after.low << " to " << d.after.high
                           << ")");
    }
    CHECK(between >= 8);
    CHECK(below <= 2);
}

TEST_CASE("independent errors of few uneven places are no ripple between them",
          "[diagnosis][few_places]") {
    int accidents = 0;
    for (unsigned seed = 1; seed <= 16; ++seed) {
        const auto at_mm = uneven_places(8 + seed % 4, 500.0, seed);
        const diagnosis::Diagnosis d =
            diagnosed(readings({at_mm, 3, 3e-4}, rough(8e-4, at_mm, seed), seed));
        for (const diagnosis::Cause& cause : d.causes)
            if (cause.effect == "X.cyclic" && cause.probability >= 0.5) {
                INFO(seed << '\n' << said(d));
                CHECK(cause.probability < 0.9);
                accidents += cause.holds_between;
            }
    }
    CHECK(accidents <= 1);  // of 16, at a chance of 5 %
}

TEST_CASE("a ripple at many uneven places is one between them, too", "[diagnosis][few_places]") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Error error_mm = [](double at_mm) {
            return 4e-3 * std::sin(2.0 * pi * at_mm / 12.0);
        };
        const diagnosis::Diagnosis d =
            diagnosed(readings({uneven_places(21, 300.0, seed), 3, 3e-4}, error_mm, seed));
        INFO(seed << '\n' << said(d));
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "X.cyclic");
        CHECK(d.causes.front().holds_between);
        CHECK(achieved(d, error_mm, 300.0) > 0.9);
    }
}

TEST_CASE("five places of one run up and down beside a longer test are explained there",
          "[diagnosis][few_places]") {
    const auto at_mm = even_places(5, 900.0);
    for (unsigned seed = 1; seed <= 8; ++seed) {
        records::ReadingTable table = readings(
            {even_places(5, 600.0), 3, 3e-4}, [](double) { return 0.0; }, seed);
        const records::ReadingTable across =
            readings({at_mm, 1, 3e-4}, rough(0.015, at_mm, seed), seed + 100);
        for (records::Reading row : across.rows) {
            row.index = static_cast<int>(table.rows.size());
            row.time_s += 7200.0;
            std::swap(row.commanded[Axis::X], row.commanded[Axis::Y]);
            row.test = "Y in X";
            table.rows.push_back(row);
        }
        const diagnosis::Diagnosis d = diagnosed(table);
        INFO(seed << '\n' << said(d));
        CHECK(d.explained > 0.9);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "Y.straightness");
    }
}

TEST_CASE("a bow of angles at three places is told there", "[diagnosis][few_places]") {
    const Error bow = [](double at_mm) { return 0.02 * (std::abs(at_mm - 300.0) < 1.0); };
    for (unsigned seed = 1; seed <= 4; ++seed) {
        records::ReadingTable table = readings({even_places(3, 600.0), 4, 1e-3}, bow, seed);
        for (records::Reading& row : table.rows) {
            if (!row.value_mm) continue;
            row.device = records::Device::angle;
            row.angular = true;
            row.direction_M = Vector3::UnitY();
            *row.value_mm *= 1e-3;  // from mm to rad
        }
        const diagnosis::Diagnosis d = diagnosed(table);
        INFO(seed << '\n' << said(d));
        CHECK(d.explained > 0.9);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "X.angular");
        CHECK_FALSE(d.between_places);
    }
}

TEST_CASE("repeats that agree with each other and not with the simulation are a gap",
          "[diagnosis][few_places]") {
    const auto at_mm = even_places(6, 150.0);
    int found = 0, false_gaps = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Error error_mm = rough(4e-4, at_mm, seed + 50);
        if (diagnosed(readings({at_mm, 3, 2e-4}, error_mm, seed)).verdict !=
            diagnosis::Verdict::no_gap)
            ++found;
        const Error none = [](double) { return 0.0; };
        if (diagnosed(readings({at_mm, 3, 2e-4}, none, seed)).verdict != diagnosis::Verdict::no_gap)
            ++false_gaps;
    }
    CHECK(found >= 9);
    CHECK(false_gaps == 0);
}

TEST_CASE("two neighbouring spoiled readings hide no error", "[diagnosis][few_places]") {
    const Error error_mm = [](double at_mm) { return 0.01 * std::cos(at_mm / 14.0); };
    records::ReadingTable table = readings({even_places(5, 40.0), 5, 1e-3}, error_mm, 3);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].value_mm) rows.push_back(i);
    *table.rows[rows[8]].value_mm += 0.15;
    *table.rows[rows[9]].value_mm += 0.19;
    const diagnosis::Diagnosis d = diagnosed(table);
    INFO(said(d));
    CHECK(d.outliers == 2);
    CHECK(d.verdict != diagnosis::Verdict::unexplained);
    CHECK(d.noise_um < 1.5);
    CHECK(achieved(d, error_mm, 40.0) > 0.8);
}

TEST_CASE("a bend seen at four places holds at these alone, at five between them",
          "[diagnosis][few_places]") {
    for (const std::size_t places : {3, 4, 5, 6}) {
        const Laser laser{even_places(places, 400.0), 3, 0.5e-3};
        records::ReadingTable table = readings(
            laser, [](double x) { return 20e-3 * (std::pow(x / 200.0 - 1.0, 2) - 0.5); }, 4);
        for (records::Reading& row : table.rows) row.direction_M = Vector3(0, 1, 0);
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(stage("noise_um = { linear = 0.5 }\n"), table);
        INFO(places << " places: " << said(d));
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "X.straightness");
        CHECK(d.between_places == (places >= 5));
    }
}

}  // namespace trunnion
