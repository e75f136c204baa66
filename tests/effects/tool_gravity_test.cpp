// Weight and flexure of an arm depend on the arm, not on where M has its origin.
#include <catch2/catch.hpp>

#include "effects/catalogue.h"
#include "setup/setup.h"

namespace trunnion {
namespace {

/// J1 upright, J2 level along Y with a target 1 m away along X, all of it shifted in M.
setup::Setup arm(const std::string& j1_mm, const std::string& j2_mm) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"arm\"\nchain = \"w b J1 J2 t\"\n"
        "[machine.axis.J1]\ndirection = [0, 0, 1]\npoint_mm = " +
            j1_mm + "\n[machine.axis.J2]\ndirection = [0, -1, 0]\npoint_mm = " + j2_mm +
            "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
            "tool_mm = [1000, 0, 0]\n",
        "s.toml", notes);
}

kinematics::Perturbation at_level(const setup::Setup& setup, effects::EffectKind kind,
                                  const std::vector<double>& values, double j2_rad) {
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    AxisSample sample;
    sample.position[setup.machine.chain.tool[1].axis] = j2_rad;
    kinematics::Perturbation out;
    for (const effects::Effect& effect : catalogue)
        if (effect.kind == kind) effect.add(sample, {}, values, out);
    return out;
}

}  // namespace

TEST_CASE("the weight of a target turns the joint that carries it, wherever M begins") {
    for (const auto& [j1, j2] :
         {std::pair("[0, 0, 0]", "[0, 0, 0]"), std::pair("[200, -300, 50]", "[200, -300, 450]")}) {
        const setup::Setup setup = arm(j1, j2);
        const Axis last = setup.machine.chain.tool[1].axis;
        for (const double q : {0.0, 0.6, -1.0}) {
            // A turn about -Y lifts the arm: its weight, 1 m cos q away, turns it back.
            const auto out = at_level(setup, effects::EffectKind::gravity_tool, {0.0, 1e-3}, q);
            CHECK(out.axis[last] == Approx(-1e-3 * std::cos(q)));
            // A tilt towards the ground is one about +Y.
            const auto bow = at_level(setup, effects::EffectKind::chain_flexure, {1e-3}, q);
            const Vector3 tilt_rad = bow.motion[index_of(last)].tilt_rad;
            CHECK((tilt_rad - Vector3(0.0, 1e-3 * std::cos(q), 0.0)).norm() < 1e-12);
        }
    }
}

// The tube is where the light comes from: level at altitude 0, upright at the zenith.
TEST_CASE("the tube of a telescope droops with the cosine of the altitude") {
    for (const char* azimuth : {"[0, 0, -1]", "[0, 0, 1]"}) {
        std::vector<std::string> notes;
        const setup::Setup setup = setup::parse_setup(
            std::string("[machine]\nname = \"t\"\nchain = \"w b J1 J2 t\"\n"
                        "[machine.axis.J1]\ndirection = ") +
                azimuth +
                "\npoint_mm = [0, 0, 0]\n[machine.axis.J2]\ndirection = [1, 0, 0]\n"
                "point_mm = [0, 0, 0]\n"
                "[[artefact]]\nname = \"Star\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n",
            "s.toml", notes);
        const Axis last = setup.machine.chain.tool[1].axis;
        for (const double q : {0.0, 0.6, 1.4}) {
            // A positive turn about +X raises the tube along +Y: the ground turns it back.
            const auto bow = at_level(setup, effects::EffectKind::chain_flexure, {1e-3}, q);
            const Vector3 tilt_rad = bow.motion[index_of(last)].tilt_rad;
            CHECK((tilt_rad - Vector3(-1e-3 * std::cos(q), 0.0, 0.0)).norm() < 1e-12);
        }
    }
}

}  // namespace trunnion
