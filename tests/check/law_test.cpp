// The law: what run refuses when it reaches a block, check refuses. Without TRUNNION_LAW_SEED and
// TRUNNION_LAW_BLOCKS always the same 6000 blocks; ./dev assure gives both.
#include "tests/check/law.h"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

using namespace trunnion;
using law::pick;

namespace {

std::string random_block(SeededNoise& noise) {
    static const std::vector<std::string> values = {
        "0",   "1",           "-1",  "2",       "2.5",       "29.7", "3.", "10.",  "-7.5",
        "100", "17",          "300", "81",      "1000",      "0.25", "98", "6000", "30",
        "8",   "12345678901", "-0",  "1.00005", "99999.999", "-.5",  "+2"};
    static const std::vector<std::string> codes = {
        "G0",    "G1",    "G2",     "G3",     "G4",     "G10",   "G17",   "G18",   "G20",
        "G21",   "G28",   "G30",    "G40",    "G41",    "G42",   "G43",   "G44",   "G49",
        "G43.4", "G51",   "G52",    "G53",    "G54",    "G54.1", "G54.2", "G68",   "G68.2",
        "G53.1", "G69",   "G73",    "G76",    "G81",    "G83",   "G84",   "G80",   "G90",
        "G91",   "G92",   "G96",    "G33",    "G7.1",   "G12.1", "G777",  "M98",   "M99",
        "M6",    "M29.7", "M-1",    "G31",    "G61",    "G5.1",  "G9",    "G15",   "G16",
        "G19",   "G22",   "G23",    "G27",    "G29",    "G38",   "G39",   "G50",   "G50.1",
        "G51.1", "G53.6", "G59",    "G64",    "G65",    "G66",   "G67",   "G68.3", "G68.4",
        "G69.1", "G74",   "G82",    "G85",    "G89",    "G94",   "G95",   "G97",   "G98",
        "G99",   "G10L2", "G10L20", "G10L10", "G10L50", "G11",   "M0",    "M30",   "M198",
        "M19",   "G43.5", "G43.1",  "G02.4",  "G03.4",  "G-1",   "G1.05", "G100",  "M1000",
        "G54.4"};
    static const std::vector<std::string> letters = {"X", "Y", "Z", "B", "C", "A", "I",
                                                     "J", "K", "R", "P", "Q", "L", "H",
                                                     "D", "T", "F", "S", "M", "E"};
    static const std::vector<std::string> statements = {
        "#5001=3",     "#99=1",       "#100=#3099", "#100=#5201", "#100=#3000", "#0=1",
        "#4001=1",     "#100=#40",    "#2001=5.",   "#5121=1",    "#3901=2",    "#900001=1",
        "#100=#20000", "X#5199",      "#250=1",     "#100=#1136", "#1000=1",    "G0X#6000",
        "#13999=1.",   "#100=#13000", "#5320=1",    "#5306=1"};
    if (noise.uniform() < 0.15) return pick(noise, statements);
    std::string block;
    if (noise.uniform() < 0.8) block += pick(noise, codes);
    const int words = static_cast<int>(noise.uniform() * 5.0);
    for (int i = 0; i < words; ++i) block += pick(noise, letters) + pick(noise, values);
    if (noise.uniform() < 0.01)
        for (int i = 0; i < 50; ++i) block += "X1.";
    return block;
}

std::uint64_t wish(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// The alarm of a run through the block, and whether check refuses it.
struct Verdict {
    std::optional<Alarm> alarm;
    bool by_check = false;
};

Verdict judge(const std::string& block) {
    const law::Outcome out = law::judge("O1\nG21G90G17G94G54F200.S500M3\n" + block + "\nM30\n");
    return {out.run.alarm, out.refused_by_check(3)};
}

/// An alarm of the block itself. Nesting and the caller's numbers (77, 78, 122) are known to a run
/// only.
bool refused_by_run(const std::optional<Alarm>& alarm) {
    if (!alarm || alarm->where.line != 3) return false;
    const int n = alarm->number;
    return n != 77 && n != 78 && n != 122 && (n < 3000 || n >= 5000);
}

}  // namespace

TEST_CASE("what run refuses when it reaches a block, check refuses", "[check]") {
    const std::uint64_t seed = wish("TRUNNION_LAW_SEED", 1905),
                        blocks = wish("TRUNNION_LAW_BLOCKS", 6000);
    SeededNoise noise(seed);
    std::array<int, 4> count{};  // [refused by run][refused by check]
    for (std::uint64_t i = 0; i < blocks; ++i) {
        const std::string block = random_block(noise);
        if (block.find("M98") != block.npos && block.find("M99") != block.npos) continue;
        if (block.starts_with("G50") && block.find('S') != block.npos)
            continue;  // a lathe's: check goes no further
        const auto [alarm, by_check] = judge(block);
        const bool by_run = refused_by_run(alarm);
        INFO(block << (alarm ? fmt::format(" run: {} {}", alarm->number, alarm->text) : " runs"));
        if (by_run) CHECK(by_check);
        if (!alarm) CHECK_FALSE(by_check);
        ++count[(by_run ? 2U : 0U) + (by_check ? 1U : 0U)];
    }
    CHECK(double(count[3]) > 0.15 * double(blocks));  // the blocks are not all right
    CHECK(double(count[0]) > 0.08 * double(blocks));  // nor all wrong
    if (std::getenv("TRUNNION_LAW_SEED"))
        std::cout << blocks << " blocks from seed " << seed << ": " << count[3]
                  << " refused by both, " << count[1] << " by check alone, " << count[2]
                  << " by run alone\n";
}

TEST_CASE("check refuses a word also where it does not carry out the block", "[check]") {
    const std::string block =
        GENERATE("M99D6000", "G31K2P1.00005M2", "G10R30C-0P1M98", "G10L2P1X1.M198");
    INFO(block);
    const auto [alarm, by_check] = judge(block);
    CHECK(refused_by_run(alarm));
    CHECK(by_check);
}
