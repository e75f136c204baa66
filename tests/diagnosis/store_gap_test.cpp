// A store in force that is not the declared one, told by the programmed points (px_mm ..): closed
// forms of the 2021 paper on two table machines, a head by its own arithmetic, and whole runs.
#include "diagnosis/stores/store_gap.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "emulator/replay.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"

namespace trunnion {
namespace {

/// What the control had in force minus what the setup declares, mm.
struct Stores {
    Vector3 dg = Vector3::Zero(), dp = Vector3::Zero(), dd = Vector3::Zero();
    double length = 0.0;
};

bool by_g54(PositioningMode mode) {
    return mode == PositioningMode::dpp || mode == PositioningMode::rtdfo;
}

/// The axes move by -e: eqs. 18 and 19 of the paper, and by the tool length.
Vector3 moved_mm(const setup::Setup& setup, const records::Reading& row, const Stores& s) {
    const Axis first = campaign::tilting(setup);
    const Vector3 about = first == Axis::B ? Vector3::UnitY() : Vector3::UnitX();
    const Matrix3 r1 = Eigen::AngleAxisd(-row.commanded[first], about).matrix();
    const Matrix3 r12 = r1 * Eigen::AngleAxisd(-row.commanded[Axis::C], Vector3::UnitZ()).matrix();
    const Vector3 e = by_g54(row.mode)
                          ? Vector3(r12 * s.dg - s.dg)
                          : Vector3(r12 * (s.dp + s.dd) - (s.dp + s.dd) - (r1 * s.dd - s.dd));
    return -e + s.length * Vector3::UnitZ();
}

/// Both axes through one point, which G54 holds, so that every function may command a point.
setup::Setup declared(const setup::Setup& apart) {
    std::string text = setup::format_setup(apart);
    const auto stores = text.find("[control.parameters]");  // they are derived anew
    if (stores != std::string::npos) text.erase(stores, text.find("\n[", stores) - stores);
    const std::string point = "point_mm = [12, -8, 65]";
    text.replace(text.find(point), point.size(), "point_mm = [12, -8, 20]");
    std::vector<std::string> notes;
    setup::Setup setup = setup::parse_setup(text, "crossing.toml", notes);
    setup.stores.work.standard[0].value = {12.0, -8.0, 20.0};
    setup.stores.tools.tool[1].length_geometry_mm = 150.0;
    return setup;
}

/// A log of a control with these stores: points as programmed, positions in force, what the machine
/// then reads.
records::ReadingTable logged(const setup::Setup& setup, const Stores& stores,
                             const setup::Setup& machine) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    for (records::Reading& row : table.rows) {
        const Vector3 move_mm = moved_mm(setup, row, stores);
        row.point_W_mm = setup.find_artefact(row.feature)->center_W_mm;
        if (row.device == records::Device::none) row.point_W_mm.reset();
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
            row.commanded[axis] += move_mm[static_cast<Eigen::Index>(index_of(axis))];
    }
    table = emulator::predicted(machine, table, effects::active_models(machine));
    SeededNoise noise(11);
    for (records::Reading& row : table.rows)
        if (row.value_mm) *row.value_mm += 8e-4 * noise.normal();
    return table;
}

records::ReadingTable logged(const setup::Setup& setup, const Stores& stores) {
    return logged(setup, stores, setup);
}

double value_of(const diagnosis::Cause& cause, const std::string& name, int component = -1) {
    for (const identification::FitParameter& p : cause.parameters)
        if (p.name == name && p.component == component) return p.value;
    return 0.0;
}

struct Wrong {
    const char *effect, *parameter;
    int component;
    Stores stores;
};

/// Every number that some position shows. 19705 moves nothing: it lies along C. 19701 and 19704 of
/// a BC table do the same, as 19700 and 19703 of an AC table.
std::vector<Wrong> wrong_stores(double size) {
    std::vector<Wrong> list;
    for (int d = 0; d < 3; ++d) {
        const Vector3 v = size * Vector3::Unit(d);
        list.push_back({"pivot.g54", "dg_mm", d, {v, {0, 0, 0}, {0, 0, 0}, 0.0}});
        list.push_back({"pivot.p1970x", "dp_mm", d, {{0, 0, 0}, v, {0, 0, 0}, 0.0}});
        if (d < 2) list.push_back({"pivot.p1970x", "dd_mm", d, {{0, 0, 0}, {0, 0, 0}, v, 0.0}});
    }
    list.push_back({"tool.length", "error_mm", -1, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, -size}});
    return list;
}

bool names_the_other(const diagnosis::Cause& cause, const std::string& name) {
    for (const identification::Inseparable& group : cause.unseen)
        for (const std::string& other : group.names)
            if (other.find(name) != std::string::npos) return true;
    return false;
}

void check_each(const setup::Setup& setup, double size, double within_mm) {
    for (const Wrong& wrong : wrong_stores(size)) {
        const diagnosis::Diagnosis d = diagnosed(setup, logged(setup, wrong.stores));
        CAPTURE(setup.path, wrong.effect, wrong.parameter, wrong.component, size);
        REQUIRE_FALSE(d.causes.empty());
        const diagnosis::Cause& cause = d.causes.front();
        CHECK(cause.effect == wrong.effect);
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(d.after.shrink > 0.95);
        const double found = value_of(cause, wrong.parameter, wrong.component);
        if (found == 0.0)  // its equal stands for it
            CHECK(names_the_other(cause, wrong.parameter));
        else
            CHECK(found == Approx(size).margin(within_mm));
    }
}

records::ReadingTable rounded(records::ReadingTable table) {
    const auto to = [](double value, double step) { return std::round(value / step) * step; };
    for (records::Reading& row : table.rows)
        for (const Axis axis : table.axes)
            row.commanded[axis] =
                to(row.commanded[axis], is_rotary(axis) ? rad_from_deg(1e-3) : 1e-3);
    return table;
}

}  // namespace

TEST_CASE("programmed points name the store in force with its size", "[diagnosis][stores]") {
    check_each(declared(campaign::bc_setup()), 0.050, 1e-9);
    check_each(declared(campaign::ac_setup()), 0.012, 1e-9);
}

namespace {

/// A fork head: C at `c`, A 8 mm beside it, both 180 mm above the gauge point.
Vector3 head_mm(const Vector3& tip, double a_rad, double c_rad, const Vector3& c, double length) {
    const Matrix3 rc = Eigen::AngleAxisd(c_rad, Vector3::UnitZ()).matrix();
    const Matrix3 ra = Eigen::AngleAxisd(a_rad, Vector3::UnitX()).matrix();
    const Vector3 to_a(0.0, 8.0, 0.0), ball(0.0, 0.0, -length);
    return tip - c - rc * (to_a + ra * (ball - c - to_a));
}

records::ReadingTable head_log(const Vector3& c, double length) {
    records::ReadingTable table;
    for (int k = 0; k < 40; ++k) {
        records::Reading row;
        row.device = records::Device::sphere;
        row.mode = PositioningMode::rtcp;
        row.direction_M = Vector3::Unit(k % 3);
        row.point_W_mm = Vector3(60.0, 20.0, -250.0);
        const double a = std::sin(0.7 * k), rotary_c = 0.45 * k - 3.0;
        const Vector3 at = head_mm(*row.point_W_mm, a, rotary_c, c, length);
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
            row.commanded[axis] = at[static_cast<Eigen::Index>(index_of(axis))];
        row.commanded[Axis::A] = a;
        row.commanded[Axis::C] = rotary_c;
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("programmed points of a head: its offsets and the tool's length", "[diagnosis][stores]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/head_head.toml", notes);
    const Vector3 c(0.0, 0.0, 180.0);
    CHECK_FALSE(diagnosis::store_gap(setup, head_log(c, 150.0)));
    const auto beside = diagnosis::store_gap(setup, head_log(c + Vector3(0.0, 0.03, 0.0), 150.0));
    REQUIRE(beside);
    REQUIRE(beside->changes.size() == 1);
    CHECK(beside->changes.front().store.name == "19710");
    CHECK(beside->changes.front().change_mm == Approx(0.03).margin(1e-9));
    const auto longer = diagnosis::store_gap(setup, head_log(c, 150.02));
    REQUIRE(longer);
    REQUIRE(longer->changes.size() == 1);
    CHECK(longer->changes.front().store.name == "H1");
    CHECK(longer->changes.front().change_mm == Approx(0.02).margin(1e-9));
}

TEST_CASE("programmed points agree with the declared stores", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    CHECK_FALSE(diagnosis::store_gap(setup, logged(setup, {})));
    CHECK(diagnosed(setup, logged(setup, {})).verdict == diagnosis::Verdict::no_gap);
    CHECK_FALSE(diagnosis::store_gap(setup, rounded(logged(setup, {}))));
}

TEST_CASE("programmed points of a log with three decimals", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    for (const Wrong& wrong : wrong_stores(0.02)) {
        const auto gap = diagnosis::store_gap(setup, rounded(logged(setup, wrong.stores)));
        CAPTURE(wrong.effect, wrong.parameter, wrong.component);
        REQUIRE(gap);
        REQUIRE(gap->changes.size() == 1);
        CHECK(std::abs(gap->changes.front().change_mm) == Approx(0.02).margin(1e-3));
    }
}

TEST_CASE("an error of the machine and a store are both named", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    setup::Setup machine = setup;
    machine.effects.push_back({"C.backlash", {{"gap_rad", {1.2e-4}}}});
    Stores stores;
    stores.dd = {0.03, 0.0, 0.0};
    stores.dg = {0.0, 0.0, -0.02};
    const diagnosis::Diagnosis d = diagnosed(setup, logged(setup, stores, machine));
    REQUIRE(d.causes.size() == 3);
    CHECK(d.verdict == diagnosis::Verdict::explained);
    double share = 0.0;
    for (const diagnosis::Cause& cause : d.causes) {
        share += cause.share;
        if (cause.effect == "pivot.p1970x")
            CHECK(value_of(cause, "dd_mm", 0) == Approx(0.03).margin(1e-9));
        else if (cause.effect == "pivot.g54")
            CHECK(value_of(cause, "dg_mm", 2) == Approx(-0.02).margin(1e-9));
        else
            CHECK(cause.effect == "C.backlash");
    }
    CHECK(share == Approx(1.0).margin(0.1));
    // The setup that is written declares what was in force.
    CHECK_FALSE(diagnosis::store_gap(d.setup, logged(setup, stores)));
}

TEST_CASE("programmed points that no store explains are unknown", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    records::ReadingTable table = logged(setup, {});
    for (std::size_t k = 0; k < table.rows.size(); k += 7)
        if (table.rows[k].point_W_mm) table.rows[k].point_W_mm->x() += 0.2;
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    REQUIRE_FALSE(d.causes.empty());
    CHECK(d.causes.front().effect == "unknown");
    CHECK(d.verdict == diagnosis::Verdict::unexplained);
}

// 19701 and 19704 of a BC table do the same: of five wrong numbers only the sum of these is told.
TEST_CASE("of many wrong stores what no point tells apart is said", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    Stores stores;
    stores.dg = {0.03, 0.02, -0.04};
    stores.dp = {0.05, 0.02, 0.0};
    stores.length = 0.03;
    const records::ReadingTable table = logged(setup, stores);
    const auto gap = diagnosis::store_gap(setup, table);
    REQUIRE(gap);
    CHECK(gap->changes.size() > 4);
    CHECK(std::sqrt(diagnosis::mean_square_of(gap->before_um)) > 10.0);
    CHECK(std::sqrt(diagnosis::mean_square_of(gap->after_um)) < 1e-3);
    REQUIRE(gap->unseen.size() == 1);
    CHECK(gap->unseen.front().names ==
          std::vector<std::string>{"pivot.p1970x.dp_mm[y]", "pivot.p1970x.dd_mm[y]"});
    for (const diagnosis::StoreChange& change : gap->changes) {
        const bool told = change.store.name != "19701" && change.store.name != "19704";
        CHECK(std::isnan(change.sigma_mm) != told);
    }
    CHECK_FALSE(diagnosis::store_gap(with_stores(setup, *gap), table));
}

TEST_CASE("without a probe or points nothing is said of stores", "[diagnosis][stores]") {
    setup::Setup setup = declared(campaign::bc_setup());
    Stores stores;
    stores.dg = {0.03, 0.0, 0.0};
    records::ReadingTable table = logged(setup, stores);
    REQUIRE(diagnosis::store_gap(setup, table));
    CHECK_FALSE(diagnosis::points_um(setup, table).empty());
    setup.probe.reset();
    CHECK_FALSE(diagnosis::store_gap(setup, table));
    CHECK(diagnosis::points_um(setup, table).empty());
    setup = declared(campaign::bc_setup());
    SECTION("no point") {
        for (records::Reading& row : table.rows) row.point_W_mm.reset();
    }
    SECTION("a point under no function") {
        for (records::Reading& row : table.rows) row.mode = PositioningMode::none;
    }
    CHECK_FALSE(diagnosis::store_gap(setup, table));
    CHECK(diagnosis::points_um(setup, table).empty());
}

TEST_CASE("programmed points of rows held out", "[diagnosis][stores]") {
    const setup::Setup setup = declared(campaign::bc_setup());
    Stores stores;
    stores.dp = {0.04, 0.0, 0.0};
    const records::ReadingTable table = logged(setup, stores), holdout = logged(setup, stores);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    options.holdout = &holdout;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table, options);
    CHECK(d.after.rms_before_um > 10.0);
    CHECK(d.after.rms_after_um == Approx(0.8).margin(0.1));
    CHECK(d.after.shrink > 0.95);
}

}  // namespace trunnion
