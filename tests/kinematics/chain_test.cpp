// The text of a chain: what it may say, and what each axis becomes.
#include "kinematics/chain.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"

namespace trunnion {

TEST_CASE("a chain that cannot be read is refused") {
    for (const char* text :
         {"", "w t", "w b", "b X t", "w X b Y", "w X Y t", "X b Y t", "w X b x t", "w J1 b j1 t",
          "w 1J b t", "w J-1 b t", "w [ b t", "w J{ b t", "w S b t", "w PX b t", "w Sigma b t",
          "w X Y Z A B b C U V W J1 t"}) {
        INFO(text);
        CHECK_THROWS_AS(kinematics::parse_chain(text), InputError);
    }
}

TEST_CASE("axes without an ISO letter take the last free slots, in the order of the text") {
    const kinematics::Chain chain = kinematics::parse_chain("w b X J1 j2 s t");
    REQUIRE(chain.tool.size() == 4);
    CHECK(chain.tool[0].axis == Axis::X);
    CHECK(chain.tool[1].axis == Axis::U);
    CHECK(chain.tool[2].axis == Axis::V);
    CHECK(chain.tool[3].axis == Axis::W);
    CHECK(kinematics::is_letter(chain.tool[0]));
    for (std::size_t k = 1; k < 4; ++k) CHECK_FALSE(kinematics::is_letter(chain.tool[k]));
    CHECK(chain.names().name[index_of(Axis::V)] == "j2");
    CHECK(kinematics::parse_chain("w X Y Z A B b C U V W t").axes().size() == 9);
}

TEST_CASE("a name of an axis is a letter, then letters and digits") {
    for (const std::string name : {"J0", "J9", "j10", "Az", "aZ9"}) {
        const kinematics::Chain chain = kinematics::parse_chain("w X b " + name + " t");
        CHECK(chain.tool.front().name == name);
    }
    for (const std::string name :
         {"1J", "J_1", "J-1", "J:", "J/", "J@", "J[", "J`", "J{", "\xc3\xa4"}) {
        INFO(name);
        CHECK_THROWS_AS(kinematics::parse_chain("w X b " + name + " t"), InputError);
    }
}

TEST_CASE("A, B and C turn, the side of the work against the tool") {
    const kinematics::Chain chain = kinematics::parse_chain("w C b A X t");
    CHECK(chain.work[0].rotary);
    CHECK(chain.tool[0].rotary);
    CHECK_FALSE(chain.tool[1].rotary);
    const AxisNames names = chain.names();
    CHECK(names.rotary[index_of(Axis::C)]);
    CHECK_FALSE(names.rotary[index_of(Axis::X)]);
    CHECK(names.name[index_of(Axis::B)].empty());
}

}  // namespace trunnion
