// Other ways to a verdict of trunnion pivot: a backup's stores, identify's route, a Hurco; its
// page; and what it refuses.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

const std::string machines = std::string(TRUNNION_SOURCE_DIR) + "/machines/";

std::string whole(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
}

struct Bench : CommandBench {
    /// What the programs print on the BC table that ships.
    std::string prints() const {
        REQUIRE(trunnion("pivot --print " + file("p.txt")) == 0);
        return read("p.txt");
    }
    /// Ends with 2 and this message; the prints stay as they are.
    void refuses(const std::string& text, const std::string& why,
                 const std::string& more = "") const {
        write("bad.txt", text);
        CHECK(trunnion("pivot " + file("bad.txt") + " --setup " + machines + "bc_table.toml" +
                       more) == 2);
        CAPTURE(read("err.txt"));
        CHECK(read("err.txt").find(why) != std::string::npos);
        CHECK(read("out.txt").empty());
        CHECK(read("bad.txt") == text);
    }
};

Json store_of(const Json& json, const std::string& words) {
    for (const Json& store : json["stores"])
        if (store["words"] == words) return store;
    FAIL("no store " + words);
    return {};
}

std::string without_stores(const std::string& prints) {
    std::istringstream in(prints);
    std::string out, line;
    while (std::getline(in, line))
        if (line.find("STORE") == std::string::npos) out += line + "\n";
    return out;
}

}  // namespace

TEST_CASE("pivot: the stores in force come from a backup when the prints name none") {
    const Bench bench;
    bench.write("p2.txt", without_stores(bench.prints()));
    fs::create_directories(bench.file("stick"));
    bench.write("stick/EXT_WKZ.TXT", "%\nG90\nG10L2P1X0.1443Y0.1443Z0.1443\nM02\n%\n");
    bench.write("stick/CNC-PARA.TXT",
                "%\nN01020Q1A1P88A2P89A3P90A4P66A5P67\nN19680Q1L1P12\nN19681Q1L1P4\nN19682Q1L1P2\n"
                "N19684Q1L1P1\nN19686Q1L1P5\nN19687Q1L1P3\nN19689Q1L1P1\nN19700Q1L1P0.1443\n"
                "N19701Q1L1P0.1443\nN19702Q1L1P0.0534\nN19703Q1L1P0.0\nN19704Q1L1P0.0\n"
                "N19705Q1L1P0.0909\n%\n");
    // Over a setup whose stores say something else, and alone.
    bench.write("S.toml",
                replaced(whole(machines + "bc_table.toml"), "19700 = 0.1443", "19700 = 5.0"));
    for (const std::string& machine : {" --setup " + bench.file("S.toml"), std::string()}) {
        CAPTURE(machine);
        REQUIRE(bench.trunnion("pivot " + bench.file("p2.txt") + machine + " --control " +
                               bench.file("stick") + " --json") == 0);
        const Json json = Json::parse(bench.read("out.txt"));
        CHECK(store_of(json, "No.19700 (X)")["in_force_mm"] == 0.1443);
        for (const char* words : {"No.19700 (X)", "No.19702 (Z)", "G54 Y"}) {
            CAPTURE(words);
            const Json store = store_of(json, words);
            CHECK(store["stale"] == true);
            CHECK(std::abs(store["type_mm"].get<double>()) < 2e-3);  // the true pivot is 0
        }
    }
}

TEST_CASE("pivot: the touches of the prints, imported, say the same as the printed centres") {
    const Bench bench;
    const std::string setup = " --setup " + machines + "bc_table.toml";
    REQUIRE(bench.trunnion("pivot --write-programs " + bench.file("nc") + setup) == 0);
    std::string prints, tables;
    for (const char* name : {"O8001", "O8003"}) {
        const std::string program = bench.file("nc/" + std::string(name) + ".nc");
        const std::string print = bench.file(std::string(name) + ".txt");
        const std::string table = bench.file(std::string(name) + ".csv");
        REQUIRE(bench.trunnion("run " + program + " --programs " + bench.file("nc") + setup +
                               " --print " + print) == 0);
        REQUIRE(bench.trunnion("import dprnt " + print + setup + " --out " + table) == 0);
        prints += " " + print;
        tables += " " + table;
    }
    REQUIRE(bench.trunnion("pivot" + prints + setup + " --json") == 0);
    const Json printed = Json::parse(bench.read("out.txt"));
    REQUIRE(bench.trunnion("pivot" + tables + setup + " --json") == 0);
    const Json touched = Json::parse(bench.read("out.txt"));
    REQUIRE(touched["stores"].size() == printed["stores"].size());
    for (std::size_t i = 0; i < printed["stores"].size(); ++i) {
        const Json &a = printed["stores"][i], &b = touched["stores"][i];
        CAPTURE(a.dump(), b.dump());
        CHECK(a["stale"] == b["stale"]);
        CHECK(b["exact_mm"].get<double>() == Approx(a["exact_mm"].get<double>()).margin(2e-4));
    }
}

TEST_CASE("pivot: identify's machine and the stores alone lead to the same numbers") {
    const Bench bench;
    struct Kind {
        const char *file, *errors;
        std::vector<std::string> programs;
    };
    for (const Kind& kind :
         {Kind{"bc_table.toml", "EX0B_mm = 0.05\nEZ0B_mm = -0.03\nEY0C_mm = 0.04\n", {"O8003"}},
          Kind{"head_table.toml", "EX0C_mm = 0.05\nEY0C_mm = -0.03\n", {"O8003"}}}) {
        CAPTURE(kind.file);
        const std::string declared = whole(machines + kind.file);
        REQUIRE(declared.find("[machine.errors]") == std::string::npos);
        bench.write("declared.toml", declared);
        bench.write("real.toml",
                    replaced(declared, "\n[control]\n",
                             "\n[machine.errors]\n" + std::string(kind.errors) + "\n[control]\n"));
        REQUIRE(bench.trunnion("pivot --write-programs " + bench.file("nc") + " --setup " +
                               bench.file("declared.toml")) == 0);
        REQUIRE(bench.trunnion("run " + bench.file("nc/O8003.nc") + " --programs " +
                               bench.file("nc") + " --setup " + bench.file("real.toml") +
                               " --readings " + bench.file("r.csv")) == 0);
        REQUIRE(bench.trunnion("identify " + bench.file("r.csv") + " --setup " +
                               bench.file("declared.toml") + " --effects location --out " +
                               bench.file("found.toml")) == 0);
        REQUIRE(bench.trunnion("pivot --stores --json --setup " + bench.file("found.toml")) == 0);
        const Json found = Json::parse(bench.read("out.txt"));
        REQUIRE(bench.trunnion("pivot --stores --json --setup " + bench.file("real.toml")) == 0);
        const Json known = Json::parse(bench.read("out.txt"));
        REQUIRE(found["stores"].size() == known["stores"].size());
        for (std::size_t i = 0; i < known["stores"].size(); ++i) {
            CAPTURE(known["stores"][i].dump(), found["stores"][i].dump());
            CHECK(found["stores"][i]["exact_mm"].get<double>() ==
                  Approx(known["stores"][i]["exact_mm"].get<double>()).margin(2e-3));
        }
    }
}

TEST_CASE("pivot: a Hurco's verdict speaks of M128 and centrelines, marked assumed") {
    const Bench bench;
    const std::string setup =
        bench.write("H.toml", replaced(whole(machines + "ac_trunnion.toml"), "dialect = \"fanuc\"",
                                       "dialect = \"hurco\""));
    REQUIRE(bench.trunnion("pivot --setup " + setup) == 0);
    const std::string text = bench.read("out.txt");
    for (const char* words : {"A centreline Y", "C centreline X",
                              "(the field names of the part set-up "
                              "are assumed)",
                              "The rotary centrelines of the part set-up are stale", "M128 parts"})
        CHECK_THAT(text, Catch::Contains(words));
    CHECK_THAT(text,
               !Catch::Contains("1970") && !Catch::Contains("G43.4") && !Catch::Contains("G54.2"));
}

TEST_CASE("pivot: the page shows the day, the maps beside the expected ones and its origin") {
    const Bench bench;
    const std::string prints = bench.prints();
    bench.write("day.txt", "STORE DATE V20240312\n" + prints);
    const std::string words = "pivot " + bench.file("day.txt") + " --setup " + machines +
                              "bc_table.toml --html " + bench.file("page.html");
    REQUIRE(bench.trunnion(words) == 0);
    const std::string page = bench.read("page.html");
    for (const char* text :
         {"measured 2024-03-12", "BC rotary table", "B arc at C90", "expected",
          "Circle of each map, measured beside expected", "<title>Eccentric circle of each map",
          "What to type", "Not observable from these readings", "How to read this",
          "Content-Security-Policy", "trunnion pivot", "SHA-256"})
        CHECK_THAT(page, Catch::Contains(text));
    CHECK_THAT(page, !Catch::Contains("nan"));
    REQUIRE(bench.trunnion(words) == 0);
    CHECK(bench.read("page.html") == page);
}

TEST_CASE("pivot: prints of another machine are refused") {
    const Bench bench;
    bench.refuses(replaced(bench.prints(), "AXES B C", "AXES A C"), "prints of another machine");
}

TEST_CASE("pivot: prints of a run that stopped are refused") {
    const Bench bench;
    bench.refuses(replaced(bench.prints(), "RTDFO END", ""), "RTDFO has no END");
}

TEST_CASE("pivot: a missing map is refused") {
    const Bench bench;
    std::istringstream in(bench.prints());
    std::string text, line;
    while (std::getline(in, line))
        if (line.find("RTCP MAP 3") == std::string::npos &&
            line.find("RTCP MAP3") == std::string::npos)
            text += line + "\n";
    bench.refuses(text, "map 3 of RTCP is missing");
}

TEST_CASE("pivot: functions under each other's name are refused") {
    const Bench bench;
    std::string text = bench.prints();
    for (std::size_t at = 0; (at = text.find("DPP", at)) != std::string::npos; at += 3)
        text.replace(at, 3, "?!?");
    for (std::size_t at = 0; (at = text.find("RTCP", at)) != std::string::npos; at += 3)
        text.replace(at, 4, "DPP");
    for (std::size_t at = 0; (at = text.find("?!?", at)) != std::string::npos; at += 4)
        text.replace(at, 3, "RTCP");
    bench.refuses(text, "mixed up");
    // Lines of one function inside the run of another.
    bench.refuses(replaced(bench.prints(), "PIVOT TW AXES", "PIVOT RTCP AXES"),
                  "RTCP stands twice");
}

TEST_CASE("pivot: values in another unit are refused") {
    const Bench bench;
    const std::string prints = bench.prints();
    const std::size_t at = prints.find(" X", prints.find("DPP MAP 1 B"));
    REQUIRE(at != std::string::npos);
    bench.refuses(std::string(prints).insert(prints.find('.', at + 2), "144"),
                  "another unit or another machine");
}

TEST_CASE("pivot: a file that is read is never written") {
    const Bench bench;
    const std::string prints = bench.prints();
    for (const char* option : {" --html ", " --print "})
        bench.refuses(prints, "would overwrite", option + bench.file("bad.txt"));
}

TEST_CASE("identify notes the stores that the programmed points of its readings name",
          "[cli][pivot]") {
    const Bench bench;
    const std::string shipped = machines + "bc_table.toml";
    REQUIRE(bench.trunnion("run 8003 --print " + bench.file("p.txt")) == 0);
    REQUIRE(bench.trunnion("import dprnt " + bench.file("p.txt") + " --setup " + shipped +
                           " --out " + bench.file("r.csv")) == 0);
    const std::string other =
        bench.write("other.toml", replaced(whole(shipped), "19700 = 0.1443", "19700 = 0.2"));
    const auto notes_with = [&](const std::string& setup) {
        REQUIRE(bench.trunnion("identify " + bench.file("r.csv") + " --setup " + setup +
                               " --effects C.backlash") == 0);
        return bench.read("err.txt");
    };
    CHECK(notes_with(shipped).find("px_mm") == std::string::npos);
    CHECK(notes_with(other).find("19700 is 0.1443 in force, 0.2000 in the setup") !=
          std::string::npos);
}
