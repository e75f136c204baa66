// The ballbar and pivot programs of a Hurco, from the files that a user writes to what is found.
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

using Json = nlohmann::json;

namespace {

/// The A-C machine on a Hurco control: as declared, and with errors in its rotary axes.
struct Bench : CommandBench {
    explicit Bench(const std::string& nc) {
        std::stringstream file;
        file << std::ifstream(std::string(TRUNNION_SOURCE_DIR) + "/machines/ac_trunnion.toml")
                    .rdbuf();
        std::string text = file.str();
        const auto cut = [&](const std::string& from, const std::string& to, std::string by) {
            const std::size_t begin = text.find(from), end = text.find(to, begin);
            REQUIRE(end != std::string::npos);
            text.replace(begin, end - begin, by);
        };
        cut("dialect = ", "\n", "dialect = \"hurco\"");
        cut("[control.work", "_", "[control.hurco]\nnc = \"" + nc + "\"\n\n[control.work");
        cut("free      = [\"cup\"", "]", "free = [\"length\"");  // else three errors pair with it
        const std::string errors =
            "[machine.errors]\nEY0A_mm = 0.05\nEZ0A_mm = -0.03\nEB0A_rad = 2e-5\nEC0A_rad = -4e-5\n"
            "EX0C_mm = 0.04\nEY0C_mm = 0.02\nEA0C_rad = 3e-5\nEB0C_rad = -1e-5\n";
        cut("[machine.errors]", "\n[control]", errors);
        write("real.toml", text);
        cut("[machine.errors]", "[control]", "");
        write("declared.toml", text);
        std::filesystem::create_directories(path / "nc");
    }
    void run(const std::string& program) const {
        CAPTURE(program);
        CHECK(trunnion("run " + file(program) + " --programs " + file("nc") + " --setup " +
                       file("real.toml") + " --readings " + file("r.csv")) == 0);
        INFO(read("err.txt"));
        CHECK(read("err.txt").find("alarm") == std::string::npos);
    }
    /// Values found by name, with their sigmas.
    std::map<std::string, std::pair<double, double>> identified() const {
        REQUIRE(trunnion("identify " + file("r.csv") + " --effects location --json --setup " +
                         file("declared.toml") + " --out " + file("found.toml")) == 0);
        std::map<std::string, std::pair<double, double>> found;
        const Json result = Json::parse(read("out.txt"));
        for (const Json& p : result["parameters"])
            if (p["sigma"].is_number()) found[p["name"]] = {p["value"], p["sigma"]};
        return found;
    }
    Json stores(const std::string& setup) const {
        REQUIRE(trunnion("pivot --stores --json --setup " + file(setup)) == 0);
        return Json::parse(read("out.txt"))["stores"];
    }
};

}  // namespace

TEST_CASE("a Hurco's ballbar program in ISNC and BNC finds the errors of the given machine") {
    for (const char* const nc : {"isnc", "bnc"}) {
        CAPTURE(nc);
        const Bench bench(nc);
        REQUIRE(bench.trunnion("ballbar --setup " + bench.file("declared.toml") + " --program " +
                               bench.file("nc/b.nc") + " --kinematic-program " +
                               bench.file("nc/k.nc")) == 0);
        CHECK(bench.read("nc/b.nc").find(nc == std::string("bnc") ? "G71G75" : "G21") !=
              std::string::npos);
        bench.run("nc/k.nc");
        bench.run("nc/b.nc");
        const auto found = bench.identified();
        const std::map<std::string, double> given = {
            {"EY0A_mm", 0.05}, {"EZ0A_mm", -0.03}, {"EB0A_rad", 2e-5}, {"EC0A_rad", -4e-5},
            {"EX0C_mm", 0.04}, {"EY0C_mm", 0.02},  {"EA0C_rad", 3e-5}, {"EB0C_rad", -1e-5}};
        for (const auto& [name, value] : given) {
            CAPTURE(name);
            REQUIRE(found.contains(name));
            const auto [fitted, sigma] = found.at(name);
            CAPTURE(value, fitted, sigma);
            CHECK(sigma > 0.0);
            CHECK(std::abs(fitted - value) < 5.0 * sigma);
        }
    }
}

TEST_CASE("a Hurco's pivot programs in ISNC and BNC find the pivots of the given machine") {
    for (const char* const nc : {"isnc", "bnc"}) {
        CAPTURE(nc);
        const Bench bench(nc);
        REQUIRE(bench.trunnion("pivot --write-programs " + bench.file("nc") + " --setup " +
                               bench.file("declared.toml")) == 0);
        bench.run("nc/O8001.nc");
        std::filesystem::copy(bench.file("out.txt"), bench.file("prints.txt"));
        bench.run("nc/O8003.nc");
        std::ofstream(bench.path / "prints.txt", std::ios::app) << bench.read("out.txt");
        (void)bench.identified();
        const Json known = bench.stores("real.toml"), found = bench.stores("found.toml");
        REQUIRE(bench.trunnion("pivot " + bench.file("prints.txt") + " --json --setup " +
                               bench.file("declared.toml")) == 0);
        const Json printed = Json::parse(bench.read("out.txt"))["stores"];
        REQUIRE(known.size() >= 4);
        REQUIRE(found.size() == known.size());
        REQUIRE(printed.size() == known.size());
        for (std::size_t i = 0; i < known.size(); ++i) {
            const double exact_mm = known[i]["exact_mm"];
            CAPTURE(known[i].dump(), found[i].dump(), printed[i].dump());
            CHECK(found[i]["exact_mm"].get<double>() == Approx(exact_mm).margin(2e-3));
            CHECK(printed[i]["exact_mm"].get<double>() == Approx(exact_mm).margin(2e-3));
        }
    }
}
