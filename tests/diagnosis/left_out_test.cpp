// Left-out residuals against plain fits without the rows.
#include "diagnosis/search/left_out.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "diagnosis/search/heldout.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

Eigen::MatrixXd random_matrix(SeededNoise& random, Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index c = 0; c < columns; ++c)
        for (Eigen::Index r = 0; r < rows; ++r) m(r, c) = random.normal();
    return m;
}

/// `blocks` groups of equal size, one after the other.
diagnosis::Folds folds_of(int rows, int blocks) {
    diagnosis::Folds folds;
    for (int i = 0; i < rows; ++i) folds.group.push_back(i * blocks / rows);
    for (int b = 0; b < blocks; ++b) folds.fold.push_back(b % diagnosis::Folds::count);
    return folds;
}

}  // namespace

// With fewer blocks than folds a fold has no rows. Eigen (3.4) divides by their number as soon as a
// product has 48 columns: SIGFPE.
TEST_CASE("left-out residuals are those of fits without the rows, in few blocks and in many",
          "[diagnosis]") {
    SeededNoise random(3);
    constexpr int rows = 120, columns = 60;
    const Eigen::MatrixXd known = random_matrix(random, rows, columns);
    const Eigen::VectorXd data = random_matrix(random, rows, 1);
    for (const auto& [blocks, empty] : {std::pair(2, 0), {2, 2}, {4, 0}, {5, 0}, {24, 0}}) {
        INFO(blocks << " blocks, " << empty << " folds between them without any");
        diagnosis::Folds folds = folds_of(rows, blocks);
        if (empty > 0) folds.fold = {0, 1 + empty};
        diagnosis::Design design(known, data, rows);
        const diagnosis::LeftOut left(design, {}, folds, std::vector<bool>(rows, true));
        const Eigen::VectorXd residual = left.residual({}, {});
        double surprise = 0.0;
        for (int fold = 0; fold < diagnosis::Folds::count; ++fold) {
            std::vector<Eigen::Index> out, in;
            for (int i = 0; i < rows; ++i)
                (folds.fold[static_cast<std::size_t>(folds.group[static_cast<std::size_t>(i)])] ==
                         fold
                     ? out
                     : in)
                    .push_back(i);
            if (out.empty()) continue;
            // A weak prior is one more reading of zero for each column: sigma 20.
            Eigen::MatrixXd all(static_cast<Eigen::Index>(in.size()) + columns, columns);
            all << known(in, Eigen::all), Eigen::MatrixXd::Identity(columns, columns) / 20.0;
            Eigen::VectorXd read = Eigen::VectorXd::Zero(all.rows());
            read.head(static_cast<Eigen::Index>(in.size())) = data(in);
            const Eigen::VectorXd x = all.colPivHouseholderQr().solve(read);
            const Eigen::VectorXd expected = data(out) - known(out, Eigen::all) * x;
            CHECK((residual(out) - expected).norm() < 1e-9 * expected.norm());
            const Eigen::MatrixXd uncertain =
                Eigen::MatrixXd::Identity(expected.size(), expected.size()) +
                known(out, Eigen::all) * (all.transpose() * all).inverse() *
                    known(out, Eigen::all).transpose();
            surprise += expected.dot(uncertain.ldlt().solve(expected));
        }
        CHECK(left.surprise() == Approx(surprise).epsilon(1e-8));
    }
}

TEST_CASE("what left-out readings miss is chi-squared, however little the others determine",
          "[diagnosis]") {
    SeededNoise random(8);
    constexpr int rows = 60, columns = 20;
    double sum = 0.0;
    constexpr int draws = 200;
    for (int draw = 0; draw < draws; ++draw) {
        Eigen::MatrixXd known = random_matrix(random, rows, columns);
        known.bottomLeftCorner(rows - 15, 5).setZero();  // five unknowns that one block determines
        const Eigen::VectorXd data =
            known * random_matrix(random, columns, 1) * 20.0 + random_matrix(random, rows, 1);
        diagnosis::Design design(known, data, rows);
        const diagnosis::LeftOut left(design, {}, folds_of(rows, 4), std::vector<bool>(rows, true));
        sum += left.surprise() / rows;
    }
    // Mean of 200 chi-squared per row: 1, standard error sqrt(2 / 60 / 200) = 0.013; folds share
    // readings, so allow twice that for each of three errors.
    CHECK(sum / draws == Approx(1.0).margin(0.08));
}

// Set-up and driver may imitate each other with large and opposite values: without the driver,
// which predicts nothing, the set-up would stand there alone.
TEST_CASE("a driver that the set-up nearly imitates leaves no hole when it does not predict",
          "[diagnosis]") {
    SeededNoise random(21);
    constexpr int rows = 120;
    const Eigen::MatrixXd known = random_matrix(random, rows, 4);
    const Eigen::MatrixXd effect = random_matrix(random, rows, 1);
    const Eigen::MatrixXd trend = 30.0 * known.col(0) + 0.5 * random_matrix(random, rows, 1);
    const Eigen::VectorXd data = 5.0 * effect + 0.8 * trend + random_matrix(random, rows, 1);
    diagnosis::Design design(known, data, rows);
    diagnosis::ColumnGroup cause, driver;
    cause.features = {design.add_features(effect)};
    driver.kind = diagnosis::GroupKind::driver;
    driver.features = {design.add_features(trend)};
    const diagnosis::Model model{
        {design.add(cause), design.add_beside(driver, 1)}, {{5.0, 1.0}, 1.0}, 0.0};
    const diagnosis::LeftOut left(design, model, folds_of(rows, 24), std::vector<bool>(rows, true));
    const double with = left.loss({true, true}, {true, false}).mean();
    CHECK(with < 1.2 * left.loss({true, false}, {true, false}).mean());
    CHECK(with < 0.1 * left.loss({false, false}, {false, false}).mean());
}

TEST_CASE("with nothing to fit the readings themselves are left", "[diagnosis]") {
    SeededNoise random(9);
    constexpr int rows = 40;
    const Eigen::VectorXd data = random_matrix(random, rows, 1);
    diagnosis::Design design(Eigen::MatrixXd(rows, 0), data, rows);
    const diagnosis::LeftOut left(design, {}, folds_of(rows, 8), std::vector<bool>(rows, true));
    CHECK(left.residual({}, {}) == data);
    CHECK(left.surprise() == Approx(data.squaredNorm()));
    CHECK(left.loss({}, {}).mean() == Approx(data.squaredNorm() / rows));
}

TEST_CASE("what all blocks save alike is certain, and one block says nothing", "[diagnosis]") {
    CHECK(diagnosis::BlockLoss{}.mean() == 0.0);
    const std::vector<double> rows{2.0, 2.0, 2.0};
    const diagnosis::BlockLoss without{{5.0, 6.0, 7.0}, rows};
    CHECK(without.mean() == Approx(3.0));
    const diagnosis::Saving alike = saving_of(without, {{4.0, 5.0, 6.0}, rows});
    CHECK(alike.sum == Approx(3.0));
    CHECK(alike.blocks == 3.0);
    // Readings that repeat to their last digit: all blocks are the same.
    CHECK(alike.t > 1e3);
    CHECK(saving_of({{4.0, 5.0, 6.0}, rows}, without).t < -1e3);
    CHECK(saving_of(without, without).t == 0.0);
    const diagnosis::Saving single = saving_of(without, {{2.0, 6.0, 7.0}, rows});
    CHECK(single.sum == Approx(3.0));
    CHECK(single.blocks == 1.0);
    CHECK(single.t == 0.0);
    CHECK(single.spread == Approx(3.0));  // it may as well be nothing
    const diagnosis::Saving uneven = saving_of(without, {{4.0, 4.0, 4.0}, rows});
    CHECK(uneven.t == Approx(2.0 * std::sqrt(3.0)));  // 1, 2, 3: mean 2, error 1 / sqrt(3)
}

TEST_CASE("a block that one model misses by far makes a saving large, not uncertain",
          "[diagnosis]") {
    const std::vector<double> rows(6, 2.0);
    const diagnosis::BlockLoss with{{1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, rows};
    const auto t_of = [&](std::vector<double> square) {
        return steady_saving_of({std::move(square), rows}, with).t;
    };
    const double even = t_of({3.0, 4.0, 3.0, 4.0, 3.0, 4.0});
    CHECK(even == Approx(saving_of({{3.0, 4.0, 3.0, 4.0, 3.0, 4.0}, rows}, with).t));
    // Ordinary t: 1.05. Taken as four times the median of 2.5: 10.
    const diagnosis::BlockLoss far{{3.0, 4.0, 3.0, 4.0, 3.0, 400.0}, rows};
    CHECK(saving_of(far, with).t < 1.1);
    CHECK(steady_saving_of(far, with).sum == Approx(22.0));
    CHECK(steady_saving_of(far, with).t > 2.5);
    // What speaks against the sum counts as it is.
    const diagnosis::BlockLoss against{{41.0, 41.0, 41.0, 41.0, 41.0, -150.0}, rows};
    CHECK(steady_saving_of(against, with).t == Approx(saving_of(against, with).t));
    CHECK(steady_saving_of(with, with).blocks == 0.0);
}

TEST_CASE("of a whole turn sectors of 15 degrees are left out, half a turn once", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 4);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        table.rows[i].commanded[Axis::C] = rad_from_deg(6.37 * static_cast<double>(i) - 400.0);
    const emulator::Replay replay(setup, table);
    diagnosis::TableForm turn{};
    turn.axis.axis = Axis::C;
    const diagnosis::Folds folds = diagnosis::place_folds(replay, turn);
    REQUIRE(folds.group.size() == replay.size());
    for (std::size_t a = 0; a < replay.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const auto place = [&](std::size_t i) {
                return std::lround(deg_from_rad(replay.sample(i).position[Axis::C]) / 15.0) % 24;
            };
            const bool same = (place(a) - place(b)) % 24 == 0;
            INFO(place(a) << " " << place(b));
            REQUIRE((folds.group[a] == folds.group[b]) == same);
        }
    for (const int group : folds.group)
        CHECK(folds.fold[static_cast<std::size_t>(group)] == group % diagnosis::Folds::count);
}

}  // namespace trunnion
