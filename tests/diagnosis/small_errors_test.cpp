// Errors of all axes beside a cause, held against readings at poses that were not measured.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double noise_um = 0.8;  ///< of a found sphere in this setup

/// All six errors of each linear axis, two waves each over its travel: of this size, or as many
/// times 5 urad.
setup::Setup with_errors(setup::Setup truth, double size_um, std::uint64_t seed) {
    SeededNoise random(seed);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        auto& motion = truth.machine.errors.axis[index_of(axis)].motion;
        for (std::size_t d = 0; d < motion.size(); ++d) {
            const double wave_mm = 250.0 + 250.0 * random.uniform(), phase = 6.0 * random.uniform();
            const double high = size_um * random.normal() * (d < 3 ? 1e-3 : 5e-6);
            kinematics::ErrorCurve& curve = motion[d];
            for (double q = -600.0; q <= 600.0; q += 15.0) {
                curve.at.push_back(q);
                curve.value.push_back(high * std::sin(2.0 * pi * q / wave_mm + phase));
            }
        }
    }
    return truth;
}

struct Left {
    double rms_sigma = 0.0;  ///< of fresh readings, with their noise
    bool beside = false;     ///< the setup has small errors beside the causes
};

/// What the written setup leaves of fresh spheres.
Left left_by(double size_um, double gap_rad, std::uint64_t seed) {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(with_errors(campaign::real_machine(setup), size_um, seed),
                              fmt::format("C.backlash: gap_rad={}", gap_rad));
    records::ReadingTable table = campaign::empty_table(setup), fresh = table;
    campaign::add_sphere_map(table, setup, 70, seed);
    campaign::add_sphere_map(fresh, setup, 60, seed + 500);
    const diagnosis::Diagnosis d = diagnosed(setup, campaign::measured(truth, table, seed));
    const auto read = [&](const setup::Setup& by) {
        return emulator::Replay(by, fresh).predict(effects::active_models(by));
    };
    const std::vector<double> real = read(truth), told = read(d.setup);
    double square = 0.0;
    for (std::size_t i = 0; i < real.size(); ++i) square += std::pow(1e3 * (real[i] - told[i]), 2);
    square /= static_cast<double>(real.size()) * noise_um * noise_um;
    return {std::sqrt(1.0 + square), !d.background.empty()};
}

double median_left(double size_um, double gap_rad, bool& beside) {
    std::vector<double> left;
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
        const Left one = left_by(size_um, gap_rad, seed);
        left.push_back(one.rms_sigma);
        beside = beside || one.beside;
    }
    std::sort(left.begin(), left.end());
    return left[left.size() / 2];
}

}  // namespace

TEST_CASE("small errors of all axes predict together what none does alone", "[diagnosis]") {
    bool beside = false;
    const double left = median_left(1.5, 6e-5, beside);
    INFO("left " << left << " sigma");
    CHECK(beside);
    CHECK(left < 1.35);
}

TEST_CASE("more than twelve large errors of the axes are found at once", "[diagnosis]") {
    bool beside = false;
    const double left = median_left(8.0, 1e-4, beside);
    INFO("left " << left << " sigma");
    CHECK(left < 1.6);
}

}  // namespace trunnion
