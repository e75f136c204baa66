// What holds for every effect: linear in its sizes, sound at the limits of its keys.
#include <algorithm>
#include <catch2/catch.hpp>

#include "records/samples.h"
#include "tests/effects/bc_physics.h"

namespace trunnion {

TEST_CASE("twice the parameter is twice the change, for every parameter of the catalogue",
          "[effects]") {
    const Physics physics;
    const effects::Catalogue catalogue = effects::make_catalogue(physics.setup);
    const emulator::Replay replay(physics.setup, physics.table);
    const std::vector<double> off = replay.predict({});
    for (const effects::Effect& effect : catalogue)
        for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
            if (effect.parameters[j].is_key()) continue;
            INFO(effect.name << ' ' << effect.parameters[j].name);
            std::vector<double> values = effect.zeros();
            CHECK(replay.predict({effects::make_model(effect, values)}) == off);  // off is off
            values[j] = effect.parameters[j].typical;
            const auto once = replay.predict({effects::make_model(effect, values)});
            values[j] *= 2.0;
            const auto twice = replay.predict({effects::make_model(effect, values)});
            double worst = 0.0, largest = 0.0;
            for (std::size_t i = 0; i < off.size(); ++i) {
                worst = std::max(worst, std::abs(twice[i] - off[i] - 2.0 * (once[i] - off[i])));
                largest = std::max(largest, std::abs(twice[i] - off[i]));
            }
            CHECK(worst <= 2e-3 * largest);
        }
}

TEST_CASE("what slipped is what the device reads, not always a sphere", "[effects]") {
    const Physics physics;
    const auto words = [&](std::set<records::Device> devices) {
        effects::DataExtent extent;
        extent.devices = std::move(devices);
        return effects::artefact_moved(physics.setup.artefacts, extent).what;
    };
    using records::Device;
    for (const std::set<Device>& probed :
         {std::set<Device>{}, {Device::touch}, {Device::sphere, Device::ballbar, Device::linear}})
        CHECK_THAT(words(probed), Catch::Contains("sphere or cup"));
    CHECK_THAT(words({Device::linear}), Catch::Contains("reflector"));
    CHECK_THAT(words({Device::angle}), Catch::Contains("mirror"));
    CHECK_THAT(words({Device::point}), Catch::Contains("part or target"));
    CHECK_THAT(words({Device::linear, Device::axis}), Catch::Contains("target or an instrument"));
    CHECK(effects::extent_of(physics.setup, physics.table).devices.count(Device::none) == 0);
}

TEST_CASE("pivot parameters are spoken of where a control has them", "[effects]") {
    const auto remedy = [](const std::string& chain, const std::vector<std::string>& rotary) {
        std::string text = "[machine]\nname = \"m\"\nchain = \"" + chain + "\"\n";
        for (const std::string& axis : rotary)
            text += "[machine.axis." + axis + "]\ndirection = [" +
                    (axis == rotary.front() ? "0, 1, 0" : "0, 0, 1") + "]\npoint_mm = [0, 0, 0]\n";
        std::vector<std::string> notes;
        const setup::Setup setup = setup::parse_setup(text, "m.toml", notes);
        return effects::find_effect(effects::make_catalogue(setup), "location")->remedy;
    };
    CHECK_THAT(remedy("w C B b X Y Z t", {"B", "C"}),
               Catch::Contains("the control's pivot parameters"));
    CHECK_THAT(remedy("w b Az Alt t", {"Alt", "Az"}), Catch::Contains("model of its axes") &&
                                                          !Catch::Contains("pivot") &&
                                                          !Catch::Contains("control"));
    CHECK_THAT(remedy("w C b X t", {"C"}), !Catch::Contains("pivot"));
}

TEST_CASE("the periods of a ripple fit the range that was read", "[effects]") {
    const auto limits = [](double range_mm) {
        const std::vector<double> grid = effects::ripple_periods_mm(range_mm);
        for (std::size_t k = 1; k < grid.size(); ++k) {
            REQUIRE(grid[k] > grid[k - 1]);
            // From end to end a quarter of a cycle more; of long ways the search looks between.
            if (range_mm >= 1e-3 && range_mm < 200.0)
                REQUIRE(range_mm / grid[k - 1] - range_mm / grid[k] < 0.2501);
        }
        return std::pair(grid.front(), grid.back());
    };
    // An axis that stands has the jitter of its command, or none.
    for (const double range_mm : {0.0, 1e-320, 9.9e-4, 200.0, 200.1, 900.0}) {
        CHECK(limits(range_mm).first == Approx(4.0));
        CHECK(limits(range_mm).second == Approx(50.0));
    }
    CHECK(limits(199.9).first == Approx(4.0).epsilon(0.01));
    CHECK(limits(100.0).first == Approx(1.0).epsilon(0.01));
    CHECK(limits(40.0).first == Approx(0.2).epsilon(0.01));
    CHECK(limits(40.0).second == Approx(20.0));
    CHECK(limits(1e-3).first == Approx(5e-6).epsilon(0.01));
}

TEST_CASE("a rotary axis that turns little may have a large gain, one that stands has none",
          "[effects]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b C t\"\n[machine.axis.C]\ndirection = [0, 0, 1]\n"
        "point_mm = [0, 0, 0]\nlimits_deg = [-90, 90]\n",
        "m.toml", notes);
    const auto usual = [&](double range_rad) {
        effects::DataExtent extent;
        extent.least[Axis::C] = 0.2;
        extent.most[Axis::C] = 0.2 + range_rad;
        const effects::Catalogue catalogue = effects::make_catalogue(setup, extent);
        for (const effects::EffectParameter& p :
             effects::find_effect(catalogue, "C.positioning")->parameters)
            if (p.name == "slope_rad_per_rad") return p.typical;
        return 0.0;
    };
    for (const double range_rad : {0.0, 1e-12, 9.9e-4, 0.31, 3.0})
        CHECK(usual(range_rad) == Approx(15e-6));
    CHECK(usual(0.15) == Approx(30e-6));
    CHECK(usual(1.1e-3) == Approx(15e-6 * 0.3 / 1.1e-3));
}

// The prior of a drift's size takes the time of the readings from there (log_prior_of_size()).
TEST_CASE("time constants of a drift are looked for up to three times the time of the readings",
          "[effects]") {
    const Physics physics;
    for (const double time_s : {600.0, 5000.0}) {
        effects::DataExtent extent;
        extent.end_s = time_s;
        const effects::Effect drift =
            *effects::find_effect(effects::make_catalogue(physics.setup, extent), "thermal.drift");
        const auto at =
            std::find_if(drift.parameters.begin(), drift.parameters.end(),
                         [](const effects::EffectParameter& p) { return p.name == "tau_s"; });
        REQUIRE(at != drift.parameters.end());
        CHECK(at->grid.back() == Approx(3.0 * time_s));
    }
}

TEST_CASE("a drift counts from the first reading where the clock starts late", "[effects]") {
    const Physics physics;
    const auto from_s = [&](double start_s) {
        effects::DataExtent extent;
        extent.start_s = start_s;
        extent.end_s = start_s + 1000.0;
        const effects::Effect drift =
            *effects::find_effect(effects::make_catalogue(physics.setup, extent), "thermal.drift");
        const auto at =
            std::find_if(drift.parameters.begin(), drift.parameters.end(),
                         [](const effects::EffectParameter& p) { return p.name == "from_s"; });
        REQUIRE(at != drift.parameters.end());
        return at->typical;
    };
    CHECK(from_s(0.0) == 0.0);
    CHECK(from_s(100.0) == 0.0);  // a tenth of the time: the program that was started
    CHECK(from_s(101.0) == 101.0);
    CHECK(from_s(36000.0) == 36000.0);
    const auto miss = [&](double before_s) {
        return physics.miss(
            "thermal.drift: d_mm=[0, 0, 0.02], tau_s=1, from_s=" + std::to_string(before_s),
            [](const Seen&) {
                return tip({0, 0, 0.02});
            },
            [](const Seen& s) { return s.row->time_s > 100.0; });
    };
    CHECK(miss(0.0) < 1e-6);
    CHECK(miss(1e7) > 0.99);  // none before it begins
}

TEST_CASE("time constants, pitches and decays at their limits", "[effects]") {
    const Physics physics;
    const auto drift = [&](double tau_s) {
        return physics.miss(
            "thermal.drift: d_mm=[0, 0, 0.02], tau_s=" + std::to_string(tau_s),
            [](const Seen&) {
                return tip({0, 0, 0.02});
            },
            [](const Seen& s) { return s.row->time_s > 100.0; });
    };
    CHECK(drift(1.0) < 1e-6);  // long over: the whole shift
    CHECK(drift(1e9) > 0.99);  // not begun: nothing
    // A ripple whose pitch is the distance between two positions is the same at both.
    const effects::Effect ripple =
        effects::linear_cyclic(*physics.setup.machine.chain.find(Axis::X));
    const auto shift = [&](const effects::Effect& effect, const std::vector<double>& values,
                           Axis axis, double q) {
        AxisSample sample;
        sample.position[axis] = q;
        kinematics::Perturbation out;
        effect.add(sample, {}, values, out);
        return out.axis[axis];
    };
    CHECK(shift(ripple, {2e-3, 1e-3, 12.0}, Axis::X, 5.0) ==
          Approx(shift(ripple, {2e-3, 1e-3, 12.0}, Axis::X, 5.0 - 24.0)));
    const effects::Effect teeth =
        effects::rotary_cyclic(*physics.setup.machine.chain.find(Axis::C));
    CHECK(shift(teeth, {2e-5, 1e-5, 90.0}, Axis::C, 0.1) ==
          Approx(shift(teeth, {2e-5, 1e-5, 90.0}, Axis::C, 0.1 + 2.0 * pi / 90.0)));
    // A spike has lost all but 1/e of its height one decay length after the turn.
    const effects::Effect spike =
        effects::linear_reversal_spike(*physics.setup.machine.chain.find(Axis::Y));
    const auto after = [&](double way_mm, double run_up = 1.0, bool unknown = false) {
        AxisSample sample;
        sample.run_up_unknown[index_of(Axis::Y)] = unknown;
        sample.travel[index_of(Axis::Y)] = 1;
        sample.since_reversal[index_of(Axis::Y)] = way_mm;
        emulator::Contact contact;
        contact.device = records::Device::ballbar;
        kinematics::Perturbation out;
        spike.add(sample, contact, std::vector<double>{0.006, 2.0, 1.0, run_up}, out);
        return out.axis[Axis::Y];
    };
    CHECK(after(0.0) == Approx(-0.006));
    CHECK(after(2.0) == Approx(-0.006 * std::exp(-1.0)));
    CHECK(after(records::no_reversal_seen * 2.0) == 0.0);
    // A circle begun at the quadrant: reached through it (a run-up arc), or not.
    CHECK(after(2.0, 1.0, true) == after(2.0));
    CHECK(after(2.0, 0.0, true) == 0.0);
    CHECK(after(2.0, 0.0, false) == after(2.0));
    // With the angle since the quadrant, on a circle of any size: 0.02 rad is 2 mm on 100 mm.
    for (const double angle : {0.01, 0.02, 0.5, 2.0, 3.0})
        for (const double speed : {3.0, 50.0}) {
            AxisSample sample;
            sample.travel[index_of(Axis::Y)] = -1;
            sample.velocity[Axis::X] = speed * std::cos(angle);
            sample.velocity[Axis::Y] = -speed * std::sin(angle);
            emulator::Contact contact;
            contact.device = records::Device::ballbar;
            sample.acceleration[Axis::Y] = -std::cos(angle);
            kinematics::Perturbation out;
            spike.add(sample, contact, std::vector<double>{0.006, 2.0, 0.0, 1.0}, out);
            CHECK(out.axis[Axis::Y] == Approx(0.006 * std::exp(-angle / 0.02)).margin(1e-15));
        }
    // Rounding never moves an axis by more than half the increment.
    const effects::Effect rounding = effects::control_rounding(physics.setup.machine.chain);
    for (double q = -1.0; q < 1.0; q += 0.0137)
        CHECK(std::abs(shift(rounding, {1.0, 0.0, 0.02}, Axis::X, q)) <= 0.01 + 1e-12);
}

}  // namespace trunnion
