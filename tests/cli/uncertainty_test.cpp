// Covariance of an identification and derivatives of a prediction, as the commands print them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "records/readings.h"
#include "tests/cli/command_bench.h"
#include "tests/support/campaign.h"

using namespace trunnion;
using Json = nlohmann::json;

namespace {

/// Parts of a text between marks.
std::vector<std::string> split(const std::string& text, char mark) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, mark);) parts.push_back(part);
    return parts;
}

struct Campaign : CommandBench {
    setup::Setup setup = campaign::bc_setup();
    std::string readings, file_of_setup;
    Campaign() {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 40, 5);
        const setup::Setup real = campaign::real_machine(setup);
        readings = write("r.csv", records::format_readings(campaign::measured(real, table, 3)));
        file_of_setup = write("s.toml", setup::format_setup(setup));
    }
    records::ReadingTable predicted(const setup::Setup& changed) const {
        write("changed.toml", setup::format_setup(changed));
        REQUIRE(trunnion("predict " + readings + " --setup " + file("changed.toml")) == 0);
        std::vector<std::string> notes;
        return records::parse_readings(read("out.txt"), "out", notes);
    }
};

}  // namespace

TEST_CASE("identify --json: variances are the squares of the sigmas, correlations fit them") {
    const Campaign bench;
    REQUIRE(bench.trunnion("identify " + bench.readings + " --json --setup " +
                           bench.file_of_setup) == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    const Json& c = json["covariance"];
    const std::size_t n = c["names"].size();
    REQUIRE(n >= 8);
    REQUIRE(c["matrix"].size() == n);
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(c["correlation"][i][i].get<double>() == Approx(1.0));
        for (std::size_t k = 0; k < n; ++k) {
            CHECK(std::abs(c["correlation"][i][k].get<double>()) <= 1.0 + 1e-9);
            CHECK(c["matrix"][i][k].get<double>() ==
                  Approx(c["matrix"][k][i].get<double>()).margin(1e-15));
        }
    }
    const Json& first = json["parameters"][0];
    CHECK(c["names"][0] ==
          first["effect"].get<std::string>() + "." + first["name"].get<std::string>());
    CHECK(std::sqrt(c["matrix"][0][0].get<double>()) == Approx(first["sigma"].get<double>()));
}

TEST_CASE("shards of --monte-carlo merge to the bytes of one process") {
    const Campaign bench;
    const std::string call =
        "identify " + bench.readings + " --setup " + bench.file_of_setup + " --monte-carlo 7 ";
    REQUIRE(bench.trunnion(call + "--json") == 0);
    const std::string whole = bench.read("out.txt");
    for (const int count : {1, 2, 7, 9}) {
        std::string parts;
        for (int i = count; i >= 1; --i) {
            REQUIRE(bench.trunnion(call + "--shard " + std::to_string(i) + "/" +
                                   std::to_string(count) + " --out " + bench.file("p{i}.json")) ==
                    0);
            parts += " " + bench.file("p" + std::to_string(i) + ".json");
        }
        REQUIRE(bench.trunnion("merge --json" + parts) == 0);
        CHECK(bench.read("out.txt") == whole);
    }
    CHECK(bench.trunnion("merge " + bench.file("p1.json") + " " + bench.file("p2.json")) == 2);
    CHECK(bench.read("err.txt").find("repetition 3 of 7 is in no part") != std::string::npos);
    CHECK(bench.trunnion("merge " + bench.file("p1.json") + " " + bench.file("p1.json")) == 2);
    bench.write("broken.json", bench.read("p1.json").replace(60, 4, "{}{}"));
    CHECK(bench.trunnion("merge " + bench.file("broken.json")) == 2);
    CHECK(bench.trunnion("identify " + bench.readings + " --setup " + bench.file_of_setup +
                         " --shard 1/2") == 2);
}

TEST_CASE("predict --jacobian: the derivatives are differences of predictions") {
    const Campaign bench;
    REQUIRE(bench.trunnion("predict " + bench.readings + " --setup " + bench.file_of_setup +
                           " --jacobian " + bench.file("j.csv")) == 0);
    const auto lines = split(bench.read("j.csv"), '\n');
    const auto names = split(lines[0], ',');
    const auto column =
        std::find_if(names.begin(), names.end(),
                     [](auto& name) { return name.find("EX0C") != std::string::npos; }) -
        names.begin();
    REQUIRE(column < static_cast<long>(names.size()));
    constexpr double step_mm = 1e-3;
    setup::Setup more = bench.setup, less = bench.setup;
    more.machine.errors.location({'X', true, Axis::C}) += step_mm;
    less.machine.errors.location({'X', true, Axis::C}) -= step_mm;
    const records::ReadingTable above = bench.predicted(more), below = bench.predicted(less);
    std::size_t line = 1;
    for (std::size_t i = 0; i < above.rows.size(); ++i) {
        if (!above.rows[i].value_mm || above.rows[i].device == records::Device::none) continue;
        const double difference =
            (*above.rows[i].value_mm - *below.rows[i].value_mm) / (2.0 * step_mm);
        const auto cells = split(lines[line++], ',');
        CHECK(*parse_number(cells[static_cast<std::size_t>(column)]) ==
              Approx(difference).margin(1e-6));
    }
    CHECK(line == lines.size());
}
