// Ripples that positions do not resolve, and the sets of stores that explain programmed points:
// what is offered, and what is not.
#include "diagnosis/groups/ripples.h"

#include <catch2/catch.hpp>

#include "diagnosis/stores/store_sets.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Readings with B in `places` positions from -80 to 80 degrees.
records::ReadingTable in_places(const setup::Setup& setup, int places) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    int k = 0;
    for (records::Reading& row : table.rows) {
        if (row.device != records::Device::sphere) continue;
        row.commanded[Axis::B] =
            rad_from_deg(-80.0 + 160.0 * (k++ / 5 % places) / std::max(1, places - 1));
        campaign::aim(row, setup, setup.find_artefact(row.feature)->center_W_mm,
                      setup.probe->tip_S_mm);
    }
    return campaign::measured(setup, table, 7);
}

/// Groups of a design without any after an unresolved ripple of B was offered to it.
std::size_t rivals_added(const setup::Setup& setup, int places) {
    const records::ReadingTable table = in_places(setup, places);
    const diagnosis::Prepared prepared = diagnosis::prepare(setup, table);
    const diagnosis::Whitener whitener(prepared.replay, prepared.blocks, diagnosis::NoiseModel{},
                                       prepared.base.sigma_mm);
    Eigen::MatrixXd columns = prepared.base.columns;
    whitener.apply(columns);
    diagnosis::Design design(columns, whitener.apply(prepared.base.residual_mm),
                             static_cast<double>(columns.rows()));
    const effects::Effect& ripple =
        *effects::find_effect(prepared.catalogue, effects::EffectKind::cyclic, Axis::B);
    std::vector<double> keys = ripple.zeros();
    for (std::size_t j = 0; j < keys.size(); ++j)
        if (ripple.parameters[j].is_key()) keys[j] = 60.0;
    diagnosis::add_unresolved_ripple(design, prepared, whitener, ripple, keys);
    return design.groups().size();
}

diagnosis::PointEquations equations(const Eigen::MatrixXd& columns, const Eigen::VectorXd& change) {
    diagnosis::PointEquations e;
    e.numbers.resize(static_cast<std::size_t>(columns.cols()));
    e.columns = columns;
    e.gram = columns.transpose() * columns;
    e.difference = columns * change;
    e.product = columns.transpose() * e.difference;
    e.square = e.difference.squaredNorm();
    return e;
}

}  // namespace

TEST_CASE("an unresolved ripple is a possible rival from 8 positions on", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    CHECK(rivals_added(setup, 7) == 0);
    CHECK(rivals_added(setup, 8) == 1);
}

TEST_CASE("two numbers that explain the points together are found as one set", "[diagnosis]") {
    SeededNoise noise(4);
    Eigen::MatrixXd columns(30, 5);
    for (double& v : columns.reshaped()) v = noise.normal();
    for (Eigen::Index first = 0; first < 5; ++first)
        for (Eigen::Index second = first + 1; second < 5; ++second) {
            Eigen::VectorXd change = Eigen::VectorXd::Zero(5);
            change(first) = 0.25;
            change(second) = -0.75;
            const auto sets = diagnosis::smallest_sets(equations(columns, change));
            INFO(first << " and " << second);
            REQUIRE(sets.size() == 1);
            CHECK(sets[0].members == std::vector{std::size_t(first), std::size_t(second)});
            CHECK(sets[0].change_mm(0) == Approx(0.25));
            CHECK(sets[0].change_mm(1) == Approx(-0.75));
        }
}

}  // namespace trunnion
