// What readings do not determine stays as declared: along no direction does a fit step because a
// derivative happens not to vanish, and the machine moves for nothing that the set-up explains.
#include "identification/determined.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "identification/identify.h"
#include "tests/support/campaign.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

/// Sphere S1 touched from eight sides at four angles of C, the ball `height_mm` above its centre as
/// declared.
void add_equator(records::ReadingTable& table, const setup::Setup& setup, double height_mm) {
    const setup::Artefact& sphere = *setup.find_artefact("S1");
    const double reach_mm = 0.5 * (sphere.diameter_mm + setup.probe->ball_diameter_mm);
    double time_s = table.rows.empty() ? 0.0 : table.rows.back().time_s + 60.0;
    for (int turn = 0; turn < 4; ++turn)
        for (int k = 0; k < 8; ++k) {
            records::Reading row;
            row.test = "eight azimuths";
            row.feature = "S1";
            row.device = records::Device::touch;
            row.feed_mm_min = 100.0;
            row.time_s = time_s += 10.0;
            row.commanded[Axis::C] = 0.5 * pi * turn;
            campaign::aim(row, setup, sphere.center_W_mm + Vector3(0.0, 0.0, height_mm),
                          setup.probe->tip_S_mm);
            const Vector3 out(std::cos(0.25 * pi * k), std::sin(0.25 * pi * k), 0.0);
            row.commanded[Axis::X] += (reach_mm - 2.0) * out.x();
            row.commanded[Axis::Y] += (reach_mm - 2.0) * out.y();
            row.direction_M = -out;
            table.rows.push_back(row);
        }
}

const identification::FitParameter& parameter(const identification::Identification& found,
                                              const std::string& name) {
    for (const identification::FitParameter& p : found.parameters)
        if (p.name == name) return p;
    throw std::logic_error("no " + name);
}

/// A head-table machine with a tracker on a target of its spindle; C and B stand still.
setup::Setup tracked_machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"ht\"\nchain = \"w C b X Y Z B t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [5, -10, -300]\n"
        "[machine.axis.B]\ndirection = [0, 1, 0]\npoint_mm = [0, 0, 120]\n"
        "[control]\ndialect = \"fanuc\"\n[probe]\ntip_mm = [0, 0, -150]\nball_diameter_mm = 6\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[[instrument]]\nname = \"T\"\norigin_mm = [1500, 200, 600]\nfree = [\"pose\"]\n"
        "[model]\nmodelled = [\"location\"]\nnoise_um = { point = 5.0 }\n",
        "ht.toml", notes);
}

records::ReadingTable tracked_points(const setup::Setup& setup) {
    SeededNoise random(3);
    std::string rows =
        "index,time_s,test,device,feature,x_mm,y_mm,z_mm,c_deg,b_deg,dir_x,dir_y,"
        "dir_z,value_mm,instrument\n";
    for (int k = 0; k < 40; ++k) {
        const double x = 800.0 * random.uniform() - 400.0, y = 600.0 * random.uniform() - 300.0,
                     z = 400.0 * random.uniform() - 200.0;
        for (const char* along : {"1,0,0", "0,1,0", "0,0,1"})
            rows +=
                fmt::format("{},{},P,point,R1,{},{},{},0,0,{},0,T\n", k, 30 * k, x, y, z, along);
    }
    std::vector<std::string> notes;
    return records::parse_readings(rows, "p.csv", notes, setup.machine.chain.names());
}

}  // namespace

TEST_CASE("a derivative that is an accident of the declared point determines nothing",
          "[identification]") {
    const Eigen::Matrix2d information = Eigen::Vector2d(0.06, 1e6).asDiagonal();
    const auto held = [&](const identification::Bend& bend) {
        return identification::curved_directions(information,
                                                 [&](const Eigen::VectorXd&) { return bend; });
    };
    // A bend of 3.6 sigma by a typical step, where the derivative moves the readings by 0.25.
    const Eigen::MatrixXd weak = held({Eigen::Vector2d::Zero(), 3.6 * 3.6, 1.0});
    REQUIRE(weak.cols() == 1);
    CHECK(std::abs(weak(0, 0)) == Approx(1.0));
    CHECK(held({Eigen::Vector2d::Zero(), 1e-6, 1.0}).cols() == 0);
    // The same bend, but the other direction follows it.
    CHECK(held({Eigen::Vector2d(0.0, 3600.0), 3.6 * 3.6, 1.0}).cols() == 0);
}

TEST_CASE("a sum of machine and set-up moves the set-up, a sum within the machine is shared",
          "[identification]") {
    const Eigen::MatrixXd unseen = Eigen::Vector2d(1.0, -1.0).normalized();
    const Eigen::Vector2d step(1.0, 1.0);
    CHECK((identification::steps_beside(unseen, {true, false}) * step - Eigen::Vector2d(0.0, 2.0))
              .norm() < 1e-12);
    CHECK((identification::steps_beside(unseen, {true, true}) * step - step).norm() < 1e-12);
    CHECK((identification::steps_beside(unseen, {false, false}) * step - step).norm() < 1e-12);
    // What moves no reading is no step.
    CHECK((identification::steps_beside(unseen, {true, true}) * unseen).norm() < 1e-12);
}

TEST_CASE("a sphere touched about its equator keeps its declared height, whatever the stylus",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    const double declared_mm = setup.artefacts[0].center_W_mm.z();
    for (const double height_mm : {0.0, 0.003, -0.02}) {
        INFO(height_mm);
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_ballbar(table, setup, 24);
        add_equator(table, setup, height_mm);
        const setup::Setup truth =
            campaign::with_effect(campaign::real_machine(setup), "probe.radius: radius_mm=0.006");
        const records::ReadingTable read = campaign::measured(truth, table, 5);
        const auto found = identification::identify(setup, read, {});
        CHECK(std::isnan(parameter(found, "S1.z_mm").sigma));
        CHECK(found.setup.artefacts[0].center_W_mm.z() == Approx(declared_mm).margin(1e-6));
        CHECK(std::isfinite(parameter(found, "S1.x_mm").sigma));
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read, options);
        CHECK(d.setup.artefacts[0].center_W_mm.z() == Approx(declared_mm).margin(1e-6));
    }
}

TEST_CASE("a tracker on a head that stands still leaves its location as declared",
          "[identification]") {
    const setup::Setup setup = tracked_machine();
    setup::Setup truth = setup;
    truth.instruments[0].pose_error.shift_mm = Vector3(0.24, 1.16, 0.05);
    truth.instruments[0].pose_error.tilt_rad = Vector3(8.3e-4, -9e-5, 0.0);
    records::ReadingTable read = campaign::measured(truth, tracked_points(setup), 7, 6.0);
    const auto found = identification::identify(setup, read, {});
    for (const identification::FitParameter& p : found.parameters) {
        INFO(full_name(p));
        if (!p.location) continue;
        CHECK(std::isnan(p.sigma));
        CHECK(std::abs(p.value) < 1e-9);
    }
    CHECK(parameter(found, "T.y_mm").value.value() == Approx(1.16).margin(0.02));
    CHECK(parameter(found, "T.a_rad").value.value() == Approx(8.3e-4).margin(2e-5));
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, read, {});
    CHECK(d.setup.machine.errors.location(*kinematics::parse_error_name("EA0B")) ==
          Approx(0.0).margin(1e-9));
}

}  // namespace trunnion
