// Each kind of file: what its rows mean.
#include <cmath>

#include "base/units.h"
#include "imports/column_roles.h"
#include "records/iso230_2.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::read_rows;
using import_bench::refuses;

TEST_CASE("a servo log of a mill: command and actual, speeds, columns that are not ours") {
    const auto rows =
        read_rows(import_bench::setup(),
                  {imports::ImportKind::axis_log,
                   "X1_ActualPosition,X1_ActualVelocity,X1_CommandPosition,X1_CommandVelocity,"
                   "X1_CurrentFeedback,S1_CommandPosition,B_cmd,B_act\n"
                   "10.5,99,10.25,20,3.1,0,30,30.002\n11,98,10.75,21,3.2,0,31,31.002\n",
                   {"step_s=0.1"},
                   ""});
    REQUIRE(rows.size() == 4);
    CHECK(rows[0].feature == "X");
    CHECK(*rows[0].value_mm == 0.25);
    CHECK(*rows[0].velocity_mm_s == 20.0);
    CHECK(rows[1].feature == "B");
    CHECK(rows[1].angular);
    CHECK(*rows[1].value_mm == Approx(rad_from_deg(0.002)).epsilon(1e-9));
    CHECK(rows[1].commanded[Axis::X] == 10.25);
    CHECK(rows[2].time_s == Approx(0.1));
}

TEST_CASE("the sign of a following error is told, never guessed") {
    const std::string text = "time [s],X command [mm],X following error [um]\n0,1,5\n";
    const setup::Setup setup = import_bench::setup();
    CHECK(*read_rows(setup, {imports::ImportKind::axis_log, text, {"sign=-"}, ""})[0].value_mm ==
          Approx(-0.005));
    CHECK(*read_rows(setup, {imports::ImportKind::axis_log, text, {"sign=+"}, ""})[0].value_mm ==
          Approx(0.005));
}

namespace {

const std::string matrix =
    "Axis: X\nUnit: um\ntarget [mm];1+;1-;2+;2-\n0;0,0;3,0;0,4;3,4\n100;1,0;5,0;1,4;5,4\n"
    "200;2,0;4,0;2,4;4,4\n";

}  // namespace

TEST_CASE("an ISO 230-2 table comes in from each of its forms") {
    const setup::Setup setup = import_bench::setup();
    const std::string list =
        "position [mm],run,direction,deviation [um]\n0,1,+,0\n100,1,+,1\n200,1,+,2\n200,1,-,4\n"
        "100,1,-,5\n0,1,-,3\n0,2,+,0.4\n100,2,+,1.4\n200,2,+,2.4\n200,2,-,4.4\n100,2,-,5.4\n"
        "0,2,-,3.4\n";
    const std::string order =
        "target [mm],measured [mm]\n0,0\n100,100.001\n200,200.002\n200,200.004\n100,100.005\n"
        "0,0.003\n0,0.0004\n100,100.0014\n200,200.0024\n200,200.0044\n100,100.0054\n0,0.0034\n";
    for (const Case& c : {Case{imports::ImportKind::iso230_2, matrix, {}, ""},
                          Case{imports::ImportKind::iso230_2, list, {"axis=X"}, ""},
                          Case{imports::ImportKind::iso230_2, order, {"axis=X"}, ""}}) {
        INFO(c.text);
        const auto rows = read_rows(setup, c);
        REQUIRE(rows.size() == 12);
        const double um[] = {0, 1, 2, 4, 5, 3, 0.4, 1.4, 2.4, 4.4, 5.4, 3.4};
        const double at[] = {0, 100, 200, 200, 100, 0};
        for (std::size_t k = 0; k < 12; ++k) {
            CHECK(rows[k].device == records::Device::linear);
            CHECK(rows[k].feature == "R1");
            CHECK(rows[k].direction_M == Vector3(1, 0, 0));
            CHECK(rows[k].commanded[Axis::X] == at[k % 6]);
            CHECK(*rows[k].value_mm == Approx(1e-3 * um[k]).margin(1e-9));
        }
        const auto table = import_bench::rows(setup, c);
        const records::Iso230Figures f =
            records::iso230_2_figures(records::deviation_points(table, "X"));
        CHECK(f.reversal_B == Approx(-0.004));
        CHECK(f.mean_reversal == Approx(-0.003));
        CHECK(f.mean_deviation_M == Approx(0.0017).margin(0.0003));
    }
}

TEST_CASE("figures of ISO 230-2 against sums by hand") {
    // Two runs: means 0.2 and 3.2, 1.2 and 5.2, 2.2 and 4.2; every s = 0.4 / sqrt 2 = 0.28284.
    const auto table =
        import_bench::rows(import_bench::setup(), {imports::ImportKind::iso230_2, matrix, {}, ""});
    const records::Iso230Figures f =
        records::iso230_2_figures(records::deviation_points(table, "X"));
    const double s = 0.4e-3 / std::sqrt(2.0);
    REQUIRE(f.targets.size() == 3);
    for (const records::TargetFigures& t : f.targets) CHECK(t.s_up == Approx(s).epsilon(1e-6));
    CHECK(f.reversal_B == Approx(-4e-3).epsilon(1e-6));
    CHECK(f.mean_reversal == Approx(-3e-3).epsilon(1e-6));
    CHECK(f.mean_deviation_M == Approx(1.5e-3).epsilon(1e-6));  // 1.7, 3.2, 3.2
    CHECK(f.systematic_E == Approx(5e-3).epsilon(1e-6));        // 0.2 to 5.2
    CHECK(f.systematic_E_up == Approx(2e-3).epsilon(1e-6));
    CHECK(f.systematic_E_down == Approx(2e-3).epsilon(1e-6));
    CHECK(f.repeatability_R == Approx(4 * s + 4e-3).epsilon(1e-6));
    CHECK(f.repeatability_R_up == Approx(4 * s).epsilon(1e-6));
    CHECK(f.accuracy_A == Approx(5e-3 + 4 * s).epsilon(1e-6));
    CHECK(f.accuracy_A_up == Approx(2e-3 + 4 * s).epsilon(1e-6));
}

TEST_CASE("one run one way has no repeatability and no reversal") {
    const auto table = import_bench::rows(
        import_bench::setup(),
        {imports::ImportKind::iso230_2, "target [mm],1+ [um]\n0,0\n10,1\n20,3\n", {"axis=X"}, ""});
    const records::Iso230Figures f =
        records::iso230_2_figures(records::deviation_points(table, "X"));
    CHECK(f.systematic_E_up == Approx(3e-3));
    CHECK(std::isnan(f.repeatability_R));
    CHECK(std::isnan(f.reversal_B * 0 + f.mean_reversal));
    CHECK(std::isnan(f.accuracy_A_up));
}

TEST_CASE("a rotary axis against an autocollimator, and a table that moves the work") {
    const auto rows =
        read_rows(import_bench::setup(), {imports::ImportKind::iso230_2,
                                          "target [deg],1+ [arcsec],1- [arcsec]\n0,0,1\n90,2,3\n",
                                          {"axis=C", "at=B=30"},
                                          ""});
    REQUIRE(rows.size() == 4);
    CHECK(rows[0].device == records::Device::angle);
    CHECK(rows[0].direction_M == Vector3(0, 0, 1));  // the tool against the table, C turns about -Z
    CHECK(rows[1].commanded[Axis::C] == Approx(pi / 2));
    CHECK(rows[1].commanded[Axis::B] == Approx(pi / 6));
    CHECK(*rows[1].value_mm == Approx(2 * 4.848136811e-6));
}

TEST_CASE("an ISO 230-2 table with its targets across, and one of bare directions") {
    const setup::Setup setup = import_bench::setup();
    const auto across = read_rows(setup, {imports::ImportKind::iso230_2,
                                          "Position [mm];0;100;200\nRun 1 up;0,1;0,3;0,2\n"
                                          "Run 1 down;1,1;1,3;-\nMean up;0,1;0,3;0,2\n",
                                          {"axis=X", "unit=um"},
                                          ""});
    REQUIRE(across.size() == 5);
    CHECK(across[2].commanded[Axis::X] == 200.0);
    CHECK(*across[2].value_mm == Approx(0.2e-3));
    CHECK(across[3].commanded[Axis::X] == 100.0);  // down, and nothing was read at 200
    CHECK(*across[3].value_mm == Approx(1.3e-3));
    const auto bare = read_rows(setup, {imports::ImportKind::iso230_2,
                                        "target [mm],up [um],down [um]\n0,1,2\n10,3,4\nMean,2,3\n",
                                        {"axis=Y"},
                                        ""});
    REQUIRE(bare.size() == 4);
    CHECK(*bare[2].value_mm == Approx(4e-3));
    refuses(setup,
            {imports::ImportKind::iso230_2,
             "Position [mm];0;100;200\nfirst;0,1;0,3;0,2\nRun 1 down;1,1;1,3;2\n",
             {"axis=X"},
             ""},
            "unit of the deviations", 1);
}

TEST_CASE("targets and positions are known by the words of their names") {
    CHECK(read_rows(import_bench::setup(),
                    {imports::ImportKind::iso230_2,
                     "Zeit;Ziel X [mm];Abweichung [um]\n08:00:00;0;1\n08:00:09;10;2\n",
                     {"axis=X"},
                     ""})
              .size() == 2);
    const auto rows = read_rows(import_bench::setup(),
                                {imports::ImportKind::iso230_2,
                                 "No.;Soll-Pos.;Messwert\n1;0;0,001\n2;50;50,003\n3;100;100,002\n"
                                 "4;100;100,004\n5;50;50,006\n6;0;0,004\n",
                                 {"axis=X"},
                                 ""});
    REQUIRE(rows.size() == 6);
    CHECK(rows[4].commanded[Axis::X] == 50.0);
    CHECK(*rows[4].value_mm == Approx(0.006));
    const auto short_names =
        read_rows(import_bench::setup(),
                  {imports::ImportKind::iso230_2, "X [mm],dX [um]\n0,1\n50,2\n", {"axis=X"}, ""});
    CHECK(*short_names[1].value_mm == Approx(0.002));
}

TEST_CASE("each target read three times in passing, the last ones no second pass") {
    const auto rows = read_rows(import_bench::setup(),
                                {imports::ImportKind::iso230_2,
                                 "target [mm],error [um]\n0,1\n0,1\n0,1\n5,2\n5,2\n5,2\n9,3\n9,3\n"
                                 "9,3\n5,4\n5,4\n5,4\n",
                                 {"axis=X"},
                                 ""});
    REQUIRE(rows.size() == 12);
    const auto all = import_bench::rows(
        import_bench::setup(), {imports::ImportKind::iso230_2,
                                "target [mm],error [um]\n0,1\n0,1\n5,2\n5,2\n9,3\n9,3\n9,3\n"
                                "9,3\n5,4\n5,4\n",
                                {"axis=X"},
                                ""});
    int approaches = 0;
    for (const auto& row : all.rows) {
        approaches += row.device == records::Device::none ? 1 : 0;
        CHECK(row.value_mm.has_value() == (row.device != records::Device::none));
    }
    CHECK(approaches == 2);
}

TEST_CASE("pitch and straightness of a slide: an angle about Y, a displacement along Z") {
    const setup::Setup setup = import_bench::setup();
    const std::string text = "target [mm],up,down\n0,0,1\n100,2,3\n";
    const auto pitch = read_rows(
        setup, {imports::ImportKind::iso230_2, text, {"axis=X", "about=Y", "unit=arcsec"}, ""});
    CHECK(pitch[1].device == records::Device::angle);
    CHECK(pitch[1].direction_M == Vector3::UnitY());
    CHECK(*pitch[1].value_mm == Approx(2 * 4.848136811e-6));
    const auto sag = read_rows(
        setup, {imports::ImportKind::iso230_2, text, {"axis=X", "along=Z", "unit=um"}, ""});
    CHECK(sag[1].device == records::Device::linear);
    CHECK(sag[1].direction_M == Vector3::UnitZ());
    CHECK(*sag[1].value_mm == Approx(2e-3));
    refuses(setup, {imports::ImportKind::iso230_2, text, {"axis=X", "about=Y", "unit=um"}, ""},
            "no unit for", 1);
    CHECK_THROWS_AS(
        import_bench::imported(
            setup, {imports::ImportKind::iso230_2, text, {"axis=X", "about=Q", "unit=um"}, ""}),
        InputError);
}

TEST_CASE("columns of axes that have names of their own") {
    AxisNames names;
    names.name = {"Az", "Alt", "", "J1", "J2", "", "", "", ""};
    const std::tuple<const char*, const char*, imports::Role> cases[] = {
        {"Azimuth", "Az", imports::Role::none},
        {"az_obs", "Az", imports::Role::actual},
        {"dAz", "Az", imports::Role::error},
        {"daz", "Az", imports::Role::error},
        {"altitude error", "Alt", imports::Role::error},
        {"joint_2", "J2", imports::Role::none},
        {"A1 cmd", "J1", imports::Role::commanded},
        {"q2", "J2", imports::Role::none}};
    for (const auto& [name, axis, role] : cases) {
        INFO(name);
        const auto found = imports::role_of(name, names);
        REQUIRE(found);
        CHECK(found->axis == axis);
        CHECK(found->role == role);
    }
    CHECK_FALSE(imports::role_of("joint_3", names));
    CHECK_FALSE(imports::role_of("star", names));
}

TEST_CASE("points count from where the control believes the target, whatever errors are known") {
    setup::Setup setup = import_bench::setup();
    const Case c{imports::ImportKind::points,
                 "xnom,ynom,znom,xact,yact,zact\n10,20,-140,10.001,20,-140\n",
                 {},
                 ""};
    const auto before = read_rows(setup, c);
    setup.machine.errors.axis[index_of(Axis::X)].motion[0].slope = 1e-3;
    const auto after = read_rows(setup, c);
    CHECK(*before[0].value_mm == Approx(0.001).margin(1e-12));
    CHECK(*after[0].value_mm == *before[0].value_mm);
    CHECK(after[0].commanded == before[0].commanded);
}

TEST_CASE("ISO 230-2 tables that say too little or too much are refused") {
    const setup::Setup setup = import_bench::setup();
    const auto refused = [&](const std::string& text, std::vector<std::string> told,
                             const std::string& part, int line) {
        refuses(setup, {imports::ImportKind::iso230_2, text, std::move(told), ""}, part, line);
    };
    refused("target [mm],1+ [um]\n0,0\n1,1\n", {}, "which axis", 1);
    refused("target [mm],1+ [um]\n0,0\n1,1\n", {"axis=A"}, "has no axis 'A'", 1);
    refused("target [mm],1+\n0,0\n1,1\n", {"axis=X"}, "unit of '1+' is not told", 1);
    refused("target [mm],laser [um]\n0,0\n1,1\n1,1\n1,1\n0.5,2\n", {"axis=X"}, "out of order", 5);
    refused("target [mm],run,direction,deviation [um]\n0,1,+,0\n2,1,+,0\n1,1,+,0\n", {"axis=X"},
            "out of order within", 4);
    refused("target [mm],run,direction,deviation [um]\n0,1,sideways,0\n", {"axis=X"},
            "direction is", 2);
    refused("where [mm],1+ [um]\n0,0\n", {"axis=X"}, "no column of targets", 1);
}

TEST_CASE("points of a tracker: axis positions from the nominal point, three rows each") {
    const setup::Setup setup = import_bench::setup();
    const auto rows =
        read_rows(setup, {imports::ImportKind::points,
                          "x nominal;y nominal;z nominal;x measured;y measured;z measured\n"
                          "10;20;-140;10,002;19,999;-140,003\n",
                          {},
                          ""});
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].commanded[Axis::X] == Approx(10));
    CHECK(rows[0].commanded[Axis::Z] == Approx(10));  // the target hangs 150 below
    const double um[] = {2, -1, -3};
    for (Eigen::Index d = 0; d < 3; ++d) {
        CHECK(rows[std::size_t(d)].direction_M == Vector3::Unit(d));
        CHECK(*rows[std::size_t(d)].value_mm == Approx(1e-3 * um[d]).margin(1e-10));
    }
    const auto turned =
        read_rows(setup, {imports::ImportKind::points,
                          "machine x,machine y,machine z,B,x,y,z\n1,2,3,30,1,2,-147.001\n",
                          {},
                          ""});
    CHECK(turned[0].commanded[Axis::B] == Approx(pi / 6));
    CHECK(*turned[2].value_mm == Approx(-0.001).margin(1e-10));
    refuses(setup, {imports::ImportKind::points, "x nominal,y nominal\n1,2\n", {}, ""},
            "measured x", 1);
    refuses(setup, {imports::ImportKind::points, "x,y,z\n1,2,3\n", {}, ""}, "nominal x", 1);
}

TEST_CASE("a plate that the table carried, read by a CMM in W") {
    const std::string text = "xnom,ynom,znom,xact,yact,zact\n10,20,-140,10,20.005,-140\n";
    setup::Setup setup = import_bench::setup("w X Y b Z t");
    refuses(setup, {imports::ImportKind::points, text, {}, ""}, "do not move this target", 1);
    setup::Instrument cmm;
    cmm.name = "CMM";
    cmm.sees_table = true;
    setup.instruments.push_back(cmm);
    const auto rows = read_rows(setup, {imports::ImportKind::points, text, {}, ""});
    CHECK(rows[0].instrument == "CMM");
    const Vector3 tip = setup.machine.tip_W(rows[0].commanded, Vector3(0, 0, -150));
    CHECK((tip - Vector3(10, 20, -140)).norm() < 1e-9);
    CHECK(*rows[1].value_mm == Approx(0.005));
}

TEST_CASE("a ballbar's circle: cup positions from angles, times from the feed") {
    const setup::Setup setup = import_bench::setup();
    const auto rows =
        read_rows(setup, {imports::ImportKind::ballbar,
                          "Plane: XY\nFeed: 1200\nDirection: CCW\n"
                          "angle [deg],deviation [um]\n0,1\n90,2\n180,3\n270,-1\n359,0\n",
                          {},
                          ""});
    REQUIRE(rows.size() == 5);
    CHECK(rows[1].commanded[Axis::X] == Approx(75));
    CHECK(rows[1].commanded[Axis::Y] == Approx(110));
    CHECK(rows[1].commanded[Axis::Z] == Approx(230));
    CHECK(*rows[1].value_mm == Approx(0.002));
    CHECK(rows[1].time_s == Approx(0.25 * 2 * pi * 100 / 20));
    CHECK(rows[1].feed_mm_min == 1200);
    const auto lengths = read_rows(setup, {imports::ImportKind::ballbar,
                                           "time [s],radius [mm]\n0,100.001\n1,100.002\n2,100\n",
                                           {"plane=ZX", "sense=cw", "end_deg=-180"},
                                           ""});
    REQUIRE(lengths.size() == 3);
    CHECK(*lengths[1].value_mm == Approx(0.002).margin(1e-12));
    CHECK(lengths[0].commanded[Axis::Z] == Approx(110 + 100 + 120));
    CHECK(lengths[1].commanded[Axis::X] == Approx(75 - 100));
    refuses(setup, {imports::ImportKind::ballbar, "angle,dev [um]\n0,1\n", {}, ""}, "which plane",
            1);
    refuses(setup, {imports::ImportKind::ballbar, "angle,dev [um]\n0,1\n", {"plane=XY"}, ""},
            "which sense", 1);
    refuses(setup,
            {imports::ImportKind::ballbar,
             "angle,dev [um]\n0,1\n1,1\n0.5,1\n",
             {"plane=XY", "sense=ccw"},
             ""},
            "does not rise", 4);
}

TEST_CASE("any table by a map of its columns") {
    const setup::Setup setup = import_bench::setup();
    const std::string map =
        "[columns]\ntime_s = \"when\"\nx_mm = { column = \"pos\", unit = \"um\" }\nb_deg = 30\n"
        "[[reading]]\ndevice = \"linear\"\nfeature = \"R1\"\ndir_x = 1\n"
        "value_mm = { column = \"laser\", minus = \"pos\", unit = \"um\" }\n"
        "[[reading]]\ndevice = \"angle\"\nfeature = \"R1\"\ndir_z = 1\n"
        "value_deg = { column = \"yaw [arcsec]\", unit = \"arcsec\", factor = -1 }\n";
    const std::string text = "when,pos,laser,yaw [arcsec]\n0,1000,1002,1\n1,2000,2003,2\n";
    Case c{imports::ImportKind::table, text, {}, map};
    c.map.replace(c.map.find("yaw [arcsec]\""), 13, "yaw\"");
    const auto rows = read_rows(setup, c);
    REQUIRE(rows.size() == 4);
    CHECK(rows[0].commanded[Axis::X] == Approx(1));
    CHECK(rows[0].commanded[Axis::B] == rad_from_deg(30));
    CHECK(*rows[0].value_mm == Approx(0.002));
    CHECK(*rows[3].value_mm == Approx(-2 * 4.848136811e-6));
    CHECK(rows[3].source == "f.txt:3");
    const auto refused = [&](const std::string& bad, const std::string& part) {
        try {
            import_bench::imported(setup, {imports::ImportKind::table, text, {}, bad});
            FAIL("no error: " + part);
        } catch (const InputError& error) {
            CHECK_THAT(error.message, Catch::Contains(part));
        }
    };
    refused("", "--map");
    refused("[columns]\nb_deg = 3\n", "no [[reading]]");
    refused("[[reading]]\nx_mm = \"position\"\n", "no column 'position'");
    refused("[[reading]]\na_deg = \"pos\"\n", "no axis for a_deg");
    refused("[[reading]]\nvalue_mm = { column = \"pos\", unit = \"deg\" }\n", "no unit for");
    refused("[[reading]]\nvalue_mm = \"pos\"\n", "is not told");
    refused("[[reading]]\ncolour = \"red\"\n", "no column 'colour'");
    refused("[[reading]]\ndevice = \"linear\"\nfeature=\"R1\"\nvalue_mm = 1\n", "unit vector");
}

TEST_CASE("facts are checked") {
    CHECK_THROWS_AS(imports::Facts({"unit"}), InputError);
    CHECK_THROWS_AS(imports::Facts({"colour=red"}), InputError);
    CHECK_THROWS_AS(imports::Facts({"unit=um", "unit=mm"}), InputError);
    CHECK_THROWS_AS(imports::positions_told(import_bench::setup(), "A=3"), InputError);
    CHECK_THROWS_AS(imports::positions_told(import_bench::setup(), "X=abc"), InputError);
    CHECK(imports::positions_told(import_bench::setup(), "X=3 B=-90")[Axis::B] ==
          rad_from_deg(-90));
}
