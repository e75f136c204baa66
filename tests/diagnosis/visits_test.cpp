// Which readings share the error of a pose: one visit, not the same place taken again.
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "base/random.h"
#include "diagnosis/prepare/noise.h"
#include "diagnosis/prepare/prepare.h"
#include "diagnosis/prepare/target_visits.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_lines.h"

namespace trunnion {
namespace {

struct Visits {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);

    /// Nine touches in nine directions with the table at C, two seconds apart.
    void nine_touches(double c_rad, double begin_s) {
        for (int k = 0; k < 9; ++k) {
            records::Reading row;
            row.test = "map";
            row.feature = "S1";
            row.device = records::Device::touch;
            row.commanded[Axis::C] = c_rad;
            row.time_s = begin_s + 2.0 * k;
            const double turn = 2.0 * pi * k / 9.0;
            row.direction_M = Vector3(std::cos(turn), std::sin(turn), 0.0);
            row.value_mm = 0.0;
            table.rows.push_back(row);
        }
    }
    void turn_to(double c_rad, double time_s) {
        records::Reading row;
        row.test = "map";
        row.commanded[Axis::C] = c_rad;
        row.time_s = time_s;
        table.rows.push_back(row);
    }
    std::vector<std::size_t> sizes() const {
        const emulator::Replay replay(setup, table);
        std::vector<std::size_t> list;
        for (const diagnosis::NoiseBlock& b : diagnosis::noise_blocks(replay, table))
            list.push_back(b.rows.size());
        return list;
    }
};

}  // namespace

TEST_CASE("targets that are read at one position of the axes are left out together",
          "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z C t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[instrument]]\nname = \"tracker\"\nframe = \"M\"\nfree = [\"pose\"]\n"
        "[[artefact]]\nname = \"T1\"\nkind = \"target\"\ntool_mm = [50, 0, -80]\n"
        "[[artefact]]\nname = \"T2\"\nkind = \"target\"\ntool_mm = [-40, 30, -60]\n",
        "s.toml", notes);
    records::ReadingTable table = campaign::empty_table(setup);
    for (const char* target : {"T1", "T2"})  // one after the other, at the same poses
        for (int pose = 0; pose < 6; ++pose)
            for (int d = 0; d < 3; ++d) {
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = 60.0 * (row.index / 3);
                row.test = "points";
                row.device = records::Device::point;
                row.feature = target;
                row.commanded[Axis::X] = 50.0 * pose;
                row.commanded[Axis::C] = 0.4 * pose * pose;
                row.direction_M = Vector3::Unit(d);
                row.value_mm = 0.0;
                table.rows.push_back(row);
            }
    const emulator::Replay replay(setup, table);
    const auto blocks = diagnosis::noise_blocks(replay, table);
    REQUIRE(blocks.size() == 12);
    diagnosis::Folds folds = diagnosis::make_folds(blocks, replay.size());
    diagnosis::join_targets(blocks, replay, table, folds);
    REQUIRE(folds.fold.size() == 6);
    for (std::size_t i = 0; i < 18; ++i) CHECK(folds.group[i] == folds.group[i + 18]);
    CHECK(folds.group[0] != folds.group[3]);
    CHECK(std::set<int>(folds.fold.begin(), folds.fold.end()).size() == 6);
    // Poses of one target each stay as they are.
    table.rows.resize(18);
    const emulator::Replay one(setup, table);
    const auto few = diagnosis::noise_blocks(one, table);
    diagnosis::Folds before = diagnosis::make_folds(few, one.size()), after = before;
    diagnosis::join_targets(few, one, table, after);
    CHECK(after.group == before.group);
    CHECK(after.fold == before.fold);
}

TEST_CASE("no target of a laser is left out in all its visits at once", "[diagnosis]") {
    for (const int places : {4, 5, 8, 13, 21, 31, 40})
        for (const int extra : {0, 3, 5}) {  // readings of a test before, which shift the folds
            INFO(places << " places after " << extra);
            records::ReadingTable table = laser_lines::empty_table();
            const auto add = [&](const std::string& test, double at_mm) {
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = 10.0 * row.index;
                row.commanded[Axis::X] = at_mm;
                row.test = test;
                row.device = records::Device::linear;
                row.feature = "R1";
                row.direction_M = Vector3::UnitX();
                row.value_mm = 0.0;
                table.rows.push_back(row);
            };
            for (int k = 0; k < extra; ++k) add("before", -100.0 + k);
            for (int run = 0; run < 2; ++run)
                for (int k = 0; k < 2 * places; ++k)
                    add("X", 20.0 * (k < places ? k : 2 * places - 1 - k));
            const emulator::Replay replay(laser_lines::stage(), table);
            const auto blocks = diagnosis::noise_blocks(replay, table);
            diagnosis::Folds folds = diagnosis::make_folds(blocks, replay.size());
            diagnosis::spread_visits(blocks, replay, table, folds);
            std::map<double, std::set<int>> out;
            for (std::size_t i = static_cast<std::size_t>(extra); i < replay.size(); ++i)
                out[table.rows[replay.table_row(i)].commanded[Axis::X]].insert(
                    folds.fold[static_cast<std::size_t>(folds.group[i])]);
            REQUIRE(out.size() == static_cast<std::size_t>(places));
            for (const auto& [at_mm, of_target] : out) CHECK(of_target.size() >= 2);
        }
}

TEST_CASE("a pose that is left and taken again is another visit", "[diagnosis]") {
    Visits v;
    v.turn_to(0.9, 0.0);
    v.nine_touches(1.0, 10.0);
    v.turn_to(1.1, 30.0);
    v.nine_touches(1.0, 40.0);
    CHECK(v.sizes() == std::vector<std::size_t>{9, 9});
}

TEST_CASE("a visit of very many touches is divided: its noise is computed at once", "[diagnosis]") {
    Visits v;
    for (int k = 0; k < 8; ++k) v.nine_touches(0.0, 18.0 * k);
    v.nine_touches(1.0, 200.0);
    CHECK(v.sizes() == std::vector<std::size_t>{64, 8, 9});
}

TEST_CASE("a sphere measured again after a pause is another visit", "[diagnosis]") {
    Visits v;
    for (int k = 0; k < 7; ++k) v.nine_touches(0.0, 600.0 * k);
    CHECK(v.sizes() == std::vector<std::size_t>(7, 9));
}

TEST_CASE("touches of one visit stay together", "[diagnosis]") {
    Visits v;
    v.nine_touches(1.0, 0.0);
    v.nine_touches(1.0, 19.0);  // each direction twice, without a pause
    // Where the table never turns there is no error of a pose, and each round is a calibration.
    CHECK(v.sizes() == std::vector<std::size_t>{9, 9});
    v.nine_touches(2.0, 60.0);
    CHECK(v.sizes() == std::vector<std::size_t>{18, 9});
    Visits rounded;  // a program's rounding of an angle is no motion
    rounded.nine_touches(1.0, 0.0);
    for (std::size_t k = 1; k < 9; ++k) rounded.table.rows[k].commanded[Axis::C] += 1e-12;
    CHECK(rounded.sizes() == std::vector<std::size_t>{9});
}

TEST_CASE("the samples of a pass are whitened by the covariance that is stated for them",
          "[diagnosis]") {
    constexpr Eigen::Index samples = 12;
    constexpr double sigma_mm = 3e-4;
    diagnosis::NoiseModel noise;
    noise.ballbar = {1.5, 0.6, 0.8};
    diagnosis::NoiseBlock pass{records::Device::ballbar, {}};
    Eigen::MatrixXd covariance(samples, samples);
    for (Eigen::Index i = 0; i < samples; ++i) {
        pass.rows.push_back(i);
        for (Eigen::Index j = 0; j < samples; ++j)
            covariance(i, j) = std::pow(1.5 * sigma_mm, 2) *
                               (0.6 * std::pow(0.8, std::abs(i - j)) + (i == j ? 0.4 : 0.0));
    }
    Visits v;
    v.nine_touches(0.0, 0.0);
    const emulator::Replay replay(v.setup, v.table);
    const diagnosis::Whitener whitener(replay, {pass}, noise,
                                       Eigen::VectorXd::Constant(samples, sigma_mm));
    Eigen::MatrixXd whitening = Eigen::MatrixXd::Identity(samples, samples);
    whitener.apply(whitening);
    const Eigen::MatrixXd left = whitening * covariance * whitening.transpose();
    CHECK((left - Eigen::MatrixXd::Identity(samples, samples)).cwiseAbs().maxCoeff() < 1e-9);
}

namespace {

constexpr double touch_sigma_mm = 8e-4;

/// Repeated visits whose touches share the error of a found centre.
struct NoisyTouches : Visits {
    NoisyTouches() {
        for (int pass = 0; pass < 2; ++pass)
            for (int k = 0; k < 60; ++k) {
                const double begin_s = 4000.0 * pass + 60.0 * k;
                turn_to(0.05 * k - 0.02, begin_s);  // always from the same side
                nine_touches(0.05 * k, begin_s + 5.0);
            }
    }
    /// Residuals of this noise, mm.
    Eigen::VectorXd noise(const emulator::Replay& replay,
                          const std::vector<diagnosis::NoiseBlock>& blocks,
                          const diagnosis::DeviceNoise& of) const {
        SeededNoise random(31);
        Eigen::VectorXd v(static_cast<Eigen::Index>(replay.size()));
        for (const diagnosis::NoiseBlock& block : blocks) {
            const Vector3 centre(random.normal(), random.normal(), random.normal());
            for (const Eigen::Index i : block.rows)
                v(i) = touch_sigma_mm * of.scale *
                       (std::sqrt(of.shared) * centre.dot(direction(replay, i)) +
                        std::sqrt(1.0 - of.shared) * random.normal());
        }
        return v;
    }
    static Vector3 direction(const emulator::Replay& replay, Eigen::Index i) {
        return replay.contact(static_cast<std::size_t>(i)).direction_M;
    }
};

}  // namespace

TEST_CASE("repeated visits tell what touches share, and whitening takes it out", "[diagnosis]") {
    const NoisyTouches t;
    const emulator::Replay replay(t.setup, t.table);
    const auto blocks = diagnosis::noise_blocks(replay, t.table);
    REQUIRE(blocks.size() == 120);
    const auto rows = static_cast<Eigen::Index>(replay.size());
    const Eigen::VectorXd sigma_mm = Eigen::VectorXd::Constant(rows, touch_sigma_mm);
    const std::vector<bool> all(replay.size(), true);
    const Eigen::VectorXd no_digits = Eigen::VectorXd::Zero(rows);
    for (const double shared : {0.0, 0.6}) {
        INFO(shared);
        const Eigen::VectorXd residual_mm = t.noise(replay, blocks, {1.3, shared, 0.0});
        const diagnosis::NoiseModel model = diagnosis::noise_from_repeats(
            {replay, t.table, blocks, all, {}, no_digits}, residual_mm, sigma_mm, {});
        CHECK(model.source == diagnosis::NoiseSource::repeats);
        CHECK(model.touch.scale == Approx(1.3).epsilon(0.1));
        CHECK(model.touch.shared == Approx(shared).margin(0.12));
        CHECK(model.sphere.scale == 1.0);  // there is none
        const Eigen::VectorXd white =
            diagnosis::Whitener(replay, blocks, model, sigma_mm).apply(residual_mm);
        CHECK(white.squaredNorm() / static_cast<double>(rows) == Approx(1.0).margin(0.12));
        // What a centre would do to the touches of a visit, mean square over the visits.
        double square = 0.0, expected = 0.0;
        for (const diagnosis::NoiseBlock& block : blocks) {
            Vector3 sum = Vector3::Zero();
            for (const Eigen::Index i : block.rows)
                sum += residual_mm(i) / (1.3 * touch_sigma_mm) * t.direction(replay, i);
            square += sum.squaredNorm();
            expected += 9.0;
        }
        CHECK((square > 2.0 * expected) == (shared > 0.0));  // the raw ones: 1 + 3.5 shared
        Eigen::Index k = 0;
        double neighbours = 0.0;
        for (const diagnosis::NoiseBlock& block : blocks)
            for (std::size_t j = 1; j < block.rows.size(); ++j, ++k)
                neighbours += white(block.rows[j]) * white(block.rows[j - 1]);
        CHECK(std::abs(neighbours / static_cast<double>(k)) < 4.0 / std::sqrt(k));
    }
}

}  // namespace trunnion
