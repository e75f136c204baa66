// No reading of a file is lost or changed without a word: columns beside runs, signs, results.
#include <algorithm>
#include <utility>

#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto iso = imports::ImportKind::iso230_2;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

Case laser(const std::string& head, const std::string& rows = "0;0;3;0;3\n100;1;5;1;5\n") {
    return {iso, head + '\n' + rows, {"axis=X", "unit=um"}, ""};
}

/// Deviations in um, in measured order.
std::vector<double> values(const Case& c) {
    std::vector<double> list;
    for (const records::Reading& row : read_rows(import_bench::setup(), c))
        list.push_back(row.value_mm.value() * 1e3);
    return list;
}

void check_values(const Case& c, const std::vector<double>& expected) {
    INFO(c.text);
    CHECK_THAT(values(c), Catch::Approx(expected));
}

/// Up and down twice at 0 and 100 mm.
const std::vector<double> both_ways{0, 1, 5, 3, 0, 1, 5, 3};

}  // namespace

TEST_CASE("directions in the words of users are read", "[imports][lost]") {
    for (const auto& [up, down] :
         std::vector<std::pair<std::string, std::string>>{{"vor", "zurück"},
                                                          {"vor",
                                                           "zur\xFC"
                                                           "ck"},
                                                          {"VOR", "ZURÜCK"},
                                                          {"hin", "rück"},
                                                          {"vor",
                                                           "zuru\xCC\x88"
                                                           "ck"},
                                                          {"up", "dn"},
                                                          {"Hinfahrt", "Rückfahrt"},
                                                          {"aufwärts", "abwärts"},
                                                          {"forward", "backward"},
                                                          {"fwd", "bwd"},
                                                          {"+", "\xE2\x88\x92"},
                                                          {"+", "\xE2\x80\x93"},
                                                          {"→", "←"},
                                                          {"->", "<-"},
                                                          {"↑", "↓"},
                                                          {"f", "b"}})
        for (const char* run : {"Lauf 1 ", "1"}) {
            const std::string first = run, second = first == "1" ? "2" : "Lauf 2 ";
            check_values(laser("Soll [mm];" + first + up + ';' + first + down + ';' + second + up +
                               ';' + second + down),
                         both_ways);
        }
    check_values(laser("Target [mm];Forward;Reverse;Forward;Reverse"), both_ways);
    check_values(laser("Target [mm];+1;-1;+2;-2"), both_ways);
    check_values(laser("Target;Run 1;;Run 2;\n[mm];up;down;up;down"), both_ways);
    check_values(laser("Target;Run 1;Run 1;Run 2;Run 2\n;+;-;+;-"), both_ways);
    check_values(laser("Target [mm];up-1;down-1;up-2;down-2"), both_ways);
    check_values(laser("Target [mm];Abweichung vor;Abweichung zurück", "0;0;3\n100;1;5\n"),
                 {0, 1, 5, 3});
}

TEST_CASE("a column of numbers beside runs is read, known or refused", "[imports][lost]") {
    const setup::Setup setup = import_bench::setup();
    for (const char* other : {"Lauf 2 retour", "Foo", "Yaw [arcsec]", "2"})
        refuses(setup, laser("Soll [mm];1+;1-;2+;" + std::string(other)), "beside the runs", 1);
    refuses(setup, laser("Soll [mm];1+;1-;;2-"), "beside the runs", 1);
    refuses(setup, laser("Soll [mm];1+;1-;1+;1-"), "same run", 1);
    refuses(setup, laser("Soll [mm];R1;R2", "0;0;1\n100;1;1\n"), "reverse", 1);
    for (const char* known : {"Mittel;2σ", "Mean;Std", "Temp [°C];Zeit", "Pos. Nr.;Umkehrspanne",
                              "Mean deviation;Range", "Comment;No."}) {
        const Case c = laser("Soll [mm];1+;1-;" + std::string(known));
        INFO(known);
        CHECK(values(c).size() == 4);
        CHECK(has(imported(setup, c).notes, "beside the runs, not read: '"));
    }
    const Case first = laser("Pos. Nr.;Soll [mm];Lauf 1;Lauf 2", "1;0;0;3\n2;100;1;5\n");
    check_values(first, {0, 1, 3, 5});
    const Case empty = laser("Soll [mm];1+;Foo;1-", "0;0;;3\n100;1;-;5\n");
    check_values(empty, {0, 1, 5, 3});
    check_values(
        {iso, "0;0;3;7\n100;1;5;7\n", {"axis=X", "columns=target [mm],1+ [um],1- [um],skip"}, ""},
        {0, 1, 5, 3});
}

TEST_CASE("runs in rows are read, results or refused", "[imports][lost]") {
    const std::string head = "Position;0;100;200\nLauf 1 vor;0;1;2\n";
    const Case c = laser(head + "Lauf 1 zurück;3;5;n.a.", "Mittelwert;1;2;3\n");
    check_values(c, {0, 1, 2, 5, 3});
    const auto notes = imported(import_bench::setup(), c).notes;
    CHECK(has(notes, "rows of results, not read: 'Mittelwert'"));
    CHECK(has(notes, "1 reading without a value is left out: line 3 '200'"));
    const std::string bare = "Position;0;100;200\nAbweichung vor;0;1;2\nAbweichung zurück;3;5;6";
    check_values(laser(bare, "Umkehr;3;4;4\nR up;1;1;1\n"), {0, 1, 2, 6, 5, 3});
    refuses(import_bench::setup(), laser(head + "Lauf 1 retour;3;5;6", ""), "run and direction", 3);
    refuses(import_bench::setup(), laser(head + "Lauf 1 vor;3;5;6", ""), "above already", 3);
}

TEST_CASE("missing values and rows of results are told", "[imports][lost]") {
    const setup::Setup setup = import_bench::setup();
    const Case c =
        laser("Nr.;Soll [mm];1+;1-;2+;2-",
              "1;0;0;3;0;n.a.\n2;100;1;;1;5\n3;200;2;6;2;6\nMean;;1,7;;;\n2 s;;0,1;0,2;;\n");
    CHECK(values(c).size() == 10);
    const auto notes = imported(setup, c).notes;
    CHECK(has(notes, "2 readings without a value are left out: line 3 '1-', line 2 '2-'"));
    CHECK(has(notes, "rows of results, not read: 'Mean', '2 s'"));
    CHECK(has(notes, "R and A (-) need two readings of each target: 0 mm has one towards -"));
    const auto with = [](const std::string& row) {
        return laser("Soll [mm];1+;1-", "0;0;3\n" + row + "\n200;2;6\n300;2;7\n");
    };
    refuses(setup, with("100 mm;1;5"), "a unit in the cell", 3);
    refuses(setup, with("oo;1;5"), "no target", 3);
    refuses(setup, with("n.a.;1;5"), "not a finite number", 3);
    refuses(setup, with(";1;5"), "not a finite number", 3);
    CHECK(values(with(";;")).size() == 6);
}

TEST_CASE("a table for each run is one test with one zero", "[imports][lost]") {
    std::string text;
    for (const char* run : {"Lauf 1 vor", "Lauf 1 zurück", "Lauf 2 vor", "Lauf 2 zurück"}) {
        const bool up = std::string(run).ends_with("vor");
        text += std::string(run) + "\nSoll [mm];Abweichung [um]\n" +
                (up ? "0;0\n100;1\n" : "100;5\n0;3\n");
    }
    const Case c{iso, "Achse: X\n" + text, {}, ""};
    check_values(c, both_ways);
    for (const records::Reading& row : read_rows(import_bench::setup(), c)) CHECK(row.test == "X");
}

TEST_CASE("micro-inches in all spellings, and units that are none", "[imports][lost]") {
    for (const char* unit : {"\xC2\xB5in", "\xCE\xBCin", "\xB5in", "uin", "microinch"}) {
        const std::string u = unit;
        for (const std::string& text :
             {"Target [in];1+ [" + u + "];1- [" + u + "]\n0;5;120\n4;40;160\n8;100;200\n",
              "Target;1+;1-\nin;" + u + ';' + u + "\n0;5;120\n4;40;160\n8;100;200\n"}) {
            const auto rows = read_rows(import_bench::setup(), {iso, text, {"axis=X"}, ""});
            REQUIRE(rows.size() == 6);
            CHECK(rows[1].commanded[Axis::X] == Approx(101.6));
            CHECK(rows[1].value_mm.value() == Approx(40 * 25.4e-6));
        }
    }
    refuses(import_bench::setup(),
            {iso, "Target;1+;1-\nin;foo;foo\n0;5;120\n4;40;160\n", {"axis=X"}, ""},
            "'foo' is no unit", 2);
}

TEST_CASE("an axis in the file that --with contradicts is refused", "[imports][lost]") {
    const setup::Setup setup = import_bench::setup();
    const std::string rows = "Target [mm];1+ [um];1- [um]\n0;0;3\n100;1;5\n";
    refuses(setup, {iso, "Axis: Y\n" + rows, {"axis=X"}, ""}, "axis Y", 1);
    CHECK(values({iso, "Axis: X-Achse\n" + rows, {"axis=X"}, ""}).size() == 4);
    refuses(setup,
            {iso, "axis;target [mm];deviation [um]\nY;0;0\nY;100;1\nY;200;1\n", {"axis=X"}, ""},
            "'Y'", 1);
    const Case unit{iso, "Axis: X\nUnit: mm\nTarget [mm];1+;1-\n0;0;3\n100;1;5\n", {"unit=um"}, ""};
    check_values(unit, {0, 1, 5, 3});
    CHECK(has(imported(setup, unit).notes, "line 2 says unit mm: not used, --with unit=um is"));
}

TEST_CASE("numbers with a Unicode minus, and rows of empty cells", "[imports][lost]") {
    check_values(laser("Soll [mm];1+;1-",
                       "0;\xE2\x88\x92"
                       "1,5;\xE2\x80\x93"
                       "3\n;;\n100;1;5\n"),
                 {-1.5, 1, 5, -3});
}
