// Comparisons of drawn pairs as they were said: a change of any of them shows
// (tests/support/told.h). What they ought to say is judged by the other tests.
#include "tests/support/told.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "regression/golden.h"
#include "regression/two_controls.h"
#include "report/comparison_report.h"
#include "tests/regression/programs.h"
#include "tests/regression/random_edit.h"
#include "tests/regression/small_post.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

using Lines = std::vector<std::string>;

constexpr std::array<const char*, 22> blocks{
    "G0 Z155.", "G1 X12. F450.", "G4 P700", "M3",  "M5",  "M8",  "M9",    "S5000",
    "F333.",    "G90",           "G91",     "G54", "G55", "G80", "T3 M6", "G1",
    "X7.",      "Z146.",         "M0",      "M1",  "G40", "G0",
};
constexpr std::array<const char*, 14> codes{"G0",  "G1",  "G2",  "G3",  "G54", "G55", "G81",
                                            "G82", "G90", "G91", "G98", "G99", "M3",  "M9"};
const EditChoices choices{blocks, codes, "XYZIJFSTHPR"};

/// All numbers of the report in JSON and of the picture, and the report in words where `whole`.
void tell(const regression::Comparison& comparison, const std::string& name, Lines& lines,
          bool whole) {
    lines.push_back("== " + name + " " + comparison.verdict);
    regression::CompareReport report;
    report.cases = {comparison};
    std::istringstream text(report::comparison_text(report));
    for (std::string line; whole && std::getline(text, line);) lines.push_back(line);
    told::Json json = told::Json::parse(report::comparison_json(report));
    for (const auto* paths : {&comparison.picture.cuts_a, &comparison.picture.cuts_b,
                              &comparison.picture.rapids_a, &comparison.picture.rapids_b})
        json["picture"].push_back(*paths);
    for (const auto& closeup : comparison.picture.closeups)
        json["closeups"].push_back({closeup.apart_mm(), closeup.right, closeup.up});
    lines.push_back(told::brief(json));
}

std::string with_edits(std::string text, int count, SeededNoise& noise) {
    std::string what;
    for (int k = 0; k < count; ++k) text = edited(text, choices, noise, what);
    return text;
}

/// A way of short and long moves near the tolerance; `off_mm` moves each corner, and some are
/// split in two.
std::string drawn_way(std::uint64_t seed, double off_mm, std::uint64_t change) {
    SeededNoise way(seed), other(change);
    std::string text =
        "%\nO1000\nG21 G90 G17 G94\nG54\nT1 M6\nS3000 M3\nG43 H1\nG0 X0. Y0. Z150.\n";
    text += "G1 Z140. F300.\n";
    std::array<double, 2> at{};
    for (int k = 0; k < 30; ++k) {
        const double size = way.uniform() < 0.3 ? 0.02 : 12.0;
        const double kind = way.uniform();
        std::array<double, 2> to = at;
        for (double& value : to) value += size * (way.uniform() - 0.5);
        const auto moved = [&](double value) { return value + off_mm * (other.uniform() - 0.5); };
        if (kind < 0.15)
            text += fmt::format("G0 X{:.4f} Y{:.4f}\nG1\n", moved(to[0]), moved(to[1]));
        else if (kind < 0.3)
            text +=
                fmt::format("G{} X{:.4f} Y{:.4f} R20.\nG1\n", kind < 0.22 ? 2 : 3, to[0], to[1]);
        else {
            if (other.uniform() < 0.3)
                text +=
                    fmt::format("X{:.4f} Y{:.4f}\n", 0.5 * (at[0] + to[0]), 0.5 * (at[1] + to[1]));
            text += fmt::format("X{:.4f} Y{:.4f} F{}.\n", moved(to[0]), moved(to[1]),
                                way.uniform() < 0.2 ? 500 : 300);
        }
        at = to;
    }
    return text + "G0 Z200.\nM5\nM30\n%\n";
}

regression::ControlReading control(const std::string& name, double length_mm) {
    regression::ControlReading out;
    out.name = name;
    out.config.dialect =
        name == "hurco" ? interpreter::hurco_dialect() : interpreter::fanuc_dialect();
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        out.config.axes.push_back(entry);
    }
    for (std::size_t k = 1; k <= 3; ++k)
        out.stores.tools.tool[k].length_geometry_mm = length_mm + 10.0 * static_cast<double>(k);
    out.stores.parameters.set(3401, 1);
    return out;
}

setup::Setup with_tools(double length_mm) {
    setup::Setup setup = bc_table();
    for (std::size_t k = 1; k <= 3; ++k)
        setup.stores.tools.tool[k].length_geometry_mm = length_mm + 10.0 * static_cast<double>(k);
    return setup;
}

}  // namespace

TEST_CASE("told: edits of a part", "[regression][told]") {
    Lines lines;
    const setup::Setup setup = with_tools(100.0);
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SeededNoise noise(seed);
        const std::string part = small_post(small_part(seed));
        const std::string other = with_edits(part, static_cast<int>(1 + seed % 3), noise);
        tell(compare_texts(part, other, setup), fmt::format("{}", seed), lines, seed % 5 == 0);
    }
    told::check_told("regression", "edits", lines);
}

TEST_CASE("told: each layer", "[regression][told]") {
    Lines lines;
    const setup::Setup setup = with_tools(100.0);
    for (std::uint64_t seed = 101; seed <= 107; ++seed) {
        SeededNoise noise(seed);
        const std::string part = small_post(small_part(seed));
        const std::string other = with_edits(part, 3, noise);
        for (std::size_t layer = 0; layer < regression::layer_names.size(); ++layer)
            tell(compare_texts(part, other, setup, only(static_cast<regression::Layer>(layer))),
                 fmt::format("{} {}", seed, regression::layer_names[layer]), lines, seed == 101);
    }
    told::check_told("regression", "layers", lines);
}

TEST_CASE("told: ways near the tolerance", "[regression][told]") {
    Lines lines;
    const setup::Setup setup = with_tools(100.0);
    for (std::uint64_t seed = 201; seed <= 400; ++seed) {
        const double off_mm = std::array{0.0, 0.001, 0.004, 0.05, 2.0}[seed % 5];
        tell(compare_texts(drawn_way(seed, 0.0, 1), drawn_way(seed, off_mm, seed), setup,
                           only(regression::Layer::path)),
             fmt::format("{}", seed), lines, seed % 5 == 0);
    }
    told::check_told("regression", "ways", lines);
}

TEST_CASE("told: one program on two setups", "[regression][told]") {
    Lines lines;
    const setup::Setup setup = with_tools(100.0);
    for (std::uint64_t seed = 401; seed <= 416; ++seed) {
        setup::Setup other = setup;
        if (seed % 4 == 0) other.stores.tools.tool[2].length_geometry_mm += 0.5;
        if (seed % 4 == 1) other.stores.work.standard[0].value[0] += 0.3;
        if (seed % 4 == 2)
            other.stores.parameters.set(19700, 0.2 + other.stores.parameters.get(19700));
        if (seed % 4 == 3) other.stores.parameters.set(3401, 0);
        const std::string part =
            seed % 2 ? small_post(small_part(seed)) : own_kinematics_post({1.0, 2.0, 3.0}, 110.0);
        tell(regression::compare_programs(text_of("a.nc", part), setup, text_of("b.nc", part),
                                          other, {}),
             fmt::format("{}", seed), lines, seed % 5 == 0);
    }
    for (const double off_mm : {0.002, 0.2})
        tell(compare_texts(own_kinematics_post({0.0, 0.0, 0.0}, 110.0),
                           own_kinematics_post({off_mm, 0.0, -off_mm}, 110.0 + off_mm), setup),
             fmt::format("pivot {}", off_mm), lines, true);
    told::check_told("regression", "setups", lines);
}

TEST_CASE("told: goldens", "[regression][told]") {
    Lines lines;
    const setup::Setup setup = with_tools(100.0);
    for (std::uint64_t seed = 501; seed <= 504; ++seed) {
        SeededNoise noise(seed);
        const std::string part = small_post(small_part(seed));
        const std::string text = regression::format_golden(
            regression::record_run(setup, text_of("a.nc", part), {}).path, {"first"});
        std::istringstream rows(text);
        for (std::string row; std::getline(rows, row);) lines.push_back(row);
        const std::string path = "told_golden.csv";  // it is named in the report
        std::ofstream(path) << text;
        const regression::Golden golden = regression::parse_golden(text, path);
        for (const int edits : {0, 2})
            tell(regression::compare_with_golden(
                     golden.path, path, text_of("b.nc", with_edits(part, edits, noise)), setup, {}),
                 fmt::format("{} {}", seed, edits), lines, true);
        std::remove(path.c_str());
    }
    told::check_told("regression", "goldens", lines);
}

TEST_CASE("told: programs on two controls", "[regression][told]") {
    Lines lines;
    for (std::uint64_t seed = 601; seed <= 660; ++seed) {
        SeededNoise noise(seed);
        const std::string part = with_edits(small_post(small_part(seed)), 2, noise);
        lines.push_back(fmt::format("== {}", seed));
        const auto found = regression::compare_controls(
            control("fanuc", 100.0),
            control(seed % 2 ? "hurco" : "fanuc", 100.0 + static_cast<double>(seed % 3)),
            interpreter::ProgramText{"t.nc", part, nullptr},
            [] { return std::make_unique<interpreter::ProgramsInMemory>(); });
        for (const regression::ReadingDifference& d : found)
            lines.push_back(
                fmt::format("{}:{}:{} {} {:.5f}", d.program, d.line, d.column, d.text, d.apart));
    }
    told::check_told("regression", "controls", lines);
}
