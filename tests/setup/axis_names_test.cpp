// Axes by identity: any names in a chain, kinds from their keys, and what is refused.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "setup/setup.h"

using namespace trunnion;

namespace {

/// A joint turned about `direction`.
std::string joint(const std::string& name, const std::string& direction) {
    return "[machine.axis." + name + "]\ndirection = " + direction + "\npoint_mm = [1, 2, 3]\n";
}

const std::string arm = "[machine]\nname = \"arm\"\nchain = \"w b J1 J2 Q3 J4 t\"\n" +
                        joint("J1", "[0, 0, 1]") + joint("J2", "[0, 1, 0]") +
                        "[machine.axis.Q3]\ndirection = [1, 0, 0]\nlimits_mm = [0, 500]\n" +
                        joint("J4", "[0, 1, 0]") + "limits_deg = [-170, 170]\n" +
                        "[machine.errors]\nEX0J1_mm = 0.5\nEA0J2_rad = 2e-4\n"
                        "EAQ3_rad = { slope = 1e-7 }\n"
                        "[model.calibration]\nEB0J4 = { value_rad = 0, sigma_rad = 1e-4 }\n";

setup::Setup read(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "arm.toml", notes);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a chain with names of its own: slots, kinds, errors, and the way back to text") {
    const setup::Setup setup = read(arm);
    const kinematics::Chain& chain = setup.machine.chain;
    REQUIRE(chain.tool.size() == 4);
    CHECK(chain.tool[2].name == "Q3");
    CHECK_FALSE(chain.tool[2].rotary);
    CHECK(chain.tool[3].rotary);
    const AxisNames names = chain.names();
    CHECK(names.column(chain.tool[0].axis) == "j1_deg");
    CHECK(names.column(chain.tool[2].axis) == "q3_mm");
    CHECK_FALSE(chain.find(Axis::X));  // letters that the chain does not have stay free
    CHECK(setup.machine.errors.location(*kinematics::parse_error_name("EX0J1", names)) == 0.5);
    CHECK(to_string(*kinematics::parse_error_name("EAQ3", names), names) == "EAQ3");
    CHECK_FALSE(kinematics::parse_error_name("EX0C", names));
    CHECK(setup.model.calibration.count("EB0J4") == 1);
    const setup::Setup again = read(setup::format_setup(setup));
    CHECK(setup::format_setup(again) == setup::format_setup(setup));
    AxisPositions q;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        q[axis.axis] = axis.rotary ? 0.7 : 120.0;
    CHECK((setup.machine.tip_W(q, {1, 2, 3}) - again.machine.tip_W(q, {1, 2, 3})).norm() == 0.0);
}

TEST_CASE("letters keep their own slots beside other names") {
    const kinematics::Chain chain = kinematics::parse_chain("w C Tilt b X Y Z Quill t");
    CHECK(chain.find(Axis::X)->name == "X");
    CHECK(chain.find(Axis::C)->name == "C");
    CHECK(chain.work[0].name == "Tilt");
    CHECK_FALSE(is_letter(chain.work[0]));
    CHECK(kinematics::parse_chain("w b J1 J2 J3 J4 J5 J6 J7 J8 J9 t").tool.size() == 9);
}

TEST_CASE("chains and axis tables that are refused, each with its place") {
    struct Bad {
        std::string text, says;
        int line;
    };
    const Bad cases[] = {
        {with(arm, "J2 Q3", "J1 Q3"), "axis J1 stands twice", 3},
        {with(arm, "J2 Q3", "j1 Q3"), "axis j1 stands twice", 3},
        {with(arm, "J2 Q3", "J-2 Q3"), "'J-2' is no name of an axis", 3},
        {with(arm, "J2 Q3", "S Q3"), "'S' is no name of an axis", 3},
        {with(arm, "J2 Q3", "Sigma Q3"), "'Sigma' is no name of an axis", 3},
        {with(arm, "J4 t", "J4 K1 K2 K3 K4 K5 K6 t"), "nine axes at most", 3},
        {with(arm, "direction = [1, 0, 0]\n", ""), "axis Q3 has no direction", 10},
        {with(arm, "limits_mm = [0, 500]", "limits_mm = [0, 500]\npoint_mm = [0, 0, 0]"),
         "this key is for a linear axis, and Q3 is a rotary one", 12},
        {with(arm, "limits_deg", "limits_mm"), "this key is for a linear axis", 16},
        {with(arm, "w b J1", "w b X J1") + "[machine.axis.X]\ndirection = [1, 0, 0]\nlimits_deg = "
                                           "[0, 1]\n",
         "this key is for a rotary axis, and X is a linear one", 25},
        {with(arm, "w b J1", "w b J0 J1"), "axis J0 has no direction", 3},
        {with(arm, "limits_mm = [0, 500]", "limits_deg = [0, 500]"),
         "rotary axis Q3 has no point_mm", 10},
        {with(arm, "EA0J2", "EA0J7"), "'EA0J7_rad' is not an error of ISO 230", 19},
        {with(arm, "EB0J4", "EB0J7"), "'EB0J7' is not an error name", 22},
    };
    for (const Bad& bad : cases) {
        INFO(bad.text);
        try {
            read(bad.text);
            FAIL("accepted: " << bad.says);
        } catch (const InputError& error) {
            CHECK(error.message.find(bad.says) != std::string::npos);
            CHECK(error.where.line == bad.line);
            INFO(error.message);
        }
    }
}
