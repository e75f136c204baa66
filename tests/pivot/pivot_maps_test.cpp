// The model of the maps against the paper's closed forms, written here once more.
#include "pivot/pivot_maps.h"

#include <catch2/catch.hpp>

#include "pivot_bench.h"

using namespace trunnion;
using namespace trunnion::pivot_bench;

namespace {

Matrix3 turn_of(const offsets::PivotAxis& axis, double deg) {
    return rotation_about(axis.direction(), rad_from_deg(deg));
}

struct StoreErrors {
    Vector3 dg, dp, dd;
};

/// e_G and e_P of docs/notation.md for two axes under the table: with the sphere found at home.
Vector3 table_form(const setup::RotaryStores& s, const StoreErrors& off, bool g54, double first,
                   double second) {
    const auto& [dg, dp, dd] = off;
    const Matrix3 r1 = turn_of(s.pivot.first, first), r2 = turn_of(s.pivot.second, second),
                  one = Matrix3::Identity();
    if (g54) return (r1 * r2 - one) * dg;
    return (r1 * r2 - one) * (dp + dd) - (r1 - one) * dd;
}

}  // namespace

TEST_CASE("the model's errors are the paper's closed forms on every table of two axes") {
    SeededNoise noise(3);
    for (const char* file : {"bc_table.toml", "ac_trunnion.toml", "nutating_table.toml"}) {
        const setup::Setup setup = load(file);
        const setup::RotaryStores right = true_stores(setup);
        for (int i = 0; i < 100; ++i) {
            const Vector3 dg = random_vector(noise, 0.2), dp = random_vector(noise, 0.2),
                          dd = random_vector(noise, 0.2);
            setup::RotaryStores s = right;
            s.g54 += dg;
            s.pivot.table_point_mm += dp;
            s.pivot.table_offset_mm += dd;
            const pivot::PivotModel model(setup.machine, s, random_vector(noise, 150.0),
                                          {0, 0, -150});
            const double b = 50.0 * noise.normal(), c = 150.0 * noise.normal();
            for (const bool g54 : {true, false})
                CHECK((model.error_mm(g54 ? pivot::PivotGroup::g54 : pivot::PivotGroup::p1970x, b,
                                      c) -
                       table_form(s, {dg, dp, dd}, g54, b, c))
                          .norm() < 1e-9);
        }
    }
}

TEST_CASE("axes that pass each other leave (R1 - 1) times the step to G54's functions") {
    setup::Setup setup = load("bc_table.toml");
    setup.machine.errors.axis[index_of(Axis::C)].location[0] = 0.08;
    const setup::RotaryStores right = true_stores(setup);
    const Vector3 step = setup::step_between_axes_mm(right);
    CHECK((step - Vector3(0.08, 0, 0)).norm() < 1e-12);
    const pivot::PivotModel model(setup.machine, right, {120, 0, 80}, {0, 0, -150});
    for (const double b : {-70.0, 20.0, 90.0}) {
        const Vector3 e = model.error_mm(pivot::PivotGroup::g54, b, 135.0);
        const Matrix3 r1 = turn_of(right.pivot.first, b);
        CHECK((e - (r1 - Matrix3::Identity()) * step).norm() < 1e-9);
        CHECK(model.error_mm(pivot::PivotGroup::p1970x, b, 135.0).norm() < 1e-9);
    }
}

TEST_CASE("heads: wrong 19709-19714 lead to (1 - R) dt + (R - R1) ds") {
    SeededNoise noise(5);
    const setup::Setup setup = load("head_head.toml");
    const setup::RotaryStores right = true_stores(setup);
    const Matrix3 one = Matrix3::Identity();
    for (int i = 0; i < 100; ++i) {
        const Vector3 dt = random_vector(noise, 0.2), ds = random_vector(noise, 0.2);
        setup::RotaryStores s = right;
        s.pivot.tool_offset_mm += dt;
        s.pivot.tool_second_offset_mm += ds;
        const pivot::PivotModel model(setup.machine, s, {60, 20, -250}, {0, 0, -150});
        const double c = 100.0 * noise.normal(), a = 40.0 * noise.normal();
        const Matrix3 r1 = turn_of(s.pivot.first, c), r = r1 * turn_of(s.pivot.second, a);
        // The axes went to minus what the swing was wrong by, so the sphere is found there.
        const Vector3 expected = (one - r) * dt + (r - r1) * ds;
        CHECK((model.error_mm(pivot::PivotGroup::p1970x, c, a) - expected).norm() < 1e-9);
    }
}

TEST_CASE("the circle of an arc has its centre and the turning vector") {
    // r_G = |P_z dg| on a C arc; r_P = |P_y dp| on a B arc at C0 (facts of pivot 2021).
    const setup::Setup setup = load("bc_table.toml");
    setup::RotaryStores s = true_stores(setup);
    const Vector3 dg(0.12, -0.2, 0.15), dp(0.1, 0.02, -0.14);
    s.g54 += dg;
    s.pivot.table_point_mm += dp;
    const pivot::PivotModel model(setup.machine, s, {90, 20, 60}, {0, 0, -150});
    pivot::PivotMap map;
    map.first_moves = false;
    std::vector<pivot::PivotPoint> c_arc, b_arc;
    for (int i = 0; i < 24; ++i)
        c_arc.push_back({0.0, 15.0 * i, model.error_mm(pivot::PivotGroup::g54, 0.0, 15.0 * i)});
    const pivot::ErrorCircle circle = fit_circle(map, c_arc, pivot::moving_axis_M(s.pivot, map));
    CHECK(circle.radius_mm() == Approx(std::hypot(0.12, 0.2)).margin(1e-9));
    CHECK((circle.centre_mm + Vector3(0.12, -0.2, 0)).norm() < 1e-9);
    map.first_moves = true;
    for (int i = 0; i < 13; ++i) {
        const double b = -90.0 + 15.0 * i;
        b_arc.push_back({b, 0.0, model.error_mm(pivot::PivotGroup::p1970x, b, 0.0)});
    }
    CHECK(fit_circle(map, b_arc, pivot::moving_axis_M(s.pivot, map)).radius_mm() ==
          Approx(std::hypot(0.1, 0.14)).margin(1e-9));
    CHECK(fit_circle(map, {c_arc[0], c_arc[1]}, Vector3::UnitZ()).radius_mm() == 0.0);
}

TEST_CASE("tilts of the axes are part of what is expected") {
    setup::Setup setup = load("bc_table.toml");
    setup.machine.errors.axis[index_of(Axis::B)].location[3] = 1e-4;  // EA0B
    enter(true_stores(setup), setup);
    const pivot::PivotModel model(setup.machine,
                                  *setup::rotary_stores(setup.machine.chain, setup.stores),
                                  {120, 0, 80}, {0, 0, -150});
    CHECK(model.error_mm(pivot::PivotGroup::p1970x, 90.0, 0.0).norm() > 3e-3);
}
