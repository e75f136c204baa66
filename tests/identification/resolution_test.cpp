// Records of few digits: the last digit counts as noise, and clusters of readings are no outliers.
#include "identification/resolution.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "identification/base_model.h"
#include "identification/identify.h"
#include "identification/simulated.h"

namespace trunnion {
namespace {

setup::Setup machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[model]\nmodelled = []\n", "s.toml",
        notes);
}

double three_digits_of(double value) {
    const double step = std::abs(value) >= 100.0 ? 1.0 : std::abs(value) >= 10.0 ? 0.1 : 0.01;
    return std::round(value / step) * step;
}

/// X to and fro over 50 to 150 mm, 10 ms apart, kept to three digits; it lags by 9 ms.
records::ReadingTable log() {
    records::ReadingTable table;
    table.path = "log.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 3000; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 0.01 * k;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "X";
        const double w = 0.7, x = 100.0 + 50.0 * std::sin(w * row.time_s);
        row.commanded[Axis::X] = three_digits_of(x);
        const double read = x - 0.009 * 50.0 * w * std::cos(w * row.time_s);
        row.velocity_mm_s = 50.0 * w * std::cos(w * row.time_s);
        row.value_mm = three_digits_of(read) - row.commanded[Axis::X];
        table.rows.push_back(row);
    }
    table.optional_columns = {"velocity_mm_s"};
    return table;
}

}  // namespace

TEST_CASE("the last digit of values", "[identification]") {
    using identification::decimal_step;
    CHECK(decimal_step({0.0, 1.0, -2.0, 3.0, 5.0, 7.0}) == 1.0);
    CHECK(decimal_step({0.1, 0.2, -0.4, 0.3, 1.0, 0.0}) == 0.1);
    CHECK(decimal_step({0.015, 0.02, 0.033, 0.0, -0.1, 0.5}) == 0.001);
    CHECK(decimal_step({0.0, 0.0, 0.0}) == 0.0);
    CHECK(decimal_step({1.0, 2.0, 3.0, 4.0}) == 0.0);  // too few
    CHECK(decimal_step({0.12345678, 0.2345678, 0.3456789, 0.456789, 0.56789}) == 0.0);
    // Differences of large numbers are not exact; a few readings may have another digit.
    CHECK(decimal_step({198.7 - 198.6, 99.9 - 100.0, 1e3 - 1000.3, 0.2, 0.4}) == 0.1);
    std::vector<double> many(40, 1.0);
    many[7] = 0.1;
    many[9] = 2.3;
    CHECK(decimal_step(many) == 1.0);
    many[11] = 0.4;
    CHECK(decimal_step(many) == 0.1);
}

TEST_CASE("the step of a counter", "[identification]") {
    using identification::counter_step;
    constexpr double count = 360.0 / 4096.0;
    std::vector<double> read;
    for (int k = 0; k < 40; ++k)
        read.push_back(std::round(1e4 * count * ((7 * k * k) % 53)) / 1e4 + 17.0);
    CHECK(counter_step(read) == Approx(count).epsilon(1e-4));
    read[5] += 0.4 * count;  // one reading between the counts: no counter
    CHECK(counter_step(read) == 0.0);
    CHECK(counter_step({0.0, 1.0, 2.0, 3.0}) == 0.0);  // too few
    std::vector<double> any;
    for (int k = 0; k < 40; ++k) any.push_back(std::fmod(0.618034 * k, 1.0));
    CHECK(counter_step(any) == 0.0);
}

namespace {

/// A laser that reads counts of 0.6 um, at targets 20 mm apart, twice.
records::ReadingTable counted(double stated_sigma_mm, double bow_mm) {
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 84; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = k;
        row.test = "X";
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3(1, 0, 0);
        const double part = (k % 42) / 41.0;
        row.commanded[Axis::X] = 20.0 * (k % 42);
        row.value_mm = 0.0006 * std::round(4.0 * bow_mm * part * (1.0 - part) / 0.0006);
        if (stated_sigma_mm > 0.0) row.sigma_mm = stated_sigma_mm;
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("counts are noise beside a stated device, not beside a stated row", "[identification]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.1 }\n",
        "s.toml", notes);
    const auto sigma_mm = [&](const records::ReadingTable& table) {
        return identification::row_noise(setup, table, emulator::Replay(setup, table)).sigma_mm(7);
    };
    CHECK(sigma_mm(counted(0.0, 0.02)) == Approx(0.0006 / std::sqrt(12.0)));
    CHECK(sigma_mm(counted(1e-4, 0.02)) == 1e-4);
    // A line without noise grows in even steps: each was read at one place.
    records::ReadingTable line = counted(0.0, 0.02);
    for (records::Reading& row : line.rows)
        row.value_mm = 20e-6 * std::sqrt(2.0) * row.commanded[Axis::X];
    CHECK(sigma_mm(line) == 1e-4);
}

TEST_CASE("a servo log of three digits: the sigma is that of the digits, and the lag is right",
          "[identification]") {
    const setup::Setup setup = machine();
    const records::ReadingTable table = log();
    const emulator::Replay replay(setup, table);
    const identification::RowNoise noise = identification::row_noise(setup, table, replay);
    CHECK_FALSE(noise.given);
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const bool coarse = table.rows[i].commanded[Axis::X] >= 100.0;
        CHECK(noise.sigma_mm(static_cast<Eigen::Index>(i)) ==
              Approx((coarse ? 1.0 : 0.1) / std::sqrt(12.0)));
    }
    const identification::Identification fit =
        identification::identify(setup, table, {"servo.mismatch"});
    double tau_s = 0.0, sigma_s = 0.0;
    for (const identification::FitParameter& p : fit.parameters)
        if (p.name == "tau_x_s") {
            tau_s = p.value;
            sigma_s = p.sigma;
        }
    CHECK(tau_s == Approx(0.009).margin(3.0 * sigma_s));
    CHECK(sigma_s < 0.001);
    // What the setup states is the noise of the encoder: the file has no more digits for that.
    setup::Setup stated = setup;
    stated.model.noise_um["axis"] = 3.0;
    CHECK(identification::row_noise(stated, table, replay).sigma_mm.minCoeff() ==
          Approx(0.1 / std::sqrt(12.0)));
    // What a row states is its own.
    records::ReadingTable own = table;
    for (records::Reading& row : own.rows) row.sigma_mm = 0.003;
    CHECK(identification::row_noise(setup, own, replay).sigma_mm.maxCoeff() == 0.003);
}

TEST_CASE("a servo log scatters at rest more than usual: that is its noise", "[identification]") {
    records::ReadingTable table = log();
    std::uint64_t state = 1;
    const auto even = [&] {  // -0.5 to 0.5
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
    };
    constexpr double spread_mm = 0.02;
    for (records::Reading& row : table.rows) {
        row.commanded[Axis::X] = row.index < 60 ? 100.0 : 100.0 + 0.05 * (row.index - 60);
        double sum = 0.0;
        for (int k = 0; k < 12; ++k) sum += even();  // nearly normal
        row.value_mm = spread_mm * sum + (row.index < 60 ? 0.0 : 0.3);
    }
    const emulator::Replay replay(machine(), table);
    const double sigma_mm = identification::row_noise(machine(), table, replay).sigma_mm(0);
    CHECK(sigma_mm > 0.7 * spread_mm);
    CHECK(sigma_mm < 1.4 * spread_mm);
    CHECK(identification::row_noise(machine(), table, replay).sigma_mm.minCoeff() == sigma_mm);
    // At rest without noise nothing is known of it; a stated noise is kept.
    setup::Setup stated = machine();
    stated.model.noise_um["axis"] = 3.0;
    CHECK(identification::row_noise(stated, table, replay).sigma_mm.maxCoeff() == 0.003);
    for (records::Reading& row : table.rows)
        if (row.index < 60) row.value_mm = 0.0;
    CHECK(identification::row_noise(machine(), table, replay).sigma_mm.maxCoeff() == 0.001);
}

TEST_CASE("a log whose positions are mostly equal has their digits all the same",
          "[identification]") {
    records::ReadingTable table = log();
    for (records::Reading& row : table.rows) {
        row.commanded[Axis::X] = 200.0 + row.index % 7;
        row.value_mm = 0.0;
    }
    const emulator::Replay replay(machine(), table);
    const auto noise = identification::row_noise(machine(), table, replay);
    CHECK(noise.sigma_mm.minCoeff() == Approx(1.0 / std::sqrt(12.0)));
}

TEST_CASE("a log that rests at round positions has the digits of its moves", "[identification]") {
    setup::Setup stated = machine();
    stated.model.noise_um["axis"] = 1.0;
    records::ReadingTable table = log();
    for (records::Reading& row : table.rows) {
        const bool rests = row.index % 600 > 20;
        row.commanded[Axis::X] = 10.0 * (row.index / 600) + (rests ? 0.0 : 0.123 * row.index);
        row.value_mm = rests ? 0.0 : 0.001 * (row.index % 7);
    }
    const emulator::Replay replay(stated, table);
    CHECK(identification::row_noise(stated, table, replay).sigma_mm.maxCoeff() == 0.001);
}

TEST_CASE("simulated readings have the noise that is stated, not that of round positions",
          "[identification]") {
    setup::Setup stated = machine();
    stated.model.noise_um["axis"] = 1.0;
    records::ReadingTable table = log();
    for (records::Reading& row : table.rows) {
        row.commanded[Axis::X] = 10.0 * row.index;
        row.value_mm.reset();
        row.velocity_mm_s.reset();
    }
    table.optional_columns.clear();
    for (const records::Reading& row : identification::simulated(stated, table, 3).rows)
        CHECK(std::abs(*row.value_mm) < 0.006);
}

TEST_CASE("actual positions in another unit or of another column are refused", "[identification]") {
    records::ReadingTable table = log();
    for (records::Reading& row : table.rows) *row.value_mm += 20.0;
    CHECK_THROWS_WITH(identification::identify(machine(), table, {}),
                      Catch::Contains("X beside the commanded position in all rows: 20.0 mm"));
    setup::Setup meant = machine();
    meant.model.allow_large = true;
    CHECK(identification::identify(meant, table, {}).set_up_words.size() == 1);
}

TEST_CASE("a fit that lacks something is less certain than its noise says", "[identification]") {
    records::ReadingTable table = log();
    std::uint64_t state = 7;
    for (records::Reading& row : table.rows) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double even = static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
        const double slow = 0.7 * row.time_s, fast = 3.1 * row.time_s;
        row.commanded[Axis::X] = 100.0 + 50.0 * std::sin(slow) + 9.0 * std::sin(fast) +
                                 1e-7 * row.index;  // no few digits
        row.velocity_mm_s = 35.0 * std::cos(slow) + 27.9 * std::cos(fast);
        row.value_mm = -0.009 * *row.velocity_mm_s + 0.0034641 * even;  // 1 um
    }
    records::ReadingTable bent = table;
    for (records::Reading& row : bent.rows)
        *row.value_mm += 0.04 * std::sin(0.9 * row.commanded[Axis::X]);
    const auto sigma_of = [](const identification::Identification& fit) {
        for (const identification::FitParameter& p : fit.parameters)
            if (p.name == "tau_x_s") return p.sigma;
        return 0.0;
    };
    const auto fit = [&](const records::ReadingTable& t, bool stated) {
        setup::Setup setup = machine();
        if (stated) setup.model.noise_um["axis"] = 1.0;
        return identification::identify(setup, t, {"servo.mismatch"});
    };
    for (const bool stated : {false, true}) {
        const auto right = fit(table, stated), wrong = fit(bent, stated);
        CHECK(right.notes.empty());
        REQUIRE(wrong.notes.size() == 1);
        CHECK_THAT(wrong.notes.front(), Catch::Contains("the residual is"));
        // Nobody states the noise: it is that of the residual, about 28 um.
        const double ratio = sigma_of(wrong) / sigma_of(right);
        if (stated)
            CHECK(ratio == Approx(1.0));
        else
            CHECK(ratio == Approx(33.0).epsilon(0.4));
    }
}

}  // namespace trunnion
