// Location errors of both rotary axes come back as they went in, from the NC programs of the 2021
// paper (spheres) and of the 2015 paper (one ballbar set-up), and from mixtures of devices.
#include <catch2/catch.hpp>

#include "emulator/run.h"
#include "identification/identify.h"
#include "interpreter/program_folders.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;

setup::Setup shipped(const char* name) {
    std::vector<std::string> notes;
    return setup::load_setup(root + "/machines/" + name, notes);
}

records::ReadingTable run(const setup::Setup& machine, const std::string& folder, int program,
                          std::uint64_t seed) {
    interpreter::ProgramFolders folders({root + "/programs", root + folder});
    emulator::RunOptions options;
    options.seed = seed;
    options.effects = effects::active_models(machine);
    emulator::RunLog log = emulator::run_program(machine, folders, program, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

void require_location(const identification::Identification& result, const setup::Setup& truth,
                      double margin, double sigmas, std::size_t count) {
    std::size_t seen = 0;
    for (const identification::FitParameter& p : result.parameters) {
        if (p.effect != "location") continue;
        const double expected =
            truth.machine.errors.location(*kinematics::parse_error_name(p.name.substr(0, 4)));
        INFO(p.name << " " << p.value << " should be " << expected << " sigma " << p.sigma);
        CHECK(std::abs(p.value - expected) <= margin + sigmas * p.sigma);
        ++seen;
    }
    CHECK(seen == count);
}

/// The result written, loaded again, predicts the readings it was fitted to.
void require_loads_again(const identification::Identification& result,
                         const records::ReadingTable& table) {
    std::vector<std::string> notes;
    const setup::Setup again =
        setup::parse_setup(setup::format_setup(result.setup), "again.toml", notes);
    const records::ReadingTable a =
        emulator::predicted(again, table, effects::active_models(again));
    const records::ReadingTable b =
        emulator::predicted(result.setup, table, effects::active_models(result.setup));
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        if (a.rows[i].value_mm)
            REQUIRE(*a.rows[i].value_mm == Approx(*b.rows[i].value_mm).margin(1e-9));
}

}  // namespace

TEST_CASE("the four programs of 2021 give the location errors of B and C", "[identification]") {
    const setup::Setup setup = shipped("bc_table.toml");
    setup::Setup truth = setup;
    truth.machine.errors = campaign::real_machine(campaign::bc_setup()).machine.errors;
    truth.artefacts[0].center_W_mm += Vector3(0.05, -0.03, 0.02);
    for (const double repeatability_um : {0.0, 0.5}) {
        truth.probe->repeatability_um = repeatability_um;
        std::vector<records::ReadingTable> tables;
        for (int program = 8001; program <= 8004; ++program)
            tables.push_back(
                run(truth, "/programs/pivot", program, static_cast<std::uint64_t>(program)));
        const records::ReadingTable table = records::join_readings(std::move(tables));
        const identification::Identification result =
            identification::identify(setup, table, {"location"});
        const bool exact = repeatability_um == 0.0;
        require_location(result, truth, exact ? 1e-6 : 0.0, exact ? 0.0 : 3.0, 8);
        CHECK(result.inseparable.empty());
        CHECK(result.rms_after_um == Approx(repeatability_um).margin(exact ? 1e-4 : 0.03));
        require_loads_again(result, table);
    }
}

TEST_CASE("the single set-up ballbar test of 2015 gives the location errors of A and C",
          "[identification]") {
    setup::Setup truth = shipped("ac_trunnion.toml");
    truth.ballbar->sample_deg = 2.0;
    truth.ballbar->free_cup = false;  // the paper takes the cup's place as known
    setup::Setup setup = truth;
    setup.machine.errors = {};
    setup.model.modelled = {"location"};
    for (const double noise_um : {0.0, 0.3}) {
        truth.ballbar->noise_um = noise_um;
        const records::ReadingTable table = run(truth, "/programs/ballbar", 8200, 3);
        const identification::Identification result =
            identification::identify(setup, table, {"location"});
        const bool exact = noise_um == 0.0;
        CHECK(result.inseparable.empty());
        require_location(result, truth, exact ? 1e-6 : 0.0, exact ? 0.0 : 3.0, 8);
        CHECK(result.rms_after_um == Approx(noise_um).margin(exact ? 1e-4 : 0.02));
        require_loads_again(result, table);
    }
}

TEST_CASE("subsets of effects from any mixture of devices", "[identification]") {
    const setup::Setup setup = campaign::bc_setup(), machine = campaign::real_machine(setup);
    const auto table_of = [&](bool spheres, bool ballbar) {
        records::ReadingTable table = campaign::empty_table(setup);
        if (spheres) campaign::add_sphere_map(table, setup, 60, 5);
        if (ballbar) campaign::add_ballbar(table, setup, 72);
        return table;
    };
    const std::vector<std::string> injections{
        "C.backlash: gap_rad=8e-5", "XY.squareness: angle_rad=5e-5", "Y.scale: scale_ppm=30",
        "thermal.drift: d_mm=[0.01, 0, 0.02], tau_s=700",
        "C.cyclic: cos_rad=3e-5, periods_per_turn=45"};
    for (const auto& [spheres, ballbar] : {std::pair(true, false), {false, true}, {true, true}})
        for (unsigned subset = 1; subset < 32; subset += 5) {
            setup::Setup truth = machine;
            std::vector<std::string> effects{"location"};
            for (std::size_t k = 0; k < injections.size(); ++k) {
                if (!(subset >> k & 1)) continue;
                truth = campaign::with_effect(truth, injections[k]);
                effects.push_back(injections[k].substr(0, injections[k].find(':')));
            }
            const records::ReadingTable table = table_of(spheres, ballbar);
            const identification::Identification result =
                identification::identify(setup, campaign::measured(truth, table, subset), effects);
            INFO("spheres " << spheres << " ballbar " << ballbar << " subset " << subset);
            CHECK(result.rms_after_um < 1.1 * (spheres ? 0.8 : 0.3));
            for (const identification::FitParameter& p : result.parameters)
                for (const setup::EffectSetting& setting : truth.effects) {
                    if (setting.name != p.effect || !std::isfinite(p.sigma)) continue;
                    const auto it = setting.parameters.find(p.name);
                    const double expected =
                        it == setting.parameters.end()
                            ? 0.0
                            : it->second[static_cast<std::size_t>(std::max(0, p.component))];
                    INFO(identification::full_name(p)
                         << " " << p.value << " should be " << expected << " sigma " << p.sigma);
                    CHECK(std::abs(p.value - expected) < 5.0 * p.sigma);
                }
            require_loads_again(result, table);
        }
}

TEST_CASE("a longer stylus and a longer cup are set-up parameters of their own",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    setup::Setup truth = campaign::with_effect(campaign::real_machine(setup),
                                               "Z.angular: EAZ_p1_rad=4e-5, EBZ_p1_rad=-3e-5");
    truth.probe->extension_errors[60.0] = Vector3(0.02, -0.01, 0.03);
    truth.ballbar->extension_errors[60.0] = Vector3(-0.01, 0.02, 0.015);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 5);
    campaign::add_ballbar(table, setup, 36);
    const std::size_t half = table.rows.size();
    campaign::add_sphere_map(table, setup, 40, 6);
    campaign::add_ballbar(table, setup, 36);
    for (std::size_t i = half; i < table.rows.size(); ++i) {
        table.rows[i].extension_mm = 60.0;
        table.rows[i].commanded[Axis::Z] += 60.0;
        table.rows[i].test += "_long";
    }
    const std::vector<std::string> effects{"location", "Z.angular", "YZ.squareness",
                                           "ZX.squareness"};
    const identification::Identification exact =
        identification::identify(setup, campaign::measured(truth, table, 1, 0.0), effects);
    const auto value = [&](const std::string& name) -> double {
        for (const identification::FitParameter& p : exact.parameters)
            if (p.name == name) return p.value;
        FAIL(name);
        return 0.0;
    };
    CHECK(value("stylus+60.x_mm") == Approx(0.02).margin(1e-5));
    CHECK(value("stylus+60.z_mm") == Approx(0.03).margin(1e-5));
    CHECK(value("EAZ_p1_rad") == Approx(4e-5).margin(1e-8));
    CHECK(value("EBZ_p1_rad") == Approx(-3e-5).margin(1e-8));
    CHECK(exact.rms_after_um < 1e-4);
    require_loads_again(exact, table);
}

}  // namespace trunnion
