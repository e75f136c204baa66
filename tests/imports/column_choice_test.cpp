// Which column is the value where several could be, and names that tell no axis or count in hours.
#include <algorithm>

#include "base/units.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto iso = imports::ImportKind::iso230_2;
constexpr auto log_kind = imports::ImportKind::axis_log;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

/// The deviation at the last target, and whether a note has `part`.
void takes(const Case& c, double value_mm, const std::string& part) {
    INFO(c.text << c.told.back());
    const setup::Setup setup = import_bench::setup();
    CHECK(*read_rows(setup, c).back().value_mm == Approx(value_mm));
    CHECK(has(imported(setup, c).notes, part));
}

setup::Setup mount() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b HA Dec t\"\n"
        "[machine.axis.HA]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.Dec]\ndirection = [1, 0, 0]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"sky\"\nkind = \"target\"\ntool_mm = [1000, 0, 0]\n",
        "s.toml", notes);
}

}  // namespace

TEST_CASE("the very word for the value comes before other words for it", "[imports][choice]") {
    const std::string rows = "1,10,10.001,1,10.007,7\n2,20,20.002,2,20.008,8\n";
    const auto named = [&](const std::string& columns) {
        return Case{iso, rows, {"axis=X", "columns=" + columns}, ""};
    };
    takes(named("n,target [mm],resolver [mm],dr,value [mm],dv"), 0.008,
          "'value' taken as the value, not 'resolver'");
    takes(named("n,target [mm],diff [um],q,value [mm],p"), 0.008,
          "'value' taken as the value, not 'diff'");
    takes(named("n,target [mm],resolver [mm],deviation [um],value [mm],p"), 0.002,
          "'deviation' taken as the value, not 'resolver', 'value'");
    // The letter of "reverse" beside it is no pass.
    takes(named("n,target [mm],r [mm],dr,value [mm],dv"), 0.008,
          "'value' taken as the value, not 'r'");
    CHECK_FALSE(has(imported(import_bench::setup(), named("n,target [mm],q,p,value [mm],o")).notes,
                    "taken as the value"));
}

TEST_CASE("columns of one name are refused only if one of them is needed", "[imports][choice]") {
    const std::string rows = "1,10,10.001,1,10.007,7\n2,20,20.002,2,20.008,8\n";
    takes({iso,
           "n,target [mm],encoder [mm],diff [um],camera [mm],diff [um]\n" + rows,
           {"axis=X"},
           ""},
          0.002, "'encoder' taken as the value, not 'diff', 'diff'");
    refuses(import_bench::setup(),
            {iso, "n,target [mm],q [mm],diff [um],p [mm],diff [um]\n" + rows, {"axis=X"}, ""},
            "'diff' and 'diff' could both be the value", 1);
    refuses(import_bench::setup(),
            {iso, "n,target [mm],error [um],diff [um],target [mm],m\n" + rows, {"axis=X"}, ""},
            "'target' and 'target' hold the same", 1);
}

TEST_CASE("names of a motor tell no axis: --with axis= does", "[imports][choice]") {
    const setup::Setup setup = import_bench::setup();
    for (const std::string names : {"t,m3_goal,m3_pos,m3_speed,m3_err",
                                    "t,MotorCmdPos#0,MotorFbPos#0,MotorFbVel#0,MotorErr#0",
                                    "Try/t,Try/MotorCmdPos#0,Try/MotorFbPos#0,Try/Kp#0,Try/T#0"}) {
        const Case c{log_kind, names + "\n0,1,1.5,7,0\n1,2,2.25,7,0\n", {"axis=C"}, ""};
        INFO(names);
        const auto rows = read_rows(setup, c);
        REQUIRE(rows.size() == 2);
        CHECK(rows[1].time_s == 1.0);
        CHECK(rows[1].commanded[Axis::C] == Approx(rad_from_deg(2.0)));
        CHECK(*rows[1].value_mm == Approx(rad_from_deg(0.25)));
        CHECK_FALSE(rows[1].velocity_mm_s.has_value());
        CHECK(has(imported(setup, c).notes, "is not used"));
    }
    refuses(setup, {log_kind, "t,m3_goal,m3_pos\n0,1,1\n1,2,2\n", {}, ""}, "--with axis=", 1);
    refuses(setup, {log_kind, "t,m1_goal,m1_pos,m2_goal\n0,1,1,1\n1,2,2,2\n", {"axis=C"}, ""},
            "a second column", 1);
    // Names that tell the axis come first: the motor's own encoder is not asked.
    const Case both{log_kind, "t,cmd,act,motor act\n0,1,1.5,9\n1,2,2.25,9\n", {"axis=C"}, ""};
    CHECK(*read_rows(setup, both)[1].value_mm == Approx(rad_from_deg(0.25)));
}

TEST_CASE("hours of an angle are 15 degrees, where its own column says so", "[imports][choice]") {
    const auto imported_rows = [](const Case& c) {
        std::vector<std::string> notes;
        const setup::Setup setup = mount();
        return records::parse_readings(imported(setup, c).readings, "r.csv", notes,
                                       setup.machine.chain.names())
            .rows;
    };
    const std::string rows = "1.5,1.502,30,30.01\n-2.0,-1.999,40,40\n";
    const auto hours = imported_rows({imports::ImportKind::pointing,
                                      "HA cmd [h],HA act [h],Dec cmd [deg],Dec act [deg]\n" + rows,
                                      {},
                                      ""});
    const auto degrees = imported_rows({imports::ImportKind::pointing,
                                        "HA cmd [deg],HA act [deg],Dec cmd [deg],Dec act [deg]\n"
                                        "22.5,22.53,30,30.01\n-30.0,-29.985,40,40\n",
                                        {},
                                        ""});
    REQUIRE(hours.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) CHECK(*hours[k].value_mm == Approx(*degrees[k].value_mm));
    const auto parts = imported_rows(
        {imports::ImportKind::pointing,
         "HA cmd [h],HA act [h],Dec cmd [deg],Dec act [deg]\n"
         "01:30:00,01:30:07.2,+30:00:00,30:00:36\n-02:00:00,-1:59:56.4,40:00:00,40.0\n",
         {},
         ""});
    REQUIRE(parts.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) CHECK(*parts[k].value_mm == Approx(*hours[k].value_mm));
    for (const char* wrong : {"01:60:00", "01:30", "1:2:3:4", "1::3", "1:-2:3", "+-1:2:3"})
        refuses(mount(),
                {imports::ImportKind::pointing,
                 "HA cmd [h],HA act [h],Dec cmd [deg],Dec act [deg]\n1.5,1.502,30,30\n" +
                     std::string(wrong) + ",1,30,30\n",
                 {},
                 ""},
                wrong, 3);
    // A declination without a unit beside it would be in hours too.
    refuses(
        mount(),
        {imports::ImportKind::pointing, "HA cmd,HA act,Dec cmd,Dec act\n" + rows, {"unit=h"}, ""},
        "'h' is no unit for 'HA cmd'", 1);
    refuses(import_bench::setup(), {log_kind, "t,X cmd [h],X act [h]\n0,1,1\n1,2,2\n", {}, ""},
            "'h' is no unit for 'X cmd'", 1);
}
