// Columns of times without a unit: ticks since a year, numbers of rows; heads of exported signals.
#include <algorithm>

#include "base/units.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto log_kind = imports::ImportKind::axis_log;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

/// Three rows of X with these times.
Case log_of(const std::string& time, const std::vector<std::string>& times,
            const std::vector<std::string>& told = {}) {
    std::string text = time + ",X cmd [mm],X act [mm]\n";
    for (std::size_t k = 0; k < times.size(); ++k)
        text += times[k] + ',' + std::to_string(k) + ',' + std::to_string(k) + ".001\n";
    return {log_kind, text, told, ""};
}

/// Names and properties as a scope of a controller exports them, and two rows.
const std::string scope_head =
    "Name;Divider;\nFile;C:\\Tests\\Divider.csv;\n"
    "Starttime of export;133500000001230000;Sunday, January 17, 2024;11:20:53.419\n"
    "Endtime of export;133500000009990000;Sunday, January 17, 2024;11:21:32.759\n\n\n"
    "TriggerGroup;Count;ReleaseTime;Comment;\n\n";
const std::string scope_rows =
    "SymbolComment;Set value;velocity;Actual value\nData-Type;REAL64;REAL64;REAL64\n"
    "SampleTime;10;10;10\nVariableSize;8;8;8\nPort;852;852;852\nBitMask;0xffff\n"
    "133500000004530000;36.25;36.0;36.5\n133500000004630000;36.5;36.0;36.25\n"
    "133500000004730000;36.75;36.0;36.5\n";

}  // namespace

TEST_CASE("ticks of a known clock are counted from the first row", "[imports][clocks]") {
    const setup::Setup setup = import_bench::setup();
    for (const auto& [times, words] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"133500000000000000", "133500000001000000", "133500000002000000"},
              "Windows FILETIME (100 ns since 1601)"},
             {{"638500000000000000", "638500000001000000", "638500000002000000"},
              "ticks of 100 ns since the year 1"},
             {{"1700000000000000000", "1700000000100000000", "1700000000200000000"},
              "Unix time in ns"},
             {{"1700000000000000", "1700000000100000", "1700000000200000"}, "Unix time in us"},
             {{"1700000000000", "1700000000100", "1700000000200"}, "Unix time in ms"},
             {{"1700000000", "1700000000.1", "1700000000.2"}, "Unix time in s"}}) {
        INFO(words);
        const Case c = log_of("timestamp", times);
        const auto rows = read_rows(setup, c);
        REQUIRE(rows.size() == 3);
        CHECK(rows[0].time_s == 0.0);
        CHECK(rows[2].time_s == Approx(0.2).margin(2e-6));
        CHECK(has(imported(setup, c).notes,
                  "'timestamp' taken as " + words + ", counted from the first row"));
    }
    // A unit that is told is not guessed; the year it counts from does not matter.
    const Case told = log_of("time [us]", {"52000000000000", "52000000100000", "52000000200000"});
    CHECK(read_rows(setup, told)[2].time_s == Approx(0.2));
    CHECK(has(imported(setup, told).notes, "'time' counted from the first row"));
}

TEST_CASE("numbers that may be those of two clocks are seconds, with a note", "[imports][clocks]") {
    const setup::Setup setup = import_bench::setup();
    // Microseconds of a controller that has run for half an hour.
    const Case micros = log_of("t", {"1700000000", "1700001000", "1700002000"});
    CHECK(read_rows(setup, micros)[2].time_s == 2000.0);
    CHECK(has(imported(setup, micros).notes, "'t' without unit taken as seconds"));
    CHECK(
        read_rows(setup, log_of("t [us]", {"1700000000", "1700001000", "1700002000"}))[2].time_s ==
        Approx(0.002));
}

TEST_CASE("a column that only counts is told, and its step may be given", "[imports][clocks]") {
    const setup::Setup setup = import_bench::setup();
    for (const auto& times : {std::vector<std::string>{"0", "1", "2"}, {"3570", "3571", "3572"}}) {
        const Case c = log_of("t", times);
        CHECK(read_rows(setup, c)[2].time_s == 2.0);
        CHECK(has(imported(setup, c).notes,
                  "'t' without unit, in steps of 1, taken as seconds; if it only counts the rows, "
                  "--with step_s=0.001 tells the time between them"));
        const Case with_step = log_of("t", times, {"step_s=0.002"});
        CHECK(read_rows(setup, with_step)[2].time_s == Approx(0.004));
        CHECK(has(imported(setup, with_step).notes, "numbers of the rows, 0.002 s apart"));
    }
    for (const Case& c : {log_of("t [s]", {"0", "1", "2"}), log_of("t", {"0", "0.1", "0.2"}),
                          log_of("t", {"0", "2", "4"})}) {
        INFO(c.text);
        CHECK_FALSE(has(imported(setup, c).notes, "'t'"));
    }
}

TEST_CASE("the head of exported signals is passed over", "[imports][clocks]") {
    const setup::Setup setup = import_bench::setup();
    const std::string names = "Name;C set;C velocity;C actual\n";
    const auto rows = read_rows(setup, {log_kind, scope_head + names + scope_rows, {}, ""});
    REQUIRE(rows.size() == 3);
    CHECK(rows[2].time_s == Approx(0.02).margin(2e-6));
    CHECK(*rows[0].value_mm == Approx(rad_from_deg(0.25)));
    CHECK(rows[0].source == "f.txt:16");
    // A line of units.
    const auto turned = read_rows(
        setup, {log_kind, scope_head + names + "Unit;;rad/s;mrad\n" + scope_rows, {}, ""});
    CHECK(*turned[0].value_mm == Approx(0.0365 - rad_from_deg(36.25)));
    // The names of points above a line of units are none of signals.
    const auto named =
        read_rows(setup, {log_kind, "Name;X cmd;X act\n-;mm;um\n7;0;1\n8;0;2\n", {}, ""});
    CHECK(named[1].time_s == 60.0);
    // Names that tell no axis are refused where they are; the user tells them.
    const std::string others =
        scope_head + "Name;fPos (Counter);fVel;fPos (Resolver)\n" + scope_rows;
    refuses(setup, {log_kind, others, {}, ""}, "no axis of the machine", 9);
    const Case told{log_kind, others, {"columns=time,C cmd [deg],v,C act [deg]"}, ""};
    CHECK(read_rows(setup, told).size() == 3);
    CHECK(has(imported(setup, told).notes, "the rows begin at line 16"));
}

TEST_CASE("a date beside the decimal hours of its day", "[imports][clocks]") {
    const setup::Setup setup = import_bench::setup();
    const Case c{
        log_kind,
        "date,UT,X cmd [mm],X act [mm]\n2024-03-01,20.5,0,0.001\n2024-03-01,21.25,1,1.001\n"
        "2024-03-02,0.0,2,2.001\n",
        {},
        ""};
    const auto rows = read_rows(setup, c);
    REQUIRE(rows.size() == 3);
    CHECK(rows[1].time_s == Approx(2700.0));
    CHECK(rows[2].time_s == Approx(3.5 * 3600.0));
    CHECK(rows[0].session == "2024-03-01");
    CHECK(has(imported(setup, c).notes, "'UT' taken as decimal hours of the day"));
}
