// The interval of the shrink from its draws, where the model is given.
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/shrink_interval.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Few readings of a machine with one effect, and the model that has it.
struct Bench {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable readings;
    diagnosis::Prepared prepared;
    diagnosis::Whitener whitener;
    diagnosis::Design design;
    diagnosis::FreshReadings fresh;
    diagnosis::Model model;

    Bench(const std::string& injection, double noise_um)
        : readings(measured(setup, injection, noise_um)),
          prepared(diagnosis::prepare(setup, readings)),
          whitener(prepared.replay, prepared.blocks, {}, prepared.base.sigma_mm),
          design(known(), whitener.apply(prepared.base.residual_mm),
                 static_cast<double>(prepared.replay.size())),
          fresh(prepared, 1) {
        diagnosis::add_textbook_groups(design, prepared, whitener);
        const std::string name = injection.substr(0, injection.find(':'));
        std::size_t k = 0;
        while (design.group(k).name != name) ++k;
        model = {{k}, {{5.0}, 1.0}, 0.0};
    }

    std::pair<double, double> interval(const diagnosis::DrawSetting& setting) {
        return diagnosis::ShrinkDraws(design, fresh, {{model, 1.0}}, setting).interval(model);
    }

  private:
    static records::ReadingTable measured(setup::Setup& setup, const std::string& injection,
                                          double noise_um) {
        setup.model.noise_um["sphere"] = noise_um;
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 20, 5);
        const setup::Setup truth = campaign::with_effect(setup, injection);
        return campaign::measured(truth, table, 3, noise_um / 0.8);
    }

    Eigen::MatrixXd known() const {
        Eigen::MatrixXd columns = prepared.base.columns;
        whitener.apply(columns);
        return columns;
    }
};

}  // namespace

TEST_CASE("an effect that is large and well known shrinks the gap, whether others are small or not",
          "[diagnosis]") {
    Bench bench("C.backlash: gap_rad=3e-4", 3.0);
    // Known to a twentieth of its size: only the noise of the fresh readings remains.
    const auto [low, high] = bench.interval({});
    CHECK(low > 0.55);
    CHECK(high > 0.85);
    CHECK(high < 0.97);
}

TEST_CASE("what left-out stretches miss lowers the interval, and nothing missed does not",
          "[diagnosis]") {
    Bench bench("C.backlash: gap_rad=3e-4", 3.0);
    const auto with = [&](const std::vector<diagnosis::Missed>& missed) {
        diagnosis::DrawSetting setting;
        setting.missed = missed;
        return bench.interval(setting);
    };
    const auto each = [&](double square, double noise, double rows, std::size_t count = 20) {
        return with(std::vector<diagnosis::Missed>(count, {square, noise, rows}));
    };
    const double noise_mm2 = std::pow(3e-3, 2);
    const std::pair<double, double> none = each(0.0, 3.0 * noise_mm2, 3.0);
    CHECK(each(27.0 * noise_mm2, 3.0 * noise_mm2, 3.0).first < none.first - 0.1);
    CHECK(each(27.0 * noise_mm2, 3.0 * noise_mm2, 3.0, 2000).first < none.first - 0.1);
    CHECK(each(-noise_mm2, 3.0 * noise_mm2, 3.0) == none);
    CHECK(each(1e-200, 0.0, 0.0) == none);
    CHECK(with({}).first == Approx(none.first).margin(0.1));  // other draws
}

}  // namespace trunnion
