// Ripples while other devices let the axis stand elsewhere: what is not read of it there does not
// resolve a period, and what is read badly decides by its likelihood.
#include "diagnosis/alike_periods.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/round.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double period_mm = 20.0;

/// A mill whose tracker T stands anywhere.
setup::Setup machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[[instrument]]\nname = \"T\"\norigin_mm = [1500, 200, 600]\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.3, point = 5.0 }\n",
        "mill.toml", notes);
}

laser_lines::Line along_z(double from_mm, double step_mm, int places) {
    return {"LZ", Axis::Z, from_mm, step_mm, places, Vector3::UnitZ(), 0.0};
}

/// Lines of X while Z stands at three other positions.
void add_parked(records::ReadingTable& table) {
    int k = 0;
    for (const double z_mm : {-160.0, 7.0, 61.0})
        laser_lines::add_runs(
            table, {"LX" + std::to_string(k++), Axis::X, -200.0, 25.0, 17, Vector3::UnitX(), z_mm});
}

/// Points of the tracker on a coarse lattice, three components each.
void add_points(records::ReadingTable& table) {
    table.optional_columns = {"instrument"};
    for (const double x_mm : {-200.0, 0.0, 200.0})
        for (const double y_mm : {-150.0, 0.0, 150.0})
            for (const double z_mm : {-7.0, 181.0, 366.0, 547.0})
                for (const Vector3& d : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()),
                                         Vector3(Vector3::UnitZ())}) {
                    records::Reading row;
                    row.index = static_cast<int>(table.rows.size());
                    row.time_s = 10.0 * row.index;
                    row.test = "P";
                    row.device = records::Device::point;
                    row.feature = "R1";
                    row.instrument = "T";
                    row.direction_M = d;
                    row.commanded[Axis::X] = x_mm;
                    row.commanded[Axis::Y] = y_mm;
                    row.commanded[Axis::Z] = z_mm;
                    table.rows.push_back(row);
                }
}

/// The table as a machine with this error reads it.
records::ReadingTable read(const records::ReadingTable& table, const std::string& error,
                           std::uint64_t seed) {
    setup::Setup truth = machine();
    truth.effects.push_back(effects::parse_injection(error, effects::make_catalogue(truth)));
    auto read = emulator::predicted(truth, table, effects::active_models(truth));
    SeededNoise noise(seed);
    for (records::Reading& row : read.rows)
        *row.value_mm += (row.device == records::Device::point ? 5e-3 : 3e-4) * noise.normal();
    return read;
}

std::string ripple(double size_um) {
    return fmt::format("Z.cyclic: cos_mm={}um, sin_mm={}um, period_mm={}mm", 0.6 * size_um,
                       0.8 * size_um, period_mm);
}

double period_of(const diagnosis::Cause& cause) {
    for (const auto& q : cause.parameters)
        if (q.name == "period_mm") return q.value;
    return 0.0;
}

/// Claimed ripples of Z: how many have the right period and are written, how many a wrong one.
struct Ripples {
    int right = 0, wrong = 0;
};
Ripples ripples_of(const diagnosis::Diagnosis& d) {
    Ripples found;
    for (const diagnosis::Cause& c : d.causes) {
        if (c.effect != "Z.cyclic" || c.probability < 0.5) continue;
        const bool right = std::abs(period_of(c) - period_mm) < 0.02 * period_mm;
        if (right && c.holds_between && d.writes_causes) ++found.right;
        if (!right) ++found.wrong;
    }
    return found;
}

/// A line of Z, and one of a direction with this part along Z, at other positions of Z.
records::ReadingTable oblique(double part, double step_mm) {
    records::ReadingTable table = laser_lines::empty_table();
    laser_lines::add_runs(table, along_z(0.0, 27.5, 9));
    const Vector3 direction_M(std::sqrt(1.0 - part * part), 0.0, part);
    laser_lines::add_runs(table, {"L2", Axis::Z, 5.0, step_mm, 9, direction_M, 5.0});
    return read(table, ripple(3.0), 1);
}

std::size_t places_told(const records::ReadingTable& table) {
    return diagnosis::telling_places(diagnosis::prepare(machine(), table), Axis::Z).size();
}

/// A search in which a ripple of Z is the only member.
struct Alone {
    explicit Alone(records::ReadingTable readings)
        : table(std::move(readings)),
          prepared(machine(), table),
          whitener(prepared.replay, prepared.blocks, {}, prepared.base.sigma_mm),
          design(white(prepared.base.columns), whitener.apply(prepared.base.residual_mm),
                 static_cast<double>(prepared.base.residual_mm.size())),
          setting(diagnosis::search_setting(design, {0.0, 1e-3})) {
        const auto& ripple =
            *effects::find_effect(prepared.catalogue, effects::EffectKind::cyclic, Axis::Z);
        std::vector<double> keys = ripple.zeros();
        for (std::size_t j = 0; j < keys.size(); ++j)
            if (ripple.parameters[j].is_key()) keys[j] = period_mm;
        model = diagnosis::tuned(
            design, setting,
            {{*diagnosis::add_keyed_group(design, prepared, whitener, ripple, keys)}, {{1.0}, 1.0}},
            3);
    }
    Eigen::MatrixXd white(Eigen::MatrixXd columns) const {
        whitener.apply(columns);
        return columns;
    }
    diagnosis::RippleSearch search() {
        return {prepared, whitener, design, setting, prepared.base.sigma_mm};
    }
    Alone(const Alone&) = delete;
    records::ReadingTable table;
    diagnosis::Prepared prepared;
    diagnosis::Whitener whitener;
    diagnosis::Design design;
    diagnosis::SearchSetting setting;
    diagnosis::Model model;
};

/// Least squares, mm^2, by which an alias of the ripple on steps of 27.5 mm misses it at places of
/// a second line, whose zero is free.
double least_miss(const std::vector<double>& places_mm) {
    const auto value = [](double f, double q, double sign) {
        return 1e-3 * (1.8 * std::cos(2.0 * pi * f * q) + sign * 2.4 * std::sin(2.0 * pi * f * q));
    };
    const double own = 1.0 / period_mm, step_mm = 27.5;
    double least = HUGE_VAL;
    for (int m = -8; m <= 8; ++m)
        for (const double sign : {1.0, -1.0}) {
            const double f = m / step_mm + sign * own;
            if (f < 1.0 / 50.0 || f > 1.0 / 4.0 || std::abs(f - own) < 1e-3) continue;
            double sum = 0.0, square = 0.0;
            for (const double q : places_mm) {
                const double d = value(f, q, sign) - value(own, q, 1.0);
                sum += d;
                square += d * d;
            }
            least = std::min(least, square - sum * sum / static_cast<double>(places_mm.size()));
        }
    return least;
}

/// Number of other periods where a second line misses them by some nats at least.
std::size_t alike_at(double nats) {
    const std::vector<double> places_mm{8.0, 19.0, 47.0, 103.0, 141.0};
    records::ReadingTable table = laser_lines::empty_table();
    table.optional_columns = {"sigma_mm"};
    laser_lines::add_runs(table, along_z(0.0, 27.5, 21));
    for (records::Reading& row : table.rows) row.sigma_mm = 3e-5;
    records::Reading row = table.rows.back();
    row.test = "L2";
    row.sigma_mm = std::sqrt(least_miss(places_mm) / (2.0 * nats));
    for (const double q : places_mm) {
        row.commanded[Axis::Z] = q;
        row.time_s += 10.0;
        ++row.index;
        table.rows.push_back(row);
    }
    setup::Setup truth = machine();
    truth.effects.push_back(effects::parse_injection(ripple(3.0), effects::make_catalogue(truth)));
    Alone alone(emulator::predicted(truth, table, effects::active_models(truth)));
    return diagnosis::alike_periods(alone.search(), alone.model, 0).size();
}

diagnosis::Diagnosis diagnosed(const records::ReadingTable& table) {
    return diagnosis::diagnose(machine(), table, {.plan_next = false});
}

}  // namespace

TEST_CASE("a reading tells of an axis from a tenth of the displacement on", "[diagnosis]") {
    CHECK(places_told(oblique(0.099, 27.5)) == 9);
    CHECK(places_told(oblique(0.101, 27.5)) == 18);
    CHECK(places_told(oblique(0.5, 27.5)) == 18);
}

TEST_CASE("a test in which the axis stands at one position tells nothing of it", "[diagnosis]") {
    CHECK(places_told(oblique(0.5, 0.0)) == 9);
    records::ReadingTable table = oblique(0.5, 0.0);
    table.rows.back().commanded[Axis::Z] += 3.0;
    CHECK(places_told(table) == 11);
}

TEST_CASE("places count by what they tell", "[diagnosis]") {
    CHECK(diagnosis::effective_count({}) == 0.0);
    CHECK(diagnosis::effective_count({{0, 2.0}, {1, 2.0}, {2, 2.0}}) == Approx(3.0));
    CHECK(diagnosis::effective_count({{0, 2.0}, {1, 2.0}, {2, 1e-3}}) == Approx(2.0).epsilon(0.01));
}

TEST_CASE("periods are alike within three nats", "[diagnosis]") {
    CHECK(alike_at(0.5) > 0);
    CHECK(alike_at(2.7) > 0);
    CHECK(alike_at(3.3) == 0);
    CHECK(alike_at(100.0) == 0);
}

TEST_CASE("a ripple of open period stays on 24 places or more", "[diagnosis]") {
    for (const int places : {23, 24, 25}) {
        records::ReadingTable table = laser_lines::empty_table();
        laser_lines::add_runs(table, along_z(0.0, 27.5, places));
        Alone alone(read(table, ripple(3.0), 1));
        const std::size_t member = alone.model.members.front();
        const diagnosis::Model model = diagnosis::without_open_ripples(alone.search(), alone.model);
        INFO(places);
        CHECK(model.members.empty() == (places < 24));
        CHECK(alone.design.groups()[member].only_rival == (places < 24));
        if (places < 24) continue;
        CHECK_FALSE(alone.design.group(model.members.front()).open_keys.empty());
    }
}

TEST_CASE("an axis that stands elsewhere meanwhile does not tell the period of its ripple",
          "[diagnosis]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        records::ReadingTable table = laser_lines::empty_table();
        laser_lines::add_runs(table, along_z(0.0, 27.5, 21));
        add_parked(table);
        const diagnosis::Diagnosis d = diagnosed(read(table, ripple(3.0), seed));
        INFO(seed << ": " << said(d));
        CHECK(ripples_of(d).wrong == 0);
    }
}

TEST_CASE("points that hardly tell of an axis leave the period of its ripple open", "[diagnosis]") {
    for (const int targets : {9, 21}) {
        records::ReadingTable table = laser_lines::empty_table();
        laser_lines::add_runs(table, along_z(0.0, 550.0 / (targets - 1), targets));
        add_points(table);
        const diagnosis::Diagnosis d = diagnosed(read(table, ripple(6.0), 4));
        INFO(targets << ": " << said(d));
        CHECK(ripples_of(d).wrong == 0);
    }
}

TEST_CASE("a dense line tells the period beside the others", "[diagnosis]") {
    for (const bool points : {false, true}) {
        records::ReadingTable table = laser_lines::empty_table();
        laser_lines::add_runs(table, along_z(0.0, 27.5, 21));
        laser_lines::Line dense = along_z(101.3, 3.7, 40);
        dense.test = "LZ2";
        laser_lines::add_runs(table, dense);
        if (points)
            add_points(table);
        else
            add_parked(table);
        const diagnosis::Diagnosis d = diagnosed(read(table, ripple(3.0), 5));
        INFO(said(d));
        CHECK(ripples_of(d).right == 1);
        CHECK(ripples_of(d).wrong == 0);
        CHECK(d.verdict == diagnosis::Verdict::explained);
    }
}

TEST_CASE("five targets and an axis that stands elsewhere are no ripple", "[diagnosis]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        records::ReadingTable table = laser_lines::empty_table();
        laser_lines::add_runs(table, along_z(0.0, 112.5, 5));
        add_parked(table);
        const diagnosis::Diagnosis d = diagnosed(
            read(table, "Z.scale: bow2_mm=" + std::to_string(2.0 + double(seed)) + "um", seed));
        INFO(seed << ": " << said(d));
        for (const diagnosis::Cause& c : d.causes) CHECK(c.effect != "Z.cyclic");
    }
}

}  // namespace trunnion
