// identify, diagnose, predict, compensate at the command line: what they refuse, and the whole loop
// from readings to a compensated program.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"
#include "tests/support/campaign.h"

using namespace trunnion;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

using Bench = CommandBench;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    return text;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line + ',');
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

/// A good table of a small campaign, to be spoilt.
struct Good {
    setup::Setup setup = campaign::bc_setup();
    std::vector<std::string> lines;
    std::size_t header = 0;
    Good() {
        records::ReadingTable table = campaign::empty_table(setup);
        table.comment = {{"schema", "trunnion.readings/1"}};
        table.optional_columns = {"mode", "feed_mm_min"};
        campaign::add_sphere_map(table, setup, 12, 3);
        lines = lines_of(records::format_readings(campaign::measured(setup, table, 1)));
        while (lines[header][0] == '#') ++header;
    }
    std::size_t column(const std::string& name) const {
        const auto names = cells_of(lines[header]);
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                        names.begin());
    }
    /// The table with one cell of row `row` (from 1) changed.
    std::vector<std::string> with(std::size_t row, const std::string& name,
                                  const std::string& value) const {
        std::vector<std::string> spoilt = lines;
        auto cells = cells_of(spoilt[header + row]);
        cells.at(column(name)) = value;
        std::string line;
        for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
        spoilt[header + row] = line;
        return spoilt;
    }
    std::string place(std::size_t row) const {  // "table.csv:LINE:"
        return "table.csv:" + std::to_string(header + row + 1) + ":";
    }
};

}  // namespace

TEST_CASE("bad readings: one message with its place, exit code 2, no verdict, nothing written") {
    const Bench bench;
    const Good good;
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    struct Case {
        std::string what;
        std::vector<std::string> lines;
        std::string place, message;
    };
    const auto head = [&](std::size_t rows) {
        return std::vector<std::string>(
            good.lines.begin(), good.lines.begin() + static_cast<long>(good.header + 1 + rows));
    };
    const auto without = [&](const std::string& name) {
        std::vector<std::string> spoilt = good.lines;
        spoilt[good.header].replace(spoilt[good.header].find(name), name.size(), "other");
        return spoilt;
    };
    std::vector<std::string> micrometres = good.lines;
    for (std::size_t i = good.header + 1; i < micrometres.size(); ++i) {
        const auto comma = micrometres[i].rfind(',');
        if (comma + 1 < micrometres[i].size())
            micrometres[i] = micrometres[i].substr(0, comma + 1) +
                             std::to_string(1e3 * std::stod(micrometres[i].substr(comma + 1)));
    }
    std::vector<std::string> other_axis = good.lines, other_side = good.lines;
    for (std::size_t i = good.header; i < other_axis.size(); ++i)
        other_axis[i] += i == good.header ? ",a_deg" : ",0";
    other_side.insert(other_side.begin(), "# side = X+ Q-");
    const std::string time_before = cells_of(good.lines[good.header + 5])[good.column("time_s")];
    const Case cases[] = {
        {"empty", {}, "table.csv:1:", "header"},
        {"comments only", {good.lines[0]}, "table.csv:1:", "header"},
        {"no rows", head(0), "table.csv:", "no rows"},
        {"one row", head(3), "table.csv", "reading"},
        {"no time column", without("time_s"), "table.csv:", "time_s"},
        {"no value column", without("value_mm"), "table.csv:", "value_mm"},
        {"no device column", without("device"), "table.csv:", "device"},
        {"no feature column", without("feature"), "table.csv:", "feature"},
        {"no axis of the machine", without("b_deg"), "table.csv", "axis B"},
        {"an axis that the chain lacks", other_axis, "table.csv:", "column 'a_deg'"},
        {"side of an axis that the chain lacks", other_side, "table.csv:1:13:", "side of an axis"},
        {"100 mm residual", good.with(8, "value_mm", "100"), good.place(8), "100 mm"},
        {"micrometres", micrometres, "table.csv:", "um"},
        {"time runs back", good.with(6, "time_s", "1"), good.place(6), "backwards"},
        {"equal time, other place", good.with(6, "time_s", time_before), good.place(6),
         "other axis positions"},
        {"not a number", good.with(8, "value_mm", "nan"), good.place(8), "nan"},
        {"infinite position", good.with(8, "x_mm", "inf"), good.place(8), "inf"},
        {"empty position", good.with(8, "x_mm", ""), good.place(8), "axis position"},
        {"a device nobody has", good.with(8, "device", "laser"), good.place(8), "device"},
        {"an artefact nobody has", good.with(8, "feature", "S9"), good.place(8), "S9"},
        {"no value", good.with(8, "value_mm", ""), good.place(8), "value_mm"},
        {"no direction", good.with(8, "dir_y", "0.5"), good.place(8), "unit vector"},
        {"a mode nobody has", good.with(8, "mode", "tcpm"), good.place(8), "mode"},
        {"a cell too few", good.with(8, "value_mm", "0.1,7"), good.place(8), "cells"}};
    for (const Case& c : cases) {
        const std::string table = bench.write("table.csv", text_of(c.lines));
        for (const std::string& command :
             {"diagnose " + table + " --html " + bench.file("x.html"), "identify " + table}) {
            INFO(c.what << ": " << command);
            CHECK(bench.trunnion(command + " --setup " + setup + " --json --out " +
                                 bench.file("x.toml")) == 2);
            const std::string message = bench.read("err.txt");
            INFO(message);
            CHECK(bench.read("out.txt").empty());
            CHECK_THAT(message, Catch::Contains(c.place) && Catch::Contains(c.message));
            CHECK(std::count(message.begin(), message.end(), '\n') <= 4);  // message, line, caret
            CHECK_FALSE(fs::exists(bench.file("x.toml")));
            CHECK_FALSE(fs::exists(bench.file("x.html")));
        }
    }
}

TEST_CASE("a setup of another machine and bad held-out readings are refused") {
    const Bench bench;
    const Good good;
    const std::string table = bench.write("table.csv", text_of(good.lines));
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    const std::string ac = bench.write("ac.toml", setup::format_setup(campaign::ac_setup()));
    setup::Setup shifted = good.setup;
    for (kinematics::AxisGeometry& axis : shifted.machine.chain.work) axis.point_mm.x() += 90.0;
    const std::string far = bench.write("far.toml", setup::format_setup(shifted));
    setup::Setup bare = good.setup;
    bare.probe.reset();
    const std::string blind = bench.write("blind.toml", setup::format_setup(bare));
    const std::string bad = bench.write("bad.csv", text_of(good.with(8, "value_mm", "")));
    const std::pair<std::string, std::string> cases[] = {
        {table + " --setup " + ac, "the machine's"},
        {table + " --setup " + far, "another machine"},
        {table + " --setup " + blind, "[probe]"},
        {table + " --setup " + bench.file("none.toml"), "none.toml"},
        {bench.file("none.csv") + " --setup " + setup, "none.csv"},
        {table + " --setup " + setup + " --holdout " + bad, good.header > 0 ? "bad.csv:" : ""},
        {table + " --setup " + setup + " --holdout " + bench.file("none.csv"), "none.csv"}};
    for (const auto& [words, message] : cases) {
        INFO(words);
        CHECK(bench.trunnion("diagnose " + words + " --out " + bench.file("x.toml")) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains(message));
        CHECK(bench.read("out.txt").empty());
        CHECK_FALSE(fs::exists(bench.file("x.toml")));
    }
    CHECK(bench.trunnion("identify " + table + " --setup " + setup + " --effects C.wobble") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("C.wobble"));
}

TEST_CASE("a large gap that is true: refused with a message, or warned of and accepted") {
    const Bench bench;
    const Good good;
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    const std::string table = bench.write("table.csv", text_of(good.with(8, "value_mm", "-5.6")));
    for (const char* command : {"identify ", "diagnose "}) {
        INFO(command);
        CHECK(bench.trunnion(command + table + " --setup " + setup) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("--allow-large"));
        CHECK(bench.trunnion(command + table + " --allow-large --setup " + setup) == 0);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("accepted"));
        CHECK_FALSE(bench.read("out.txt").empty());
    }
}

TEST_CASE("the lag of a servo is no wrong unit, a jump at rest is") {
    const Bench bench;
    const Good good;
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    const auto log = [&](double jump_mm) {
        std::string text = "index,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,c_deg,value_mm\n";
        for (int k = 0; k < 400; ++k) {  // 500 mm/s and a lag of 20 ms: 10 mm
            const double phase = 0.01 * k;
            text += fmt::format("{},{},log,axis,X,{},0,0,0,0,{}\n", k, phase,
                                500.0 * std::sin(phase), -10.0 * std::cos(phase));
        }
        return bench.write("log.csv", text + fmt::format("400,8,rest,axis,X,0,0,0,0,0,{}\n"
                                                         "401,9,rest,axis,X,0,0,0,0,0,0\n",
                                                         jump_mm));
    };
    CHECK(bench.trunnion("identify " + log(0.0) + " --setup " + setup) == 0);
    // The mean of the lag's part of a turn, 1.9 mm, is taken for the encoder's zero.
    CHECK(bench.trunnion("identify " + log(9.0) + " --setup " + setup) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("log.csv:402: error: a residual of 7."));
}

TEST_CASE("several tables are read as one") {
    const Bench bench;
    const Good good;
    const std::string table = bench.write("table.csv", text_of(good.lines));
    const std::string again = bench.write("again.csv", text_of(good.with(8, "value_mm", "")));
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    const std::string more = bench.write("more.csv", text_of(good.with(8, "value_mm", "0.0123")));
    REQUIRE(bench.trunnion("diagnose " + table + " " + more + " --json --setup " + setup) == 0);
    CHECK(Json::parse(bench.read("out.txt"))["readings"] == 72);
    CHECK(bench.trunnion("diagnose " + table + " " + again + " --json --setup " + setup) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("again.csv:"));
    // The same file twice would pass for repeats without noise.
    CHECK(bench.trunnion("diagnose " + table + " " + table + " --setup " + setup) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("given twice"));
    // Held out they would confirm whatever was fitted to them.
    const std::string held = bench.write("held.csv", text_of(good.lines));
    CHECK(bench.trunnion("diagnose " + table + " --holdout " + held + " --setup " + setup) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains(held + ": error: the same readings"));
}

TEST_CASE("files of two dates are compared: text, JSON, page and the machine of the last") {
    const Bench bench;
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    table.comment = {{"schema", "trunnion.readings/1"}};
    table.optional_columns = {"mode", "feed_mm_min"};
    campaign::add_sphere_map(table, setup, 40, 3);
    const setup::Setup worn = campaign::with_effect(setup, "C.backlash: gap_rad=8e-5");
    const std::string machine = bench.write("setup.toml", setup::format_setup(setup));
    const std::string monday =
        bench.write("monday.csv", records::format_readings(campaign::measured(setup, table, 1)));
    const std::string friday =
        bench.write("friday.csv", records::format_readings(campaign::measured(worn, table, 2)));
    const std::string files = "diagnose " + monday + " " + friday + " --setup " + machine;
    const std::string page = bench.file("changes.html"), later = bench.file("friday.toml");
    REQUIRE(bench.trunnion(files + " --over sessions --html " + page + " --out " + later) == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("C.backlash since friday"));
    CHECK_THAT(
        bench.read("out.txt"),
        Catch::Contains("Between the sessions the machine changed: C.backlash since friday"));
    CHECK_THAT(bench.read("changes.html"), Catch::Contains("What changed between the sessions"));
    REQUIRE(bench.trunnion(files + " --over sessions --json") == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(json["causes"][0]["effect"] == "C.backlash");
    CHECK(json["causes"][0]["since"] == "friday");
    CHECK(json["over"]["sessions"].size() == 2);
    CHECK(json["over"]["changes"][0]["claimed"] == true);
    CHECK(json["over"]["changes"][0]["before"] == Approx(0.0).margin(1e-9));
    CHECK(json["over"]["changes"][0]["change"] == Approx(8e-5).epsilon(0.1));
    // The written machine is that of friday: nothing is left of its gap.
    REQUIRE(bench.trunnion("diagnose " + friday + " --json --setup " + later) == 0);
    CHECK(Json::parse(bench.read("out.txt"))["verdict"] == "no-gap");
    CHECK(bench.trunnion("diagnose " + friday + " --over sessions --setup " + machine) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("needs two of them or more"));
    CHECK(bench.trunnion(files + " --over dates") == 2);
}

TEST_CASE("repetitions that are interrupted count as far as they are done") {
    const Bench bench;
    const Good good;
    const std::string table = bench.write("table.csv", text_of(good.lines));
    const std::string setup = bench.write("setup.toml", setup::format_setup(good.setup));
    CHECK(bench.interrupted("identify " + table + " --setup " + setup +
                            " --monte-carlo 100000 --json --out " + bench.file("x.toml")) == 4);
    const Json first = Json::parse(bench.read("out.txt"))["parameters"][0];
    CHECK(first["sigma_monte_carlo"].get<double>() > 0.0);
    CHECK(fs::exists(bench.file("x.toml")));
    CHECK_THAT(bench.read("err.txt"),
               Catch::Contains("of 100000 repetitions completed") && !Catch::Contains("\r"));
}

TEST_CASE("injections are refused with one message") {
    const Bench bench;
    bench.write("t.nc", "O1\nM30\n");
    const std::pair<const char*, const char*> cases[] = {
        {"C.wobble=60urad", "no effect is named 'C.wobble'"},
        {"A.backlash=60urad", "no effect is named 'A.backlash'"},
        {"C.backlash=60um", "unit 'um' does not fit"},
        {"C.backlash=60furlong", "furlong"},
        {"C.backlash=", "a number is missing"},
        {"C.backlash: gap=60urad", "no parameter 'gap'"}};
    for (const auto& [text, message] : cases) {
        INFO(text);
        CHECK(bench.trunnion("run " + bench.file("t.nc") + " --inject '" + text + "'") == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains(message));
    }
    CHECK(bench.trunnion("run " + bench.file("t.nc") + " --inject C.backlash=60urad") == 0);
}

namespace {

double rms_between(const records::ReadingTable& a, const records::ReadingTable& b) {
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        if (!a.rows[i].value_mm) continue;
        sum += std::pow(*a.rows[i].value_mm - *b.rows[i].value_mm, 2);
        rows += 1.0;
    }
    return 1e3 * std::sqrt(sum / rows);
}

records::ReadingTable table_in(const std::string& text) {
    std::vector<std::string> notes;
    return records::parse_readings(text, "out.txt", notes);
}

/// Columns of a trace by name, rows of moves only.
std::vector<Vector3> points(const std::string& csv, const std::string& prefix) {
    const auto lines = lines_of(csv);
    const auto names = cells_of(lines[0]);
    const auto at = std::find(names.begin(), names.end(), prefix + "x_mm") - names.begin();
    std::vector<Vector3> list;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const auto cells = cells_of(lines[i]);
        const auto k = static_cast<std::size_t>(at);
        list.emplace_back(std::stod(cells[k]), std::stod(cells[k + 1]), std::stod(cells[k + 2]));
    }
    return list;
}

}  // namespace

TEST_CASE("the loop: readings, diagnosis, setup, prediction, compensated program") {
    const Bench bench;
    setup::Setup setup = campaign::bc_setup();
    const setup::Setup real =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash: gap_rad=1.2e-4");
    records::ReadingTable campaign = campaign::empty_table(setup),
                          fresh = campaign::empty_table(setup);
    campaign::add_sphere_map(campaign, setup, 60, 5);
    campaign::add_sphere_map(fresh, setup, 30, 77);
    const std::string before = bench.write("before.toml", setup::format_setup(setup));
    const std::string truth = bench.write("truth.toml", setup::format_setup(real));
    const std::string readings = bench.write(
        "readings.csv", records::format_readings(campaign::measured(real, campaign, 3)));
    const records::ReadingTable seen = campaign::measured(real, fresh, 4);
    const std::string held = bench.write("held.csv", records::format_readings(seen));

    REQUIRE(bench.trunnion("diagnose " + readings + " --setup " + before + " --holdout " + held +
                           " --out " + bench.file("after.toml") + " --json") == 0);
    const Json diagnosis = Json::parse(bench.read("out.txt"));
    REQUIRE(diagnosis["causes"][0]["effect"] == "C.backlash");
    CHECK(diagnosis["causes"][0]["parameters"][0]["value"].get<double>() ==
          Approx(1.2e-4).epsilon(0.05));
    CHECK(diagnosis["after"]["heldout_shrink"].get<double>() > 0.9);

    const auto predict = [&](const std::string& name) {
        REQUIRE(bench.trunnion("predict " + held + " --setup " + bench.file(name)) == 0);
        return table_in(bench.read("out.txt"));
    };
    const double gap_before = rms_between(predict("before.toml"), seen);
    const double gap_after = rms_between(predict("after.toml"), seen);
    CHECK(gap_before > 5.0);
    CHECK(gap_after < 1.0);  // the noise, 0.8 um, and a little of the fit

    // Cut with the machine as it is: the program as written, and compensated by what was diagnosed.
    bench.write("part.nc",
                "O7\nG90 G17 G21 G40 G49 G80 G94\nG54\nG0 B0 C0\nG0 X60. Y20. Z250.\n"
                "G0 B-30. C40.\nG1 X80. Y10. Z230. F1000.\nG1 B20. C100. X50.\n"
                "G1 B35. C60. Y40.\nG1 X20. Y-30. C10.\nM30\n");
    REQUIRE(bench.trunnion("compensate " + bench.file("part.nc") + " --setup " +
                           bench.file("after.toml") + " --out " + bench.file("better.nc")) == 0);
    const auto cut = [&](const std::string& program, const std::string& machine,
                         const std::string& trace) {
        REQUIRE(bench.trunnion("run " + bench.file(program) + " --setup " + bench.file(machine) +
                               " --truth --trace " + bench.file(trace)) == 0);
        return bench.read(trace);
    };
    const auto wanted = points(cut("part.nc", "before.toml", "wanted.csv"), "true_");
    const auto plain = points(cut("part.nc", "truth.toml", "plain.csv"), "true_");
    const auto better = points(cut("better.nc", "truth.toml", "better.csv"), "true_");
    REQUIRE(wanted.size() == plain.size());
    double error_plain = 0.0, error_better = 0.0;
    // The compensated program may hold more blocks: its corners are the wanted ones in order.
    for (std::size_t i = 2; i < wanted.size(); ++i) {
        error_plain = std::max(error_plain, (plain[i] - wanted[i]).norm());
        double nearest = 1e9;
        for (const Vector3& p : better) nearest = std::min(nearest, (p - wanted[i]).norm());
        error_better = std::max(error_better, nearest);
    }
    CHECK(error_plain > 0.015);
    CHECK(error_better < 0.25 * error_plain);
}
