// A laser's .rtl file: the same readings as the table with the same numbers, and its bad forms.
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::read_rows;
using import_bench::refuses;
using imports::ImportKind;

namespace {

/// Two runs both ways at three targets.
const std::string rtl =
    "HEADER::\r\nFile type  : rtl\r\nOwner      : Linear\r\n\r\nTARGET DATA::\r\n"
    "Filetype  : ISO\r\nTarget-count: 3\r\nTargets :\r\n0.0000  100.0000 \r\n200.0000 \r\n"
    "Flags: 0 0 2 0\r\n\r\nUSER-TEXT::\r\nMachine:    mill\r\nAxis:X\r\n\r\nRUNS::\r\n"
    "Run-count:4\r\n\r\nDEVIATIONS::\r\nRun Target Data:\r\n"
    "1   1      0.0\r\n1   2      1.0\r\n1   3      2.0\r\n"
    "2   3      5.5\r\n2   2      5.0\r\n2   1      3.0\r\n"
    "3   1      0.4\r\n3   2      1.4\r\n3   3      2.4\r\n"
    "4   3      5.9\r\n4   2      5.4\r\n4   1      3.4\r\n\r\nEOF::\r\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

Case iso(const std::string& text, const std::vector<std::string>& told = {}) {
    return {ImportKind::iso230_2, text, told, ""};
}

}  // namespace

TEST_CASE("an .rtl file gives the readings of the table with its numbers", "[imports][rtl]") {
    const setup::Setup setup = import_bench::setup();
    const auto rows = read_rows(setup, iso(rtl));
    const auto plain = read_rows(setup, iso("target [mm];1+;1-;2+;2-\n0;0;3;0.4;3.4\n"
                                            "100;1;5;1.4;5.4\n200;2;5.5;2.4;5.9\n",
                                            {"axis=X", "unit=um"}));
    REQUIRE(rows.size() == 12);
    REQUIRE(plain.size() == 12);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        CHECK(rows[k].commanded == plain[k].commanded);
        CHECK(*rows[k].value_mm == Approx(*plain[k].value_mm).margin(1e-12));
    }
    CHECK(rows[0].source == "f.txt:22");
    CHECK(rows[5].source == "f.txt:27");
    const auto told = import_bench::imported(setup, iso(rtl));
    CHECK_THAT(told.summary[0], Catch::Contains("X, 2 runs both ways at 3 targets"));
    CHECK_THAT(told.notes[0], Catch::Contains("not from its maker"));
}

TEST_CASE("an .rtl file of one direction keeps its odd runs", "[imports][rtl]") {
    const auto rows =
        read_rows(import_bench::setup(), iso(with(rtl, "Flags: 0 0 2 0", "Flags: 0 1 2 0")));
    REQUIRE(rows.size() == 6);
    CHECK(*rows[3].value_mm == Approx(0.0004));
}

TEST_CASE("bad .rtl files are refused with their line", "[imports][rtl]") {
    const setup::Setup setup = import_bench::setup();
    refuses(setup, iso(with(rtl, "1   2      1.0", "1   4      1.0")), "target 4 of 3", 23);
    refuses(setup, iso(with(rtl, "1   2      1.0", "1   2      x")), "run, target and dev", 23);
    refuses(setup, iso(with(rtl, "Target-count: 3", "Target-count: 4")), "Target-count is 4", 1);
    refuses(setup, iso(with(rtl, "Run Target Data:", "")), "no deviations", 1);
    refuses(setup, iso(with(rtl, "Axis:X\r\n", "\r\n")), "which axis", 1);
}
