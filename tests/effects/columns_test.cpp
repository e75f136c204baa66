// Columns of effects against closed forms.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <map>

#include "identification/base_model.h"
#include "records/samples.h"
#include "tests/support/campaign.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

struct Bench {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    Bench() {
        campaign::add_sphere_map(table, setup, 12, 5);
        campaign::add_ballbar(table, setup, 36);
    }
    /// Change of all readings when the effect is switched on, mm.
    std::vector<double> change(const std::string& injection) const {
        const records::ReadingTable off = emulator::predicted(setup, table, {});
        const setup::Setup on_setup = campaign::with_effect(setup, injection);
        const records::ReadingTable on =
            emulator::predicted(on_setup, table, effects::active_models(on_setup));
        std::vector<double> result;
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            result.push_back(off.rows[i].value_mm ? *on.rows[i].value_mm - *off.rows[i].value_mm
                                                  : 0.0);
        return result;
    }
    Vector3 bar_M(const records::Reading& row) const {
        const kinematics::MachinePose poses = setup.machine.poses(row.commanded);
        const setup::Artefact& pivot = *setup.find_artefact("P1");
        return (poses.pose_MS * setup.ballbar->cup_S_mm - poses.pose_MW * pivot.center_W_mm)
            .normalized();
    }
};

}  // namespace

TEST_CASE("squareness on an XY circle is -(R beta / 2) sin 2 theta up to set-up", "[effects]") {
    const Bench bench;
    const double beta = 4e-5;
    const auto change = bench.change("XY.squareness: angle_rad=4e-5");
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.test.rfind("plane0", 0) != 0) continue;
        const Vector3 bar = bench.bar_M(row);
        // Y leans towards -X by beta about Z: the cup moves by -beta y along X.
        REQUIRE(change[i] == Approx(-beta * row.commanded[Axis::Y] * bar.x()).margin(1e-7));
    }
}

TEST_CASE("servo mismatch flips with the sense of travel and grows with the feed", "[effects]") {
    const Bench bench;
    const auto change = bench.change("servo.mismatch: tau_x_s=1e-3, tau_y_s=0.5e-3");
    double slow = 0.0, fast = 0.0;
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.test.rfind("plane0_ccw", 0) != 0) continue;
        const Vector3 bar = bench.bar_M(row);
        // s F (tau_x - tau_y) / 2 sin 2 theta along the bar, measured outwards.
        const double feed = row.feed_mm_min / 60.0;
        const double expected = feed * (1e-3 - 0.5e-3) * bar.x() * bar.y();
        if (i > 0 && i + 1 < bench.table.rows.size() && bench.table.rows[i - 1].test == row.test &&
            bench.table.rows[i + 1].test == row.test)
            REQUIRE(change[i] == Approx(expected).margin(3e-4));
        (row.feed_mm_min < 2000 ? slow : fast) =
            std::max(row.feed_mm_min < 2000 ? slow : fast, std::abs(change[i]));
    }
    REQUIRE(fast == Approx(4.0 * slow).epsilon(0.05));
}

TEST_CASE("contour lag shrinks circles with the square of the feed", "[effects]") {
    const Bench bench;
    const auto change = bench.change("servo.contour: lag2_s2=1e-4");
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.test.rfind("plane", 0) != 0) continue;
        const double feed = row.feed_mm_min / 60.0;
        REQUIRE(change[i] == Approx(-1e-4 * feed * feed / 100.0).epsilon(0.08));
    }
}

TEST_CASE("backlash shifts by half the gap on the side it comes from", "[effects]") {
    const Bench bench;
    const auto change = bench.change("X.backlash=6um");
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.device == records::Device::sphere) REQUIRE(change[i] == 0.0);
        if (row.test.rfind("plane0", 0) != 0) continue;
        const Vector3 bar = bench.bar_M(row);
        REQUIRE(std::abs(change[i]) <= 0.003 * std::abs(bar.x()) + 1e-6);
    }
}

TEST_CASE("a backlash over the place is at each place the backlash of that gap", "[effects]") {
    const Bench bench;
    setup::Setup on = bench.setup;
    on.gap[index_of(Axis::X)].at = {-1000.0, 1000.0};
    on.gap[index_of(Axis::X)].value = {-0.1, 0.1};  // 0.1 um a mm
    const auto gap = bench.change("X.backlash=1um");
    const auto read = emulator::predicted(on, bench.table, effects::active_models(on));
    const auto off = emulator::predicted(bench.setup, bench.table, {});
    double most = 0.0;
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        if (!off.rows[i].value_mm) continue;
        const double change = *read.rows[i].value_mm - *off.rows[i].value_mm;
        const double at_mm = bench.table.rows[i].commanded[Axis::X];
        CHECK(change == Approx(gap[i] * 0.1 * at_mm).margin(2e-6));
        most = std::max(most, std::abs(change));
    }
    CHECK(most > 1e-3);
}

TEST_CASE("rotary backlash moves the found sphere tangentially", "[effects]") {
    const Bench bench;
    const auto change = bench.change("C.backlash=60urad");
    const auto samples = records::samples_of(bench.table);
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.device != records::Device::sphere) continue;
        AxisPositions turned = row.commanded;
        turned[Axis::C] += 3e-5 * samples[i].travel[index_of(Axis::C)];
        const Vector3 center = bench.setup.find_artefact(row.feature)->center_W_mm;
        const Vector3 moved = bench.setup.machine.poses(turned).pose_MW * center -
                              bench.setup.machine.poses(row.commanded).pose_MW * center;
        REQUIRE(change[i] == Approx(row.direction_M.dot(moved)).margin(1e-9));
    }
}

TEST_CASE("wrong stores move the axes by -e_G and -e_P in their modes only", "[effects]") {
    const Bench bench;
    const auto g54 = bench.change("pivot.g54: dg_mm=[0.01, -0.02, 0.03]");
    const auto p1970x =
        bench.change("pivot.p1970x: dp_mm=[0.01, 0.02, -0.01], dd_mm=[0.02, 0, 0.01]");
    const Vector3 dg(0.01, -0.02, 0.03), dp(0.01, 0.02, -0.01), dd(0.02, 0, 0.01);
    for (std::size_t i = 0; i < bench.table.rows.size(); ++i) {
        const records::Reading& row = bench.table.rows[i];
        if (row.device != records::Device::sphere) continue;
        const Matrix3 rb = rotation_about(-Vector3::UnitY(), row.commanded[Axis::B]);
        const Matrix3 rc = rotation_about(-Vector3::UnitZ(), row.commanded[Axis::C]);
        const Vector3 eg = rb * rc * dg - dg;
        const Vector3 ep = rb * rc * (dp + dd) - (dp + dd) - (rb * dd - dd);
        const bool post = row.mode == PositioningMode::dpp || row.mode == PositioningMode::rtdfo;
        REQUIRE(g54[i] == Approx(post ? row.direction_M.dot(eg) : 0.0).margin(1e-9));
        REQUIRE(p1970x[i] == Approx(post ? 0.0 : row.direction_M.dot(ep)).margin(1e-9));
    }
}

TEST_CASE("every column of the catalogue is what the emulator does", "[effects]") {
    const Bench bench;
    const emulator::Replay replay(bench.setup, bench.table);
    const effects::Catalogue catalogue =
        effects::make_catalogue(bench.setup, effects::extent_of(bench.setup, bench.table));
    const kinematics::ForwardModel forward(bench.setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, forward, {}));
    const std::vector<double> off = replay.predict({});
    for (const effects::Effect& effect : catalogue) {
        for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
            if (effect.parameters[j].is_key()) continue;
            std::vector<double> values = effect.zeros();
            const Eigen::VectorXd column =
                identification::effect_column(replay, gradient, {effect, values, j});
            values[j] = effect.parameters[j].typical;
            const std::vector<double> on = replay.predict({effects::make_model(effect, values)});
            double worst = 0.0, largest = 1e-6;
            for (std::size_t i = 0; i < on.size(); ++i) {
                worst = std::max(worst, std::abs(on[i] - off[i] - column(static_cast<long>(i))));
                largest = std::max(largest, std::abs(column(static_cast<long>(i))));
            }
            INFO(effect.name << " " << effect.parameters[j].name);
            REQUIRE(worst < 2e-3 * largest + 1e-7);
        }
    }
}

namespace {

/// What a tracker that stands on the table reads at some points, mm, on the shipped mill whose
/// table carries X and Y, with an error in its file.
std::vector<double> read_on_mill(const std::string& error, const std::string& injection) {
    std::vector<std::string> notes;
    std::string text = measured::file_text("machines/mill_xy_table.toml");
    text += "\n[machine.errors]\n" + error +
            "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
            "[[instrument]]\nname = \"CMM\"\nframe = \"W\"\n";
    setup::Setup setup = setup::parse_setup(text, "mill.toml", notes);
    if (!injection.empty()) setup = campaign::with_effect(setup, injection);
    std::string rows =
        "index,time_s,test,device,feature,x_mm,y_mm,z_mm,w_mm,dir_x,dir_y,dir_z,value_mm\n";
    int index = 0;
    for (const char* at : {"0,0,0", "100,0,0", "0,100,0", "0,0,100", "-200,150,-80"})
        for (const char* along : {"1,0,0", "0,1,0", "0,0,1"}) {
            rows += fmt::format("{},{},T,point,R1,{},0,{},\n", index, 10 * index, at, along);
            ++index;
        }
    const records::ReadingTable table =
        records::parse_readings(rows, "r.csv", notes, setup.machine.chain.names());
    const emulator::Replay replay(setup, table);
    return replay.predict(setup.machine, identification::offsets_to(replay, setup),
                          effects::active_models(setup));
}

}  // namespace

TEST_CASE("a squareness is the location error of its axis, on a table that moves the other way too",
          "[effects]") {
    // At 10 mrad the line of the axis is shorter by 50 ppm, 10 um of 200 mm.
    const double angle_rad = GENERATE(1e-4, 1e-2);
    std::map<std::string, std::string> names;
    for (const auto& [error, plane] :
         {std::pair("EC0Y_rad", "XY"), std::pair("EA0Z_rad", "YZ"), std::pair("EB0Z_rad", "ZX")})
        names[fmt::format("{} = {}", error, angle_rad)] =
            fmt::format("{}.squareness={}urad", plane, 1e6 * angle_rad);
    const std::vector<double> ideal = read_on_mill("", "");
    for (const auto& [error, injection] : names) {
        const std::vector<double> declared = read_on_mill(error, ""),
                                  injected = read_on_mill("", injection);
        double most = 0.0;
        for (std::size_t i = 0; i < ideal.size(); ++i) {
            INFO(error << " reading " << i);
            CHECK(injected[i] - ideal[i] == Approx(declared[i] - ideal[i]).margin(1e-6));
            most = std::max(most, std::abs(declared[i] - ideal[i]));
        }
        INFO(error);
        CHECK(most > 0.005);
    }
}

TEST_CASE("a structure that drifts moves the spindle side in M, however the heads stand",
          "[effects]") {
    std::vector<std::string> notes;
    const std::string text =
        measured::file_text("machines/head_head.toml") +
        "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n";
    const setup::Setup setup = setup::parse_setup(text, "head.toml", notes);
    const setup::Setup warm =
        campaign::with_effect(setup, "thermal.drift: structure_mm=[0.01, -0.02, 0.03], tau_s=600");
    std::string names, rows;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        names += "," + lower_case(axis.name) + (axis.rotary ? "_deg" : "_mm");
    int index = 0;
    for (const double angle_deg : {0.0, 25.0, -40.0})
        for (const char* along : {"1,0,0", "0,1,0", "0,0,1"}) {
            rows += fmt::format("{},{},T,point,R1", index, 300 * index);
            for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
                rows += fmt::format(",{}", axis.rotary ? angle_deg : 50.0);
            rows += fmt::format(",{},\n", along);
            ++index;
        }
    const records::ReadingTable table = records::parse_readings(
        "index,time_s,test,device,feature" + names + ",dir_x,dir_y,dir_z,value_mm\n" + rows,
        "r.csv", notes, setup.machine.chain.names());
    const emulator::Replay replay(setup, table), later(warm, table);
    const std::vector<double> cold = replay.predict({}),
                              after = later.predict(effects::active_models(warm));
    for (std::size_t i = 0; i < cold.size(); ++i) {
        INFO(i);
        const double grown = -std::expm1(-300.0 * static_cast<double>(i) / 600.0);
        const double drift_mm[] = {0.01, -0.02, 0.03};
        CHECK(after[i] - cold[i] == Approx(grown * drift_mm[i % 3]).margin(1e-6));
    }
}

TEST_CASE("a touch goes along its direction in M, whichever way the axes count", "[effects]") {
    // From 25 mm above the centre of the sphere downwards, and from below upwards.
    for (const char* z : {"0, 0, 1", "0, 0, -1"}) {
        INFO(z);
        const double sense = std::string(z) == "0, 0, 1" ? 1.0 : -1.0;
        std::vector<std::string> notes;
        const setup::Setup setup = setup::parse_setup(
            std::string("[machine]\nchain = \"w b X Y Z t\"\n[machine.axis.Z]\ndirection = [") + z +
                "]\n[probe]\ntip_mm = [0, 0, -150]\nball_diameter_mm = 6\n[[artefact]]\n"
                "name = \"S1\"\ncenter_mm = [0, 0, -150]\ndiameter_mm = 30\n",
            "z.toml", notes);
        // The ball touches 18 mm from the centre.
        const records::ReadingTable table = records::parse_readings(
            fmt::format(
                "index,time_s,test,device,feature,x_mm,y_mm,z_mm,dir_x,dir_y,dir_z,value_mm\n"
                "0,1,T,touch,S1,0,0,{},0,0,-1,\n1,2,T,touch,S1,0,0,{},0,0,1,\n",
                25.0 * sense, -19.5 * sense),
            "r.csv", notes, setup.machine.chain.names());
        const std::vector<double> read = emulator::Replay(setup, table).predict({});
        CHECK(read[0] == Approx(25.0 - 18.0).margin(1e-9));
        CHECK(read[1] == Approx(19.5 - 18.0).margin(1e-9));
    }
}

}  // namespace trunnion
