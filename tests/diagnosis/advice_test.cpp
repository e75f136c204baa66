// Acting on the advice: how often the pair is told apart, against how often the text says so.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "diagnosis/advice/measurement_repeats.h"
#include "diagnosis/advice/measurements.h"
#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/drawn_effects.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// A machine as it is declared, as it is, and where it is read.
struct Advised {
    setup::Setup known, real;
    records::ReadingTable table;
};

Advised advised_case(std::uint64_t seed) {
    const setup::Setup known = seed % 2 ? campaign::bc_setup() : campaign::ac_setup();
    Advised a{known, campaign::real_machine(known), campaign::empty_table(known)};
    switch (seed % 5) {
        case 0: campaign::add_ballbar(a.table, known, 36); break;
        case 1: campaign::add_sphere_map(a.table, known, 24, seed); break;
        case 2: campaign::add_sphere_map(a.table, known, 70, seed); break;
        default:
            a.known = laser_lines::mill(seed % 2 ? "w Y b X Z t" : "w b X Y Z t", 150.0, 0.8);
            a.real = a.known;
            a.table = laser_lines::empty_table();
            laser_lines::add_runs(a.table, {"along", Axis::X, -200.0, 20.0, 21, Vector3::UnitX()});
            if (seed % 5 == 4)
                laser_lines::add_runs(a.table,
                                      {"beside", Axis::X, -200.0, 20.0, 21, Vector3::UnitY()});
    }
    // Effects that are often imitated.
    const setup::Setup plain = a.real;
    for (std::uint64_t more = 0;; more += 1000) {
        a.real = with_drawn_effects(plain, a.table, 1, seed + more);
        const std::string& name = a.real.effects.front().name;
        for (const char* kind : {"scale", "straightness", "angular", "squareness", "pivot", "sag",
                                 "drift", "radial", "moved", "expansion", "play"})
            if (name.find(kind) != std::string::npos) return a;
    }
}

/// The planned measurement that an advice asks for, on the present setup; nullptr: another setup.
const diagnosis::Measurement* planned(const std::vector<diagnosis::Measurement>& list,
                                      const diagnosis::NextMeasurement& next) {
    for (const diagnosis::Measurement& m : list)
        if (next.text.find(": " + m.text + " (about") != std::string::npos)
            return m.setup || m.other_instrument ? nullptr : &m;
    return nullptr;
}

bool still_open(const diagnosis::Diagnosis& d, const diagnosis::NextMeasurement& pair) {
    const auto names = [](const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    return std::any_of(d.causes.begin(), d.causes.end(), [&](const diagnosis::Cause& c) {
        return (c.effect == pair.first && names(c.rivals, pair.second)) ||
               (c.effect == pair.second && names(c.rivals, pair.first));
    });
}

struct Acted {
    double probability;
    bool settled, right;
};

/// The first advice of a case is acted on; empty without one.
std::optional<Acted> acted(std::uint64_t seed) {
    const Advised a = advised_case(seed);
    const records::ReadingTable first = campaign::measured(a.real, a.table, seed + 100);
    const diagnosis::Diagnosis before = diagnosis::diagnose(a.known, first);
    if (before.next.empty() || before.next.front().minutes <= 0.0) return std::nullopt;
    const diagnosis::NextMeasurement& next = before.next.front();
    const double start_s = first.rows.back().time_s + 600.0;
    const auto list = next.program.empty()
                          ? diagnosis::repeated_measurements(a.known, first, start_s)
                          : diagnosis::ready_measurements(a.known, start_s);
    const diagnosis::Measurement* m = planned(list, next);
    if (!m) return std::nullopt;
    const records::ReadingTable second = campaign::measured(a.real, m->table, seed + 200);
    const diagnosis::Diagnosis after =
        diagnosis::diagnose(a.known, records::join_readings({first, second}));
    const std::string truth = a.real.effects.front().name;
    const bool open = still_open(after, next);
    std::printf("%2d %.2f %s %s: %s\n     before %s\n     after %s\n", static_cast<int>(seed),
                next.probability.value(), open ? "OPEN" : "told", truth.c_str(), next.text.c_str(),
                said(before).c_str(), said(after).c_str());
    return Acted{next.probability, !open,
                 !after.causes.empty() && after.causes.front().effect == truth};
}

}  // namespace

// How often an advice keeps its word: ADVICE_FIRST, ADVICE_COUNT cases.
TEST_CASE("advice is as good as its probability", "[diagnosis][.advice]") {
    const auto number = [](const char* name, int otherwise) {
        const char* text = std::getenv(name);
        return text ? std::atoi(text) : otherwise;
    };
    const int from = number("ADVICE_FIRST", 1);
    double count = 0.0, expected = 0.0, told = 0.0, sure = 0.0, sure_told = 0.0, right = 0.0;
    for (int seed = from; seed < from + number("ADVICE_COUNT", 60); ++seed) {
        const auto a = acted(static_cast<std::uint64_t>(seed));
        if (!a) continue;
        ++count;
        expected += a->probability;
        told += a->settled ? 1.0 : 0.0;
        right += a->right ? 1.0 : 0.0;
        if (a->probability < 0.9) continue;
        ++sure;
        sure_told += a->settled ? 1.0 : 0.0;
    }
    std::printf(
        "%.0f acted on, expected to settle %.1f, settled %.0f; of %.0f sure ones %.0f; "
        "right first %.0f\n",
        count, expected, told, sure, sure_told, right);
    CHECK(told > expected - 2.0 * std::sqrt(count) / 2.0);
    CHECK(sure_told >= 0.8 * sure);
}

TEST_CASE("the advised touches of a sphere reach its pole and go between it and the equator",
          "[diagnosis][next]") {
    for (const setup::Setup& setup : {campaign::bc_setup(), campaign::ac_setup()})
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0)) {
            std::set<int> lifts;  // of a touch, degrees above the equator
            for (const records::Reading& row : m.table.rows)
                if (row.device == records::Device::touch)
                    lifts.insert(static_cast<int>(
                        std::lround(deg_from_rad(std::asin(-row.direction_M.z())))));
            if (lifts.empty()) continue;
            INFO(setup.name << " " << m.name);
            CHECK(lifts.contains(90));
            CHECK(lifts.contains(45));
            CHECK((lifts.contains(0) || lifts.contains(15)));
        }
}

}  // namespace trunnion
