// Keys of an effect beside columns that are fitted again with it.
#include <catch2/catch.hpp>

#include "diagnosis/groups/key_search.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Columns of an effect with given keys, mm for typical sizes.
Eigen::MatrixXd columns_of(const emulator::Replay& replay, const identification::BaseModel& base,
                           const effects::Effect& effect, const std::vector<double>& keys) {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(replay.size()), 0);
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        if (effect.parameters[j].is_key()) continue;
        all.conservativeResize(Eigen::NoChange, all.cols() + 1);
        all.rightCols(1) = identification::effect_column(replay, base.gradient, {effect, keys, j});
    }
    return all;
}

}  // namespace

TEST_CASE("a ripple is found beside a larger one that is fitted again with it", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup);
    const records::ReadingTable readings = campaign::measured(setup, table, 3);
    const emulator::Replay replay(setup, readings);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, readings));
    const identification::BaseModel base =
        identification::fit_base(setup, readings, replay, catalogue, setup.model.modelled);
    const effects::Effect& x = *effects::find_effect(catalogue, "X.cyclic");
    const effects::Effect& y = *effects::find_effect(catalogue, "Y.cyclic");
    const auto with_period = [](const effects::Effect& effect, double period_mm) {
        std::vector<double> values = effect.zeros();
        for (std::size_t j = 0; j < values.size(); ++j)
            if (effect.parameters[j].is_key()) values[j] = period_mm;
        return values;
    };
    const double period_mm = y.parameters.back().grid[90];
    const Eigen::MatrixXd large = columns_of(replay, base, x, with_period(x, 1.2 * period_mm)),
                          small = columns_of(replay, base, y, with_period(y, period_mm));
    Eigen::MatrixXd fitted(large.rows(), base.columns.cols() + large.cols());
    fitted << base.columns, large;
    diagnosis::KeySearch search(replay, base);
    for (const double size : {0.0, 3.0, 10.0, 30.0}) {
        const Eigen::VectorXd left_mm =
            base.residual_mm + size * large.rowwise().sum() + 2.0 * small.col(0);
        const auto found = search.best(y, search.remainder(left_mm, fitted), 1);
        REQUIRE(found.size() == 1);
        CHECK(found[0].back() == period_mm);
    }
}

}  // namespace trunnion
