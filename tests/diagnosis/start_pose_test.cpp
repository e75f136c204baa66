// An instrument that stands anywhere: its pose, however far from the declared one, is found, and
// the errors of the machine with it.
#include "identification/start_pose.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "identification/identify.h"

namespace trunnion {
namespace {

setup::Setup tracked() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"P\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[[instrument]]\nname = \"tracker\"\nframe = \"M\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 3 }\n",
        "s.toml", notes);
}

struct View {
    double turn_deg = 0.0;
    std::string session;
    bool flat = false;  ///< the instrument reads x and y alone
};

/// Rows of a grid on a machine whose X is 40 ppm too long, seen by an instrument turned about an
/// oblique line. The points are computed here, not by the product.
void add_grid(records::ReadingTable& table, const View& view, SeededNoise& noise) {
    const Vector3 line = view.flat ? Vector3::UnitZ() : Vector3(0.3, -0.5, 0.8).normalized();
    const Eigen::AngleAxisd turn(rad_from_deg(view.turn_deg), line);
    for (int k = 0; k < 48; ++k) {
        const Vector3 at(140.0 * (k % 4), 120.0 * (k / 4 % 4), view.flat ? 0.0 : 150.0 * (k / 16));
        const Vector3 machine(at.x() * (1.0 + 40e-6), at.y(), at.z());
        const Vector3 read = turn * machine + Vector3(2500.0, -700.0, view.flat ? 0.0 : 400.0);
        for (int d = 0; d < (view.flat ? 2 : 3); ++d) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * row.index;
            row.test = "grid";
            row.session = view.session;
            row.device = records::Device::point;
            row.feature = "P";
            row.commanded[Axis::X] = at.x();
            row.commanded[Axis::Y] = at.y();
            row.commanded[Axis::Z] = at.z();
            row.direction_M = Vector3::Unit(d);
            row.value_mm = read(d) - at(d) + 3e-3 * noise.normal();
            table.rows.push_back(row);
        }
    }
}

records::ReadingTable grid(const std::vector<View>& views) {
    SeededNoise noise(4);
    records::ReadingTable table;
    table.path = "grid.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (const View& view : views) add_grid(table, view, noise);
    return table;
}

double scale_of(const std::vector<identification::FitParameter>& list) {
    for (const identification::FitParameter& p : list)
        if (p.name == "scale_ppm") return p.value;
    return std::nan("");
}

double rms_um(const setup::Setup& setup, const records::ReadingTable& table) {
    const auto read = emulator::Replay(setup, table).predict(effects::active_models(setup));
    double sum = 0.0;
    for (std::size_t i = 0; i < read.size(); ++i)
        sum += std::pow(1e3 * (*table.rows[i].value_mm - read[i]), 2);
    return std::sqrt(sum / static_cast<double>(read.size()));
}

}  // namespace

TEST_CASE("an instrument turned by any angle: pose, scale and written setup",
          "[identification][start_pose]") {
    for (const double turn_deg : {0.0, 0.2, 20.0, 60.0, 90.0, 150.0, 179.9, 180.0, 270.0}) {
        INFO("turned by " << turn_deg << " deg");
        const records::ReadingTable table = grid({{turn_deg, {}}});
        const auto found = identification::identify(tracked(), table, {"X.scale"});
        CHECK(scale_of(found.parameters) == Approx(40.0).margin(4.0));
        CHECK(found.rms_after_um == Approx(3.0).epsilon(0.15));
        CHECK(rms_um(found.setup, table) == Approx(found.rms_after_um).epsilon(0.01));
        const double turned = rotation_of(found.setup.instruments[0].pose_error.tilt_rad).trace();
        CHECK(turned == Approx(1.0 + 2.0 * std::cos(rad_from_deg(turn_deg))).margin(1e-5));
    }
}

TEST_CASE("a diagnosis finds the scale whatever the instrument's pose", "[diagnosis][start_pose]") {
    for (const double turn_deg : {60.0, 150.0}) {
        const records::ReadingTable table = grid({{turn_deg, {}}});
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(tracked(), table, options);
        REQUIRE(d.causes.size() == 1);
        CHECK(d.causes[0].effect == "X.scale");
        CHECK(scale_of(d.causes[0].parameters) == Approx(40.0).margin(4.0));
        CHECK(rms_um(d.setup, table) < 3.5);
    }
}

TEST_CASE("each session has a pose of its own to start at", "[identification][start_pose]") {
    const records::ReadingTable table = grid({{50.0, "monday"}, {160.0, "tuesday"}});
    const auto found = identification::identify(tracked(), table, {"X.scale"});
    CHECK(scale_of(found.parameters) == Approx(40.0).margin(3.0));
    CHECK(found.rms_after_um == Approx(3.0).epsilon(0.15));
    CHECK(rms_um(found.setup, table) == Approx(found.rms_after_um).epsilon(0.01));
}

TEST_CASE("a plate of two coordinates turned on its table", "[identification][start_pose]") {
    const records::ReadingTable table = grid({{75.0, {}, true}});
    const auto found = identification::identify(tracked(), table, {"X.scale"});
    CHECK(scale_of(found.parameters) == Approx(40.0).margin(4.0));
    CHECK(found.rms_after_um == Approx(3.0).epsilon(0.2));
}

TEST_CASE("the declared pose is kept where points fix no other", "[identification][start_pose]") {
    const setup::Setup setup = tracked();
    records::ReadingTable line = grid({{60.0, {}}});
    line.rows.resize(12);  // four points along X
    const auto kept = identification::with_start_poses(setup, line);
    CHECK(kept.instruments[0].pose_error.is_zero());
    const auto near = identification::with_start_poses(setup, grid({{0.01, {}}}));
    CHECK(near.instruments[0].pose_error.is_zero());
    setup::Setup fixed = setup;
    fixed.instruments[0].free_pose = false;
    const auto declared = identification::with_start_poses(fixed, grid({{60.0, {}}}));
    CHECK(declared.instruments[0].pose_error.is_zero());
}

}  // namespace trunnion
