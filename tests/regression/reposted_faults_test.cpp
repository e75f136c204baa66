// A program posted again (renumbered, other decimals, other word order) with one fault of the post:
// is it found, is its block named, is the cause said? The programs and faults are made here from
// words and share nothing with the code that explains differences.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

using Words = std::vector<std::string>;

/// One block. `id` names it on both sides, whatever line it gets.
struct Block {
    Words words;
    int id = 0;
};
using Blocks = std::vector<Block>;

Words words_of(const std::string& text) {
    Words words(1);
    for (const char c : text)
        if (c == ' ')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

/// Facing, a profile right of the contour, a helix, cycles, a turned and a shifted frame, inverse
/// time, five axes with G43.4, a tilted plane. `{d}` stands for numbers that the seed chooses.
constexpr const char* part = R"(G21 G90 G17 G94 G40 G49 G80
G54.1 P3
T5 M6
S{s} M3
G0 X-40. Y-20.
G43 H5 Z120.
M8
Z102.
G1 Z99.5 F300.
X{a} F900.
Y-10.
X-40.
Y0.
X{a}
G0 Z120.
M9
M5
T6 M6
S6000 M3
G0 X0. Y-50.
G43 H6 Z120. M7
Z102.
G1 Z95. F200.
G42 D6 X0. Y-30. F600.
X25.
G3 X30. Y-25. R5.
G1 Y25.
G3 X25. Y30. R5.
G1 X-25.
G3 X-30. Y25. R5.
G1 Y-25.
G3 X-25. Y-30. R5.
G1 X5.
G40 X5. Y-50.
G0 Z120.
M9
M5
M1
T7 M6
S5000 M3
G55
G0 X{h} Y0.
G43 H7 Z120. M8
Z101.
G3 X{h} Y0. Z97. I-{h} J0. F400.
X{h} Y0. I-{h} J0.
G1 X0. F800.
G4 X0.5
G0 Z120.
M5
T8 M6
S2500 M3
G54.1 P3
G0 X-20. Y20.
G43 H8 Z120. M8
G99 G73 X-20. Y20. Z90. R101. Q2. F150.
X3. Y17.
X20. Y21.
G80
G98 G85 X-20. Y-20. Z{z} R101. F80.
G91 X10. K3
G90
G80
G52 X4. Y-3.
G0 X0. Y0.
Z103.
G1 Z98. F350.
X12. F700.
G0 Z120.
G52 X0. Y0.
G68 X0. Y0. R30.
G0 X5. Y5.
Z103.
G1 Z98.5 F360.
X{b}
Y11.
G69
G0 Z120.
G0 X-10. Y-10.
Z103.
G1 Z99. F400.
G93
X10. F40.
Y10. F30.
X-10. F40.
G94
G1 X-15. F500.
G0 Z200.
M9
M5
T5 M6
S7000 M3
G0 Z250.
G0 B0. C0.
G43.4 H5 Z150.
G0 X-25. Y0. B5. C10.
Z60.
G1 Z50. F500.
X-15. Z51. B{t} C20. F650.
X-5. Y2. Z52. B14. C35.
X5. Y1. Z51. B17. C50.
X15. Y0. Z50. B12. C70.
G0 Z150.
G49
G0 Z250.
G68.2 X0. Y0. Z40. I20. J{t} K0.
G53.1
G43 H5 Z130.
G0 X-5. Y8.
Z32.
G1 Z28. F220.
X{b} F640.
Y14.
G0 Z130.
G49
G69
G0 Z250.
M5
M30)";

/// The part with the seed's numbers.
Blocks part_of(SeededNoise& noise) {
    std::string text = part;
    const auto put = [&](const std::string& name, double low, double high, int decimals) {
        const double share = static_cast<double>(noise.bits() % 10000) / 1e4;
        const std::string number = fmt::format("{:.{}f}", low + share * (high - low), decimals);
        for (std::size_t at; (at = text.find(name)) != std::string::npos;)
            text.replace(at, name.size(), number);
    };
    put("{s}", 3000.0, 5000.0, 0);
    put("{a}", 30.0, 45.0, 3);
    put("{h}", 8.0, 14.0, 3);
    put("{z}", 88.0, 96.0, 2);
    put("{b}", 15.0, 25.0, 3);
    put("{t}", 8.0, 20.0, 2);
    Blocks blocks;
    std::size_t from = 0;
    for (int id = 1; from < text.size(); ++id) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        blocks.push_back({words_of(text.substr(from, end - from)), id});
        from = end + 1;
    }
    return blocks;
}

/// Number of the line of each id (0: not there); the head is one line.
int line_of(const Blocks& blocks, int id) {
    for (std::size_t k = 0; k < blocks.size(); ++k)
        if (blocks[k].id == id) return static_cast<int>(k) + 3;
    return 0;
}

std::string printed(const Blocks& blocks, int first_n, int step) {
    std::string out = "%\nO4000 (PART)\n";
    int n = first_n;
    for (const Block& block : blocks) {
        std::string line = step > 0 ? fmt::format("N{}", n) : "";
        for (const std::string& word : block.words) line += (line.empty() ? "" : " ") + word;
        out += line + "\n";
        n += step;
    }
    return out + "%\n";
}

/// Another post writes it: other decimals, other order of the words of a block.
void post_again(Blocks& blocks, SeededNoise& noise) {
    const int decimals = static_cast<int>(noise.bits() % 3);
    for (Block& block : blocks) {
        for (std::string& word : block.words) {
            if (word.find('.') == std::string::npos || word[0] == 'G') continue;
            if (decimals > 0) word += std::string(static_cast<std::size_t>(decimals), '0');
            while (decimals == 0 && word.back() == '0') word.pop_back();
        }
        for (std::size_t k = block.words.size(); k > 1; --k)
            if (noise.bits() % 2 == 0) std::swap(block.words[k - 1], block.words[noise.bits() % k]);
    }
}

/// A fault: in the `nth` block (from 1) that holds all words of `at`, `what` becomes `with`. An
/// empty `what` with words inserts a block before it; an empty `with` deletes the word, or the
/// whole block when `what` is "*". Several `says` are separated by '|': one of them must be said.
struct Fault {
    const char *name, *at;
    int nth;
    const char *what, *with, *says;
};

constexpr Fault faults[] = {
    {"depth, digits exchanged", "Z99.5", 1, "Z99.5", "Z95.9", "Z95.9 instead of Z99.5"},
    {"feed, a zero lost", "F900.", 1, "F900.", "F90.", "F90 instead of F900"},
    {"speed", "S2500", 1, "S2500", "S250", "S250 instead of S2500"},
    {"turning the other way", "S6000", 1, "M3", "M4", "M4 instead of M3"},
    {"coolant forgotten", "H8", 1, "M8", "", "M8 is missing"},
    {"length of the tool before", "H6", 1, "H6", "H5", "H5 instead of H6"},
    {"length that is not set", "H7", 1, "H7", "H17", "H17 instead of H7"},
    {"radius of the next tool", "D6", 1, "D6", "D7", "D7 instead of D6"},
    {"wrong side", "G42", 1, "G42", "G41", "G41 instead of G42"},
    {"compensation stays", "G40 X5.", 1, "G40", "", "G40 is missing"},
    {"corner radius", "G3 R5.", 2, "R5.", "R6.", "R6. instead of R5."},
    {"the long way round", "G3 R5.", 2, "R5.", "R-5.", "R of opposite sign|R-5. instead of R5."},
    {"arc turns the other way", "G3 R5.", 3, "G3", "G2", "G2 instead of G3"},
    {"arc lost", "G3 R5.", 2, "*", "", "is missing in B"},
    {"helix without depth", "Z97.", 1, "Z97.", "", "Z97. is missing"},
    {"centre of opposite sign", "Z97.", 1, "I-", "I", "I of opposite sign"},
    {"centre absolute", "Z97.", 1, "I-*", "I0.", "I absolute|I0. instead of I-"},
    {"next work offset", "G55", 1, "G55", "G56", "G56 instead of G55"},
    {"next extended offset", "G54.1", 2, "P3", "P4",
     "G54.1 P4 instead of G54.1 P3|P4 instead of P3"},
    {"work offset stays", "G54.1", 2, "*", "",
     "G55 instead of G54.1 P3|G54.1 P3 is missing|G54.1 is missing"},
    {"other peck cycle", "G73", 1, "G73", "G83", "G83 instead of G73"},
    {"peck depth", "G73", 1, "Q2.", "Q.2", "Q.2 instead of Q2."},
    {"R level", "G73", 1, "R101.", "R111.", "R111. instead of R101."},
    {"retract level", "G73", 1, "G99", "G98", "G98 instead of G99"},
    {"drilled instead of bored", "G85", 1, "G85", "G81", "G81 instead of G85"},
    {"incremental lost", "G91", 1, "G91", "", "G91"},
    {"one hole less", "K3", 1, "K3", "K2", "K2 instead of K3"},
    {"rotation, sign", "R30.", 1, "R30.", "R-30.", "R of opposite sign|R-30 instead of G68 R30"},
    {"rotation stays", "G69", 1, "*", "", "G69"},
    {"shift stays", "G52 X0.", 1, "*", "", "G52"},
    {"no tool centre point control", "G43.4", 1, "G43.4", "G43", "G43 instead of G43.4"},
    {"tilt, sign", "B14.", 1, "B14.", "B-14.", "B of opposite sign"},
    {"angle", "C50.", 1, "C50.", "C55.", "C55. instead of C50."},
    {"angles of the plane", "G68.2", 1, "I20.", "I-20.", "I of opposite sign"},
    {"axis not turned", "G53.1", 1, "*", "", "G53.1"},
    {"inverse time number", "F30.", 1, "F30.", "F3.", "F3 instead of F30"},
    {"inverse time stays", "G94", 2, "*", "", "G94"},
    {"dwell", "G4", 1, "X0.5", "X0.05", "dwell 0.5 s -> 0.05 s|X0.05 instead of X0.5"},
    {"decimal point", "X25.", 1, "X25.", "X25", "decimal point"},
    {"plane", "Z97.", 1, "", "G18", "G18"},
};

struct Culprit {
    int line_a = 0, line_b = 0;  ///< 0: that side has no such block
};

bool holds(const Block& block, const Words& all) {
    return std::all_of(all.begin(), all.end(), [&](const std::string& w) {
        return std::find(block.words.begin(), block.words.end(), w) != block.words.end();
    });
}

/// Carries the fault out on B and returns the id of the block; -1: inserted.
int seed_fault(Blocks& b, const Fault& fault) {
    const Words at = words_of(fault.at);
    int nth = fault.nth;
    const auto found = std::find_if(
        b.begin(), b.end(), [&](const Block& block) { return holds(block, at) && --nth == 0; });
    REQUIRE(found != b.end());
    const std::string what = fault.what, with = fault.with;
    if (what.empty()) {
        b.insert(found, {words_of(with), -1});
        return -1;
    }
    const int id = found->id;
    if (what == "*") {
        b.erase(found);
        return id;
    }
    const bool rest = what.back() == '*';
    const std::string start = rest ? what.substr(0, what.size() - 1) : what;
    const bool part_of_word = rest || what == "I-";
    const auto word = std::find_if(
        found->words.begin(), found->words.end(),
        [&](const std::string& w) { return part_of_word ? w.starts_with(start) : w == start; });
    REQUIRE(word != found->words.end());
    if (with.empty())
        found->words.erase(word);
    else if (rest || !part_of_word)
        *word = with;
    else
        word->replace(0, start.size(), with);
    return id;
}

/// Numbers without zeros at the end, so that decimals do not matter to what is said.
std::string plain_numbers(const std::string& text) {
    std::string out;
    bool behind_point = false;
    for (const char c : text) {
        const bool digit = c >= '0' && c <= '9';
        if (!digit) {
            while (behind_point && out.back() == '0') out.pop_back();
            behind_point = c == '.' && !out.empty() && out.back() != ' ';
        }
        out += c;
    }
    return out;
}

bool says_one_of(const std::string& what, const std::string& alternatives) {
    const std::string plain = plain_numbers(what + " ");
    std::size_t from = 0;
    while (from <= alternatives.size()) {
        const std::size_t end = std::min(alternatives.find('|', from), alternatives.size());
        if (plain.find(alternatives.substr(from, end - from)) != std::string::npos) return true;
        from = end + 1;
    }
    return false;
}

setup::Setup part_mill() {
    setup::Setup setup = bc_table();
    for (std::size_t k = 1; k <= 8; ++k) {
        setup.stores.tools.tool[k].length_geometry_mm = 90.0 + 7.0 * static_cast<double>(k);
        setup.stores.tools.tool[k].radius_geometry_mm = 1.0 + 0.5 * static_cast<double>(k);
    }
    setup.stores.work.additional[2][Axis::X] = 6.0;
    setup.stores.work.additional[3][Axis::Y] = 11.0;
    setup.stores.work.standard[1][Axis::Y] = -8.0;
    setup.stores.work.standard[2][Axis::Z] = 3.5;
    return setup;
}

}  // namespace

TEST_CASE("the part posted again is the same machining", "[compare]") {
    const setup::Setup setup = part_mill();
    for (const std::uint64_t seed : {101, 102, 103, 104}) {
        SeededNoise noise(seed);
        const Blocks a = part_of(noise);
        Blocks b = a;
        post_again(b, noise);
        const regression::Comparison r = compare_texts(printed(a, 0, 0), printed(b, 10, 10), setup,
                                                       only(regression::Layer::path));
        INFO(r.verdict << "\n" << printed(b, 10, 10));
        CHECK(r.equal);
        CHECK(r.compared > 60);
    }
}

TEST_CASE("40 faults in parts posted again: 95 percent by block, 80 percent by cause",
          "[compare]") {
    const setup::Setup setup = part_mill();
    int count = 0, found = 0, placed = 0, caused = 0;
    std::string missed;
    for (const Fault& fault : faults) {
        SeededNoise noise(static_cast<std::uint64_t>(1000 + ++count));
        const Blocks a = part_of(noise);
        Blocks b = a;
        const int id = seed_fault(b, fault);
        post_again(b, noise);
        const regression::Comparison r = compare_texts(printed(a, 0, 0), printed(b, 10, 10), setup);
        const Culprit culprit{line_of(a, id), line_of(b, id)};
        const bool any = !r.differences.empty();
        const regression::Difference d = any ? r.differences.front() : regression::Difference{};
        const bool place = any && ((culprit.line_a > 0 && d.a.line == culprit.line_a) ||
                                   (culprit.line_b > 0 && d.b.line == culprit.line_b));
        const bool cause = any && says_one_of(d.what, fault.says);
        found += r.equal ? 0 : 1;
        placed += place ? 1 : 0;
        caused += cause ? 1 : 0;
        if (r.equal || !place || !cause)
            missed += fmt::format("\n  {} (A {}, B {}): {}{}{}", fault.name, culprit.line_a,
                                  culprit.line_b, place ? "" : "[place] ", cause ? "" : "[cause] ",
                                  r.verdict);
    }
    WARN(count << " faults: " << found << " found, " << placed << " by block, " << caused
               << " by cause" << missed);
    CHECK(count == 40);
    CHECK(found == count);
    CHECK(100 * placed >= 95 * count);
    CHECK(100 * caused >= 80 * count);
}
