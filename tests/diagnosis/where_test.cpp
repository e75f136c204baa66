// Where the gap lies: sentences with figures, only for what chance cannot make.
#include <catch2/catch.hpp>
#include <numeric>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// A campaign whose shop conditions change from pose to pose, each on its own.
records::ReadingTable varied(const setup::Setup& setup, bool ballbar) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 90, 5);
    SeededNoise random(17);
    double time_s = -1.0, temperature_c = 20.0, load_kg = 0.0;
    bool clamped = false;
    for (records::Reading& row : table.rows) {
        if (row.device == records::Device::none || row.time_s != time_s) {
            temperature_c = 18.0 + 4.0 * random.uniform();
            load_kg = random.uniform() < 0.5 ? 0.0 : 120.0;
            clamped = random.uniform() < 0.5;
        }
        time_s = row.time_s;
        row.temperature_c = temperature_c;
        row.load_kg = load_kg;
        row.clamped = clamped;
    }
    if (ballbar) campaign::add_ballbar(table, setup, 36);
    return table;
}

const diagnosis::DriverShare* entry(const diagnosis::Diagnosis& d, const std::string& by) {
    for (const diagnosis::DriverShare& w : d.where)
        if (w.by == by) return &w;
    return nullptr;
}

/// Gives the poses each other's labels.
records::ReadingTable shuffled(
    const records::ReadingTable& table,
    const std::function<void(records::Reading&, const records::Reading&)>& take,
    std::uint64_t seed) {
    std::vector<std::vector<std::size_t>> poses;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (table.rows[i].device != records::Device::sphere) continue;
        if (poses.empty() || table.rows[poses.back().front()].time_s != table.rows[i].time_s)
            poses.emplace_back();
        poses.back().push_back(i);
    }
    std::vector<std::size_t> order(poses.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    SeededNoise random(seed);
    for (std::size_t k = order.size(); k > 1; --k)
        std::swap(order[k - 1],
                  order[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
    records::ReadingTable result = table;
    for (std::size_t k = 0; k < poses.size(); ++k)
        for (const std::size_t i : poses[k])
            take(result.rows[i], table.rows[poses[order[k]].front()]);
    return result;
}

}  // namespace

TEST_CASE("each driver is found where an effect follows it, with its share", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    struct Case {
        const char *injection, *by, *words;
        bool ballbar;
        double least_share = 0.5;
    };
    const Case cases[] = {
        {"C.backlash=120urad", "direction of C", "changes sign with the direction of C", false},
        {"B.positioning: cos2_rad=6e-5, sin1_rad=6e-5", "B", "follows the position of B", false},
        {"X.straightness: EYX_p2_mm=0.02", "X", "follows the position of X", false},
        {"thermal.drift: d_mm=[0.02, 0, 0.02], tau_s=500", "time", "drifts with time", false},
        {"thermal.expansion: growth_x_per_k=2e-5, growth_z_per_k=2e-5", "temperature",
         "grows with temperature", false},
        {"pivot.g54: dg_mm=[0.01, 0.008, -0.01]", "mode", "depends on the positioning function",
         false},
        {"clamp.shift: shift_b_mm=[0.01, 0, 0.01]", "clamp", "depends on the clamp", false},
        {"gravity.sag: sag_mm=0.03", "load", "depends on the load", false, 0.2},  // the rest is B
        {"servo.mismatch: tau_x_s=4e-4", "velocity", "grows with the feed", true}};
    for (const Case& c : cases) {
        INFO(c.injection);
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, campaign::measured(campaign::with_effect(real, c.injection),
                                                          varied(setup, c.ballbar), 3));
        std::string all;
        for (const diagnosis::DriverShare& w : d.where) all += w.text + "\n";
        INFO(all);
        const diagnosis::DriverShare* found = entry(d, c.by);
        REQUIRE(found);
        CHECK(found->share > c.least_share);
        CHECK(found->p_value < 1e-4);
        CHECK_THAT(found->text, Catch::Contains(c.words));
        // The figure in the sentence is the share.
        CHECK(std::stod(found->text) == Approx(100.0 * found->share).margin(0.51));
    }
}

TEST_CASE("what turns with the spindle is found where the spindle was turned", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    for (records::Reading& row : table.rows)
        row.spindle_rad = std::fmod(row.time_s, 40.0) < 15.0 ? 0.0 : pi;
    for (const double size_mm : {0.0, 0.006}) {
        records::ReadingTable readings =
            campaign::measured(campaign::real_machine(setup), table, 4);
        for (records::Reading& row : readings.rows)
            if (row.value_mm)
                *row.value_mm += size_mm * std::cos(row.spindle_rad) * row.direction_M.x();
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, readings);
        const diagnosis::DriverShare* found = entry(d, "spindle");
        CHECK((found != nullptr) == (size_mm > 0.0));
        if (!found) continue;
        CHECK(found->share > 0.5);
        CHECK_THAT(found->text, Catch::Contains("turns with the spindle"));
    }
}

TEST_CASE("labels given to the wrong poses say nothing", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    struct Case {
        const char *injection, *by;
        std::function<void(records::Reading&, const records::Reading&)> take;
    };
    const Case cases[] = {
        {"pivot.g54: dg_mm=[0.01, 0.008, -0.01]", "mode",
         [](records::Reading& to, const records::Reading& from) { to.mode = from.mode; }},
        {"clamp.shift: shift_b_mm=[0.01, 0, 0.01]", "clamp",
         [](records::Reading& to, const records::Reading& from) { to.clamped = from.clamped; }},
        {"thermal.expansion: growth_x_per_k=2e-5, growth_z_per_k=2e-5", "temperature",
         [](records::Reading& to, const records::Reading& from) {
             to.temperature_c = from.temperature_c;
         }}};
    for (const Case& c : cases)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            INFO(c.injection << " seed " << seed);
            const records::ReadingTable readings = campaign::measured(
                campaign::with_effect(real, c.injection), varied(setup, false), seed);
            CHECK(entry(diagnosis::diagnose(setup, readings), c.by));
            CHECK_FALSE(entry(diagnosis::diagnose(setup, shuffled(readings, c.take, seed)), c.by));
        }
    // And without any effect nothing is said at all.
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
        CHECK(diagnosis::diagnose(setup, campaign::measured(real, varied(setup, false), seed))
                  .where.empty());
}

}  // namespace trunnion
