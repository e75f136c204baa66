// The side from which an axis came before its first motion: in run, predict, identify and diagnose.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/cli/command_bench.h"

namespace {

const std::string root = TRUNNION_SOURCE_DIR;

/// A circle about the centre pivot before C has moved, after C came back travelling - and after it
/// came back travelling +.
const char* const circles =
    "%\nO8960 (CIRCLE BEFORE AND AFTER C TURNS)\nG90 G21 G17 G40 G49 G80 G94 G54\n"
    "G10 L2 P1 X0 Y0 Z0\nPOPEN\nDPRNT[SAMPLE*5]\nG53 G0 Z450.\nG0 X175. Y0\nG1 Z230. F5000\n"
    "DPRNT[BALLBAR*ON*BEFORE]\nG3 X175. Y0 I-100. J0 F1500\nDPRNT[BALLBAR*OFF]\n"
    "G0 C5.\nC0\nDPRNT[BALLBAR*ON*MINUS]\nG3 X175. Y0 I-100. J0 F1500\nDPRNT[BALLBAR*OFF]\n"
    "G0 C-5.\nC0\nDPRNT[BALLBAR*ON*PLUS]\nG3 X175. Y0 I-100. J0 F1500\nDPRNT[BALLBAR*OFF]\n"
    "PCLOS\nG53 G0 Z450.\nM30\n%\n";

/// bc_table.toml whose C came travelling the way of `side`, with or without a backlash of 60 urad.
std::string setup_text(char side, bool backlash) {
    std::ostringstream file;
    file << std::ifstream(root + "/machines/bc_table.toml").rdbuf();
    std::string text = file.str();
    const std::string chain = "chain = \"w C B b X Y Z t\"\n";
    text.insert(text.find(chain) + chain.size(),
                "side = { C = \"" + std::string(1, side) + "\" }\n");
    return backlash ? text + "\n[effects]\n\"C.backlash\" = { gap_rad = 6e-5 }\n" : text;
}

/// Values of the device rows of a readings file, in mm.
std::vector<double> values_of(const std::string& csv) {
    std::istringstream in(csv);
    std::vector<double> values;
    std::string line;
    std::ptrdiff_t column = -1;
    while (std::getline(in, line)) {
        if (line.starts_with("#")) continue;
        std::vector<std::string> cells;
        std::istringstream row(line + ",");
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        if (column < 0) {
            column = std::find(cells.begin(), cells.end(), "value_mm") - cells.begin();
        } else if (const std::string& cell = cells[static_cast<std::size_t>(column)];
                   !cell.empty()) {
            values.push_back(std::stod(cell));
        }
    }
    return values;
}

double farthest_mm(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

/// Readings that a machine wrote whose C came travelling the way of `side`; the file `told` has the
/// head line, the file `untold` lacks it.
struct Readings {
    CommandBench bench;
    std::string real, model, told, untold, text;
    explicit Readings(char side)
        : real(bench.write("real.toml", setup_text(side, true))),
          model(bench.write("model.toml", setup_text('+', false))),
          told(bench.file("told.csv")) {
        REQUIRE(bench.trunnion("run " + bench.write("circles.nc", circles) + " --setup " + real +
                               " --seed 3 --readings " + told) == 0);
        text = bench.read("told.csv");
        const std::size_t at = text.find("# side = ");
        REQUIRE(at != std::string::npos);
        std::string rest = text;
        rest.erase(at, text.find('\n', at) + 1 - at);
        untold = bench.write("untold.csv", rest);
    }
    nlohmann::json answer(const std::string& words) const {
        INFO(words);
        REQUIRE(bench.trunnion(words + " --json") == 0);
        return nlohmann::json::parse(bench.read("out.txt"));
    }
};

std::optional<double> side_of_c(const nlohmann::json& diagnosis) {
    for (const nlohmann::json& item : diagnosis["setup"])
        if (item["name"] == "side of C") return item["value"].get<double>();
    return std::nullopt;
}

}  // namespace

TEST_CASE("run writes the sides of its setup, predict goes by the line, without it by +") {
    for (const char side : {'+', '-'}) {
        const Readings r(side);
        INFO(side);
        CHECK_THAT(r.text,
                   Catch::Contains("# side = ") && Catch::Contains(std::string("C") + side));
        std::vector<std::vector<double>> said;
        for (const std::string& table : {r.told, r.untold}) {
            REQUIRE(r.bench.trunnion("predict " + table + " --setup " + r.real) == 0);
            said.push_back(values_of(r.bench.read("out.txt")));
            const std::string notes = r.bench.read("err.txt");
            if (table == r.told)
                CHECK(notes.empty());
            else
                CHECK_THAT(notes, Catch::Contains("from which side C came") &&
                                      Catch::Contains("taken as +"));
        }
        CHECK(farthest_mm(said[0], values_of(r.text)) < 1.5e-3);  // the noise of what was read
        // The gap turns the pivot, 75 mm from C, by 60 urad: 4.5 um where the bar lies along Y.
        const double gap_mm = farthest_mm(said[0], said[1]);
        if (side == '+')
            CHECK(gap_mm == 0.0);
        else
            CHECK(gap_mm == Approx(4.5e-3).epsilon(0.01));
    }
}

TEST_CASE("identify and diagnose find the side that no line tells") {
    for (const char side : {'+', '-'}) {
        const Readings r(side);
        INFO(side);
        const std::string with = " --setup " + r.model;
        r.answer("identify " + r.untold + with + " --effects C.backlash");
        CHECK_THAT(r.bench.read("err.txt"),
                   Catch::Contains(std::string("C came travelling ") + side));
        CHECK((r.bench.read("err.txt").find("# side = C-") != std::string::npos) == (side == '-'));
        const nlohmann::json d = r.answer("diagnose " + r.untold + with);
        REQUIRE_FALSE(d["causes"].empty());
        CHECK(d["causes"][0]["effect"] == "C.backlash");
        REQUIRE(side_of_c(d));
        CHECK(*side_of_c(d) == Approx(side == '+' ? 1.0 : -1.0).margin(0.1));
        CHECK_FALSE(side_of_c(r.answer("diagnose " + r.told + with)));
        // With the backlash on both sides nothing is left, told or not.
        for (const std::string& table : {r.told, r.untold})
            CHECK(r.answer("diagnose " + table + " --setup " + r.real)["verdict"] == "no-gap");
    }
}
