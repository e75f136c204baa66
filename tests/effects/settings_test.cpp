#include "effects/settings.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/alarm.h"
#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("the catalogue has every name of the contract", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    std::vector<std::string> names{
        "location",          "pivot.g54",         "pivot.p1970x",   "XY.squareness",
        "YZ.squareness",     "ZX.squareness",     "servo.mismatch", "servo.contour",
        "thermal.drift",     "thermal.expansion", "gravity.sag",    "probe.pretravel",
        "probe.radius",      "probe.runout",      "tool.length",    "ballbar.length",
        "artefact.position", "artefact.form",     "artefact.moved", "control.rounding",
        "control.chord",     "clamp.shift",       "sensor.gain",    "machine.expansion"};
    for (const char* axis : {"B", "C"})
        for (const char* what :
             {".zero", ".positioning", ".cyclic", ".radial", ".axial", ".tilt", ".backlash",
              ".reversal_spike"})  // the contract has the spike of linear axes only
            names.push_back(std::string(axis) + what);
    for (const char* axis : {"X", "Y", "Z"})
        for (const char* what : {".scale", ".straightness", ".angular", ".cyclic", ".backlash",
                                 ".reversal_spike", ".lateral_play", ".play_load"})
            names.push_back(std::string(axis) + what);
    for (const std::string& name : names) {
        INFO(name);
        const effects::Effect* effect = effects::find_effect(catalogue, name);
        REQUIRE(effect != nullptr);
        REQUIRE(effect->what.size() > 10);
        REQUIRE(effect->cause.size() > 5);
        REQUIRE(effect->remedy.size() > 5);
    }
    REQUIRE(catalogue.size() == names.size());
}

TEST_CASE("kind and axis identify an effect, whatever the axes are called", "[effects]") {
    using effects::EffectKind;
    setup::Setup setup = campaign::bc_setup();
    setup.machine.chain.work.back().name = "play.cyclic";  // no name decides what an effect is
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    const Axis renamed = setup.machine.chain.work.back().axis;
    const effects::Effect* play = effects::find_effect(catalogue, EffectKind::backlash, renamed);
    REQUIRE(play != nullptr);
    CHECK(play->name == "play.cyclic.backlash");
    CHECK(effects::find_effect(catalogue, EffectKind::cyclic, Axis::X)->name == "X.cyclic");
    CHECK(effects::find_effect(catalogue, EffectKind::scale, renamed) == nullptr);
    for (const effects::Effect& a : catalogue)
        for (const effects::Effect& b : catalogue) {
            INFO(a.name << ' ' << b.name);
            const bool squareness = a.kind == EffectKind::squareness;  // of three planes
            CHECK((a.kind == b.kind && a.axis == b.axis && !squareness) ==
                  (a.name == b.name && !squareness));
        }
}

TEST_CASE("only the slope of a straightness error belongs to the mean line", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    std::vector<std::string> slopes;
    for (const effects::Effect& effect : catalogue)
        for (const effects::EffectParameter& p : effect.parameters)
            if (p.mean_line) slopes.push_back(effect.name + ' ' + p.name);
    CHECK(slopes == std::vector<std::string>{"X.straightness EYX_p1_mm", "X.straightness EZX_p1_mm",
                                             "Y.straightness EXY_p1_mm", "Y.straightness EZY_p1_mm",
                                             "Z.straightness EXZ_p1_mm",
                                             "Z.straightness EYZ_p1_mm"});
}

TEST_CASE("injections with names, vectors and units", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    const auto value = [&](const std::string& text, const std::string& name) {
        return effects::parse_injection(text, catalogue).parameters.at(name);
    };
    REQUIRE(value("C.backlash: gap_rad=6e-5", "gap_rad").front() == 6e-5);
    REQUIRE(value("C.backlash=60urad", "gap_rad").front() == Approx(6e-5));
    REQUIRE(value("C.backlash = 12.375 arcsec", "gap_rad").front() == Approx(5.99957e-5));
    REQUIRE(value("X.backlash=5um", "gap_mm").front() == Approx(0.005));
    REQUIRE(value("X.backlash=5 µm", "gap_mm").front() == Approx(0.005));
    REQUIRE(value("C.backlash=60µrad", "gap_rad").front() == Approx(6e-5));
    REQUIRE(value("pivot.g54: dg_mm=[10um, 0, -0.02]", "dg_mm") ==
            std::vector<double>{10 * 1e-3, 0.0, -0.02});
    REQUIRE(value("C.cyclic: cos_rad=1e-5, periods_per_turn=72", "periods_per_turn").front() == 72);
    REQUIRE(value("servo.mismatch: tau_x_s=0.4ms", "tau_x_s").front() == Approx(4e-4));
}

TEST_CASE("injections that mean nothing are refused with their place", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    for (const char* text :
         {"C.wobble=3", "C.backlash", "C.backlash: gap=3", "C.backlash=", "C.backlash=3 um",
          "C.backlash: gap_rad", "C.backlash: =1", "C.backlash=1e-5 rest",
          "servo.contour: lag2_s2=[1, 2]", "", "pivot.g54: dg_mm=[1, 2]", "A.backlash=1urad",
          "C.backlash=nan", "C.backlash=infurad", "X.backlash=1e308m"}) {
        INFO(text);
        try {
            effects::parse_injection(text, catalogue);
            FAIL("taken");
        } catch (const InputError& error) {
            CHECK(error.where.program == "--inject");
            CHECK(error.where.column > 0);
            CHECK(error.line_text == text);
        }
    }
}

TEST_CASE("one name sets the contour lag of all linear axes", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    const auto value = [&](const std::string& text, const std::string& name) {
        const effects::Effect& effect = *effects::find_effect(catalogue, "servo.contour");
        const auto values = effects::values_of(effect, effects::parse_injection(text, catalogue));
        for (std::size_t j = 0; j < values.size(); ++j)
            if (effect.parameters[j].name == name) return values[j];
        FAIL("no parameter " << name);
        return 0.0;
    };
    for (const char* name : {"lag2_x_s2", "lag2_y_s2", "lag2_z_s2"})
        CHECK(value("servo.contour: lag2_s2=1e-4", name) == 1e-4);
    for (const char* name : {"lag2_b_s2", "lag2_c_s2"})
        CHECK(value("servo.contour: lag2_s2=1e-4", name) == 0.0);
    CHECK(value("servo.contour: lag2_s2=1e-4, lag2_y_s2=2e-4", "lag2_y_s2") == 2e-4);
    CHECK(value("servo.contour: lag2_s2=1e-4, lag2_y_s2=2e-4", "lag2_x_s2") == 1e-4);
}

TEST_CASE("values and settings are each other's inverse", "[effects]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    for (const effects::Effect& effect : catalogue) {
        std::vector<double> values = effect.zeros();
        for (std::size_t j = 0; j < values.size(); ++j)
            if (!effect.parameters[j].is_key()) values[j] = 0.1 * static_cast<double>(j + 1);
        INFO(effect.name);
        REQUIRE(effects::values_of(effect, effects::setting_of(effect, values)) == values);
    }
}

namespace {

/// What only a tool side that turns has: a telescope, an arm, a head that carries a head.
effects::Catalogue of_a_telescope() {
    std::vector<std::string> notes;
    effects::Catalogue all = effects::make_catalogue(
        setup::load_setup(TRUNNION_SOURCE_DIR "/tests/imports/like_real/mount.toml", notes));
    const effects::Catalogue known = effects::make_catalogue(campaign::bc_setup());
    std::erase_if(all, [&](const effects::Effect& effect) {
        return std::any_of(known.begin(), known.end(),
                           [&](const effects::Effect& k) { return k.kind == effect.kind; });
    });
    return all;
}

std::string effects_page() {
    return "# Effects\n\nEvery effect of the catalogue on a BC table machine (`effects/`). Names "
           "and "
           "parameters are those of `--inject`, of `[effects]` in a setup file and of the JSON "
           "results. Typical sizes are prior standard deviations; q is the axis position (mm, "
           "rad), "
           "keys are searched. Written by `test_effects '[docs]'`.\n\n" +
           effects::describe_catalogue(effects::make_catalogue(campaign::bc_setup())) +
           "\nOn a telescope or an arm, whose tool side turns, also (`trunnion effects "
           "--setup`):\n\n" +
           effects::describe_catalogue(of_a_telescope());
}

const char* page_path = TRUNNION_SOURCE_DIR "/docs/effects.md";

}  // namespace

TEST_CASE("docs/effects.md is the catalogue", "[effects]") {
    std::ifstream in(page_path);
    std::stringstream text;
    text << in.rdbuf();
    REQUIRE(text.str() == effects_page());
}

TEST_CASE("write docs/effects.md", "[.docs]") {
    std::ofstream(page_path) << effects_page();
}

}  // namespace trunnion
