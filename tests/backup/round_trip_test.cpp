// Generated backups of both generations come back byte for byte, and changes touch digits alone.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>

#include "backup/control_files.h"
#include "backup/differences.h"
#include "backup/folder_files.h"
#include "backup/parameter_names.h"
#include "backup/value_text.h"
#include "base/random.h"

using namespace trunnion;

namespace {

/// A backup with its own choice of generation, tool memory, line ends and blanks.
class Generated {
  public:
    explicit Generated(std::uint64_t seed) : random_(seed) {
        static const char* const ends[] = {"\n", "\r\n", "\n\r\r", "\r"};
        end_ = ends[pick(4)];
        old_ = pick(2) == 1;
        backup.folder = "stick";
        backup.files["CNC-PARA.TXT"] = parameters();
        backup.files["EXT_WKZ.TXT"] = work_offsets();
        backup.files["TOOLOFST.TXT"] = tools();
        backup.files["MACRO.TXT"] = variables();
        backup.files["ALL-PROG.TXT"] = envelope({"O0001(PART*ONE)", "G0X1.", "M30"});
    }
    backup::ControlBackup backup;

  private:
    int pick(int n) { return static_cast<int>(random_.bits() % static_cast<unsigned>(n)); }
    std::string decimal() {
        return fmt::format("{}{}.{}", pick(2) ? "-" : "", pick(900), pick(3) ? pick(1000) : 0);
    }
    std::string bits() { return fmt::format("{:08b}", pick(256)); }
    std::string envelope(const std::vector<std::string>& lines) {
        std::string text = pick(2) ? "%(CNCID=3C7B5D01,F6914B1A)" + end_ : std::string("%") + end_;
        for (const std::string& line : lines)
            text += line + (pick(4) ? "" : " ") + end_ + (pick(20) ? "" : end_);
        return text + (pick(2) ? "%" : "%" + end_);
    }
    /// N19700Q1L1P0.0L2P0.0, or N01825 A1 P 3000 A2 P 3000.
    std::string record(int number, char kind, const std::vector<std::string>& values) {
        const char* const blank = old_ ? " " : "";
        std::string line = fmt::format("N{:05}{}{}", number, old_ ? "" : "Q1", blank);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (kind != 0) line += fmt::format("{}{}{}", kind, i + 1, blank);
            line += std::string("P") + blank + values[i] + (i + 1 < values.size() ? blank : "");
        }
        return line;
    }
    std::string parameters() {
        std::vector<std::string> lines = {record(1020, 'A', {"88", "89", "90", "66", "67"}),
                                          record(0, 'L', {bits(), bits()}),
                                          record(19680, 'L', {"12"})};
        for (int n = 19700; n < 19706; ++n) lines.push_back(record(n, 'L', {decimal(), "0.0"}));
        for (const int n : {1320, 1321, 1240})
            lines.push_back(
                record(n, 'A', {decimal(), decimal(), decimal(), decimal(), decimal()}));
        lines.push_back(fmt::format("N01411Q1L1I{}L2I{}", decimal(), decimal()));
        lines.push_back(record(20, 0, {"17"}));
        lines.push_back(record(982, 'S', {"0"}));
        return envelope(lines);
    }
    std::string work_offsets() {
        std::vector<std::string> lines = {"G90"};
        for (int p = 0; p < 7; ++p)
            lines.push_back(
                fmt::format("G10L2P{}X{}Y{}Z{}B{}", p, decimal(), decimal(), decimal(), decimal()));
        lines.push_back(fmt::format("G10L20P{}X{}Z{}", 1 + pick(300), decimal(), decimal()));
        lines.emplace_back("M02");
        return envelope(lines);
    }
    std::string tools() {
        std::vector<std::string> lines;
        const int memory = pick(3);
        for (int p = 1; p < 20; ++p) {
            if (memory == 0) lines.push_back(fmt::format("G10P{}R{}", p, decimal()));
            for (int l = 10; l < (memory == 0 ? 10 : memory == 1 ? 12 : 14); ++l)
                lines.push_back(fmt::format("G10G90L{}P{}R{}", l, p, decimal()));
        }
        return envelope(lines);
    }
    std::string variables() {
        std::vector<std::string> lines;
        for (int n = 500; n < 530; ++n)
            lines.push_back(old_ ? fmt::format("#{}={}", n, decimal())
                            : pick(4) == 0
                                ? fmt::format("G10L85P{}(FFFFFFFFFFFFFFFF)", n)
                                : fmt::format("G10L85P{}(4007{:012X})", n, pick(1 << 30)));
        lines.emplace_back("SETVN500[PIVOT,,TOP]");
        lines.emplace_back("M02");
        return envelope(lines);
    }

    SeededNoise random_;
    std::string end_;
    bool old_ = false;
};

/// Positions at which two texts of equal length differ.
std::vector<std::size_t> changed_places(const std::string& a, const std::string& b) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (a[i] != b[i]) out.push_back(i);
    return out;
}

}  // namespace

TEST_CASE("1000 generated backups come back byte for byte") {
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        INFO("seed " << seed);
        const backup::ControlBackup before = Generated(seed).backup;
        backup::ControlBackup after = before;
        offsets::Stores stores;
        backup::apply_backup(after, stores);
        backup::update_backup(after, stores);
        REQUIRE(after.files == before.files);
        REQUIRE(backup::diff_backups(before, after).empty());
    }
}

TEST_CASE("a changed value of a generated backup alters its own digits alone") {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        INFO("seed " << seed);
        const backup::ControlBackup before = Generated(seed).backup;
        backup::ControlBackup after = before;
        offsets::Stores stores;
        backup::apply_backup(after, stores);
        const double old_value = stores.parameters.get(19702);
        stores.parameters.set(19702, old_value + (old_value < 0.0 ? -1000.0 : 1000.0));
        backup::update_backup(after, stores);
        const auto found = backup::diff_backups(before, after);
        REQUIRE(found.size() == 1);
        CHECK(found[0].name == "19702");
        CHECK(found[0].meaning == "place of the first rotary axis of the table");
        const std::string &a = before.files.at("CNC-PARA.TXT"), &b = after.files.at("CNC-PARA.TXT");
        const std::size_t at = changed_places(a, b).at(0);
        const std::string tail_a = a.substr(a.find_first_not_of("0123456789.-", at)),
                          tail_b = b.substr(b.find_first_not_of("0123456789.-", at));
        CHECK(tail_a == tail_b);
        for (const auto& [name, bytes] : before.files)
            if (name != "CNC-PARA.TXT") CHECK(after.files.at(name) == bytes);
    }
}

TEST_CASE("any value of a generated backup changes alone, in its own digits") {
    SeededNoise random(77);
    std::map<std::string, int> kinds;
    for (std::uint64_t seed = 2001; seed <= 2600; ++seed) {
        const backup::ControlBackup before = Generated(seed).backup;
        const std::vector<backup::BackupValue> values = backup::list_values(before);
        const backup::BackupValue& v = values[random.bits() % values.size()];
        CAPTURE(seed, v.file, v.name, v.text);
        // The first two give other values their meaning; no setup holds a second path.
        if (v.number == 0 || v.number == 1020 || v.name.find("path") != std::string::npos) continue;
        const double old = backup::stored_value(v);
        const double next =
            std::isnan(old) ? 2.5 : old + std::ldexp(1.0, 3 - static_cast<int>(random.bits() % 12));
        offsets::Stores stores;
        backup::apply_backup(before, stores);
        backup::BackupValue wanted = v;
        wanted.text = backup::format_value(v, next);
        wanted.text = backup::format_value(v, backup::stored_value(wanted));
        backup::store_value(wanted, stores);
        backup::ControlBackup after = before;
        const auto changed = backup::update_backup(after, stores);
        REQUIRE(changed == std::map<std::string, int>{{v.file, 1}});
        backup::ControlBackup expected = before;
        expected.files[v.file].replace(v.begin, v.size, wanted.text);
        CHECK(after.files == expected.files);
        const auto found = backup::diff_backups(before, after);
        REQUIRE(found.size() == 1);
        CHECK(found[0].b == wanted.text);
        ++kinds[v.file];
    }
    CHECK(kinds.size() == 4);
}

TEST_CASE("a diff names axes, offsets, variables and programs") {
    backup::ControlBackup a;
    a.files["CNC-PARA.TXT"] = "%\nN01020Q1A1P88A2P66\nN01320Q1A1P100.A2P5.\n%\n";
    a.files["MACRO.TXT"] = "%\n#500=1.\nSETVN500[PIVOT,TOP]\n%\n";
    a.files["ALL-FLDR.TXT"] = "%\n&F=/MTB1/\nO9810(MOVE)\nG1X#24\nM99\nO9811\nM99\n%\n";
    backup::ControlBackup b = a;
    b.files["CNC-PARA.TXT"] = "%\nN01020Q1A1P88A2P66\nN01320Q1A1P100.A2P6.\n%\n";
    b.files["MACRO.TXT"] = "%\r\n#500=2.\r\nSETVN500[PIVOT,TOP]\r\n%";
    b.files["ALL-FLDR.TXT"] =
        "%\r\n&F=/MTB1/\r\nO9810( MOVE )\r\nG1 X#24 F9\r\nM99\r\nO9812\r\nM99\r\n%";
    const auto found = backup::diff_backups(a, b);
    REQUIRE(found.size() == 5);
    CHECK(found[2].meaning == "program: 1 line out, 1 in; first at line 2: G1X#24 | G1 X#24 F9");
    CHECK(found[0].name == "1320 B");
    CHECK(found[0].meaning == "stored stroke 1, positive end");
    CHECK(found[1].name == "#500");
    CHECK(found[1].meaning == "PIVOT");
    CHECK(found[2].name == "/MTB1/O9810");
    CHECK(found[3].name == "/MTB1/O9811");
    CHECK(found[3].b.empty());
    CHECK(found[4].name == "/MTB1/O9812");
}

TEST_CASE("the table of parameters rises and says what becomes of each") {
    int last = -1;
    for (const backup::ParameterRow& row : backup::parameter_rows()) {
        CHECK(row.first > last);
        CHECK(row.last >= row.first);
        last = row.last;
    }
    CHECK(backup::standing_of_parameter(19703) == backup::Standing::obeyed);
    CHECK(backup::standing_of_parameter(1851) == backup::Standing::obeyed);
    CHECK(backup::standing_of_parameter(1852) == backup::Standing::known);
    CHECK(backup::standing_of_parameter(2020) == backup::Standing::ignored);
    CHECK(backup::standing_of_file("TOOLOFST.TXT") == backup::Standing::obeyed);
    CHECK(backup::standing_of_file("SRAM.FDB") == backup::Standing::ignored);
}

TEST_CASE("what the page on the control calls obeyed is not called ignored") {
    std::ifstream page(std::string(TRUNNION_SOURCE_DIR) + "/docs/control.md");
    std::string line;
    while (std::getline(page, line) && !line.starts_with("1001#0")) {
    }
    REQUIRE(line.starts_with("1001#0"));
    const std::regex number(R"((#\d+)|(\d{4,5})(?:-(\d{4,5}))?)");
    int found = 0;
    for (std::sregex_iterator at(line.begin(), line.end(), number), end; at != end; ++at) {
        if (!(*at)[2].matched) continue;
        for (const auto& part : {(*at)[2], (*at)[3]})
            if (part.matched) {
                INFO(part.str());
                CHECK(backup::standing_of_parameter(std::stoi(part.str())) ==
                      backup::Standing::obeyed);
                ++found;
            }
    }
    CHECK(found > 40);
}

TEST_CASE("10,000 records load") {
    std::string text = "%\n";
    for (int n = 0; n < 10000; ++n)
        text += fmt::format("N{:05}Q1A1P{}A2P{}A3P{}\n", 20000 + n, n, n + 1, n + 2);
    backup::ControlBackup large;
    large.files["CNC-PARA.TXT"] = text + "%\n";
    offsets::Stores stores;
    backup::apply_backup(large, stores);
    CHECK(stores.parameters.entry.at(29999).by_axis.at(3) == 10001.0);
}
