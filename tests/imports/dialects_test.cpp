// Separators, decimal marks, byte order marks, line ends, units and times as files have them.
#include <algorithm>

#include "base/units.h"
#include "imports/text_table.h"
#include "imports/times.h"
#include "imports/units.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;

TEST_CASE("one servo log in many dialects gives the same readings") {
    const setup::Setup setup = import_bench::setup();
    const std::string texts[] = {
        "time [s],X cmd [mm],X act [mm]\n0,1.5,1.501\n0.1,2.5,2.5015\n",
        "\xEF\xBB\xBFtime [s],X cmd [mm],X act [mm]\r\n0,1.5,1.501\r\n0.1,2.5,2.5015\r\n",
        "Zeit (s);X Soll (mm);X Ist (mm)\n0;1,5;1,501\n0,1;2,5;2,5015\n",
        "Zeit;Soll X;Ist X\ns;mm;mm\n0;1,5;1,501\n0,1;2,5;2,5015\n",
        "time\tx_cmd\tx_act\ns\tmm\tmm\n0\t1.5\t1.501\n0.1\t2.5\t2.5015\n",
        "t_s  xcmd_mm  xact_mm\n0  1.5  1.501\n0.1  2.5  2.5015\n",
        "Maschine: A 1\nDatum: 1.3.2024\n\ntime [ms];X cmd [um];X act [um]\n0;1500;1501\n"
        "100;2500;2501,5\n",
        "time,X cmd [mm],X act [mm]\n2024-03-01T08:15:30Z,1.5,1.501\n2024-03-01T08:15:30.1Z,2.5,"
        "2.5015\n",
        "time;X cmd [mm];X act [mm]\n01.03.2024 08:15:30;1,5;1,501\n01.03.2024 08:15:30,1;2,5;"
        "2,5015\n",
        "\"time [s]\",\"X cmd [mm]\",\"X act "
        "[mm]\"\n\"0\",\"1.5\",\"1.501\"\n\"0.1\",\"2.5\",\"2.5015\"\n"};
    for (const std::string& text : texts) {
        INFO(text);
        const auto rows =
            import_bench::read_rows(setup, {imports::ImportKind::axis_log, text, {}, ""});
        REQUIRE(rows.size() == 2);
        CHECK(rows[0].time_s == 0.0);
        CHECK(rows[1].time_s == Approx(0.1).margin(2e-7));
        CHECK(rows[1].commanded[Axis::X] == Approx(2.5));
        CHECK(*rows[0].value_mm == Approx(0.001).epsilon(1e-9));
        CHECK(*rows[1].value_mm == Approx(0.0015).epsilon(1e-9));
    }
}

TEST_CASE("a table of a Markdown page or of a terminal has a rule below its names") {
    const std::string head = "Read by a tracker:\n\n| time | X cmd [mm] | X act [mm] |\n";
    const std::string body = "| 0 | 1,5 | 1,501 |\n| 1 | 2,5 | 2,5015 |\n| 2 | - | ? |\n";
    for (const char* rule :
         {"|:---:|:---:|:---:|\n", "|------|-----|----|\n", "+---+---+---+\n", ""}) {
        INFO(rule);
        const auto rows = import_bench::read_rows(
            import_bench::setup(), {imports::ImportKind::axis_log, head + rule + body, {}, ""});
        REQUIRE(rows.size() == 2);
        CHECK(rows[1].time_s == 1.0);
        CHECK(*rows[1].value_mm == Approx(0.0015).epsilon(1e-9));
    }
}

TEST_CASE("times as files write them") {
    const double day = *imports::seconds_of("2024-03-01");
    CHECK(day == 1709251200.0);  // date -u -d 2024-03-01 +%s
    CHECK(*imports::seconds_of("2024-03-01T08:15:30Z") - day == 29730.0);
    CHECK(*imports::seconds_of("2024-03-01 08:15:30.25") - day == 29730.25);
    CHECK(*imports::seconds_of("2024-03-01T08:15:30+01:00") - day == 26130.0);
    CHECK(*imports::seconds_of("01.03.2024 08:15:30") - day == 29730.0);
    CHECK(*imports::seconds_of("03/25/2024 8:15 PM") - day == 24 * 86400 + 72900.0);
    CHECK(*imports::seconds_of("2024/03/01-08:15:30") - day == 29730.0);
    CHECK(*imports::seconds_of("08:15:30,5") == 29730.5);
    for (const char* bad : {"", "noon", "2024-02-30 08:00:00", "01/02/2024 08:00:00", "25:99",
                            "2024-03-01T", "08:15:30 CET", "2024-03-01T08:15:3x"})
        CHECK_FALSE(imports::seconds_of(bad));
}

TEST_CASE("units in lower and upper case, and every micro") {
    for (const char* um : {"um", "\xC2\xB5m", "\xCE\xBCm", "\xB5m", "UM", "micron"})
        CHECK(imports::find_unit(um)->factor == 1e-3);
    CHECK(imports::find_unit("arcsec")->factor == Approx(4.848136811e-6));
    CHECK(imports::find_unit("mm/min")->factor == Approx(1.0 / 60));
    CHECK(imports::find_unit("\xC2\xB5m/m")->factor == Approx(1e-6));  // of a level: an angle
    CHECK(imports::find_unit("mm/m")->quantity == imports::Quantity::angle);
    CHECK_FALSE(imports::find_unit("furlong"));
    CHECK_FALSE(imports::find_unit(""));
}

TEST_CASE("what is no table is refused with its line") {
    const auto refused = [](const std::string& text, const std::string& part, int line) {
        import_bench::refuses(import_bench::setup(), {imports::ImportKind::axis_log, text, {}, ""},
                              part, line);
    };
    const std::string head = "time [s],X cmd [mm],X act [mm]\n";
    refused("", "empty", 1);
    refused("hello\nworld\n", "no line of numbers", 1);
    refused(
        "\xFF\xFE"
        "a",
        "UTF-16", 1);
    refused("1,2,3\n4,5,6\n", "names of the columns", 1);
    refused(head + "0,1\n1,2,3\n2,3,4\n", "cells", 2);
    refused(head + "0,1,1\n1,abc,2\n", "not a finite number", 3);
    refused(head + "0,1,1\n1,2 um,2\n", "a unit in the cell", 3);
    refused(head + "5,1,1\n4,2,2\n", "not in ascending order", 3);
    refused(head + "0,1,1\n1,\"2,2\n", "quote", 3);
    refused("time;X cmd;X act\n0;1,5;1.5\n", "decimal comma", 2);
    refused("time [furlong],X cmd,X act [mm]\n0,1,1\n", "no unit for", 1);
    refused("time [s],X cmd [deg],X act [mm]\n0,1,1\n", "no unit for", 1);
    refused("time [s],X cmd [mm]\n0,1\n", "no axis of the machine (X, Y, Z, B, C) has both", 1);
    refused("time [s],Q cmd [mm],Q act [mm]\n0,1,1\n",
            "no axis of the machine (X, Y, Z, B, C) has both", 1);
    refused("time [s],X cmd [mm],X lag [um]\n0,1,1\n", "sign=", 1);
    refused("time [s],X cmd [mm],X cmd [um],X act\n0,1,1,1\n", "second column", 1);
    refused("time,X cmd [mm],X act [mm]\n01/02/2024 08:00,1,1\n", "is no time", 2);
}

TEST_CASE("a value that is missing leaves its row out, with a note") {
    for (const char* hole : {"", "NaN", "---", "n/a", "***", "?"}) {
        INFO(hole);
        const Case log{
            imports::ImportKind::axis_log,
            std::string("time [s],X cmd [mm],X act [mm]\n0,1,1\n1,2,") + hole + "\n2,3,3.001\n",
            {},
            ""};
        const auto rows = import_bench::read_rows(import_bench::setup(), log);
        REQUIRE(rows.size() == 2);
        CHECK(rows[1].time_s == 2.0);
        CHECK(rows[1].source == "f.txt:4");
        const auto notes = import_bench::imported(import_bench::setup(), log).notes;
        REQUIRE(notes.size() == 1);
        CHECK_THAT(notes[0], Catch::Contains("X: 1 rows without a value"));
    }
}

TEST_CASE("a missing length of a ballbar and a missing sight are left out, with a note") {
    const Case bar{imports::ImportKind::ballbar,
                   "angle [deg],deviation [um]\n0,1\n90,\n180,3\n270,2\n",
                   {"plane=XY", "sense=ccw", "feed=1000"},
                   ""};
    const auto rows = import_bench::read_rows(import_bench::setup(), bar);
    REQUIRE(rows.size() == 3);
    CHECK(rows[1].source == "f.txt:4");
    const auto told = import_bench::imported(import_bench::setup(), bar).notes;
    REQUIRE(told.size() == 2);
    CHECK_THAT(told[0], Catch::Contains("1 rows without a value"));
    const Case sight{imports::ImportKind::pointing,
                     "C cmd [deg],C act [deg]\n0,0.001\n90,-\n180,180.002\n",
                     {},
                     ""};
    CHECK(import_bench::read_rows(import_bench::setup(), sight).size() == 2);
    const auto notes = import_bench::imported(import_bench::setup(), sight).notes;
    CHECK(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
        return note.find("1 lines without a value") != std::string::npos;
    }));
}

TEST_CASE("a rotary axis that is shown from 0 to 360 deg goes on, with its lag") {
    std::string text = "time [ms],C cmd [deg],C act [deg]\n";
    for (const double q : {340.0, 350.0, 0.0, 10.0, 0.0, 350.0})
        text += std::to_string(text.size()) + ',' + std::to_string(q) + ',' +
                std::to_string(q < 5.0 ? 359.5 : q - 0.5) + '\n';
    const Case log{imports::ImportKind::axis_log, text, {}, ""};
    const auto rows = import_bench::read_rows(import_bench::setup(), log);
    REQUIRE(rows.size() == 6);
    const double commanded[] = {340, 350, 360, 370, 360, 350};
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(rows[k].commanded[Axis::C] == Approx(rad_from_deg(commanded[k])));
        CHECK(*rows[k].value_mm == Approx(rad_from_deg(-0.5)));
    }
    const auto notes = import_bench::imported(import_bench::setup(), log).notes;
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("C: steps between 0 and 360 deg"));
}

TEST_CASE("a column that no point needs is named, one coordinate a line too") {
    const auto result = import_bench::imported(
        import_bench::setup(),
        {imports::ImportKind::points,
         "Merkmal;Achse;Soll;Ist;Serie\nP1;X;0,0;0,001;kalt\nP1;Y;0,0;0,001;kalt\n",
         {},
         ""});
    REQUIRE(!result.notes.empty());
    CHECK_THAT(result.notes.back(), Catch::Contains("'Serie' is not used"));
}

TEST_CASE("dates become sessions: one for each day, none for a pause at lunch") {
    const Case log{imports::ImportKind::axis_log,
                   "Date;Time;X cmd [mm];X act [mm]\n2024-03-01;08:00:00;1;1\n"
                   "2024-03-01;11:00:00;2;2\n2024-03-08;07:59:00;3;3\n08.03.2024;08:00:00;4;4\n",
                   {},
                   ""};
    const auto rows = import_bench::read_rows(import_bench::setup(), log);
    REQUIRE(rows.size() == 4);
    CHECK(rows[1].time_s == 3 * 3600.0);
    CHECK(rows[0].session == "2024-03-01");
    CHECK(rows[1].session == "2024-03-01");
    CHECK(rows[2].session == "2024-03-08");
    CHECK(rows[3].session == "2024-03-08");
    Case one = log;
    one.told = {"session=all"};
    for (const auto& row : import_bench::read_rows(import_bench::setup(), one))
        CHECK(row.session == "all");
}

TEST_CASE("UTF-16 and Latin-1 from a spreadsheet come in as UTF-8 does") {
    const std::string text = "time [s];B cmd [\xB0];B act [\xB0]\n0;1,5;1,501\n1;2;2\n";
    std::string wide = "\xFF\xFE";
    for (const char c : text) {
        wide += c;
        wide += '\0';
    }
    for (const std::string& one : {text, wide}) {
        const auto rows = import_bench::read_rows(import_bench::setup(),
                                                  {imports::ImportKind::axis_log, one, {}, ""});
        REQUIRE(rows.size() == 2);
        CHECK(rows[0].commanded[Axis::B] == Approx(1.5 * 3.14159265358979 / 180));
    }
}

TEST_CASE("a row remembers the file and the line that it came from") {
    const auto rows = import_bench::read_rows(import_bench::setup(),
                                              {imports::ImportKind::axis_log,
                                               "made by hand\n\ntime,X cmd,X act\n0,1,1\n1,2,2\n",
                                               {},
                                               ""});
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].source == "f.txt:4");
    CHECK(rows[1].source == "f.txt:5");
}

TEST_CASE("numbers that no table of readings may hold are refused where they stand") {
    const setup::Setup setup = import_bench::setup();
    const auto log = [](const std::string& x) {
        return Case{imports::ImportKind::axis_log,
                    "time [s],X cmd [mm],X act [mm]\n0,1.5,1.501\n0.1," + x + ",2.5\n",
                    {},
                    ""};
    };
    CHECK(import_bench::read_rows(setup, log("9999999")).size() == 2);
    import_bench::refuses(setup, log("10000001"), "beyond 1e7", 3);
    import_bench::refuses(setup, log("19999999900"), "beyond 1e7", 3);
    try {
        import_bench::imported(setup, log("10000001"));
    } catch (const InputError& error) {
        CHECK(error.where.column == 5);
        CHECK(error.line_text == "0.1,10000001,2.5");
    }
}

TEST_CASE("an error in a line of a file shows the line") {
    const Case backwards{imports::ImportKind::axis_log,
                         "time [s],X cmd [mm],X act [mm]\r\n0,1,1\r\n-1,2,2\r\n",
                         {},
                         ""};
    try {
        import_bench::imported(import_bench::setup(), backwards);
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.where.line == 3);
        CHECK(error.line_text == "-1,2,2");
    }
}

TEST_CASE("commas of remarks above a table do not separate its columns", "[imports][dialects]") {
    const setup::Setup setup = import_bench::setup();
    const std::string remarks =
        "! First 3 numbers are latitude (deg,min,sec)\n! The next 3 are UTC date (year, month, "
        "day)\n! of 8,21,2021, at 5\" of mercury\n! from 8,22,2021, to 9,1,2021\n";
    const std::string rows = "10.001 30.002 10 30\n20.001 40.002 20 40\n30.001 50.002 30 50\n";
    const std::vector<std::string> told{"columns=B_act_deg,C_act_deg,B_cmd_deg,C_cmd_deg"};
    const auto plain =
        import_bench::read_rows(setup, {imports::ImportKind::axis_log, rows, told, ""});
    const auto below =
        import_bench::read_rows(setup, {imports::ImportKind::axis_log, remarks + rows, told, ""});
    REQUIRE(plain.size() == 6);
    REQUIRE(below.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) CHECK(*below[k].value_mm == *plain[k].value_mm);
}

TEST_CASE("axes with any letter, and positions next to targets", "[imports][dialects]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b R J5 t\"\n"
        "[machine.axis.R]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.J5]\ndirection = [0, 1, 0]\npoint_mm = [0, 0, 0]\n",
        "s.toml", notes);
    const auto result = import_bench::imported(
        setup, {imports::ImportKind::axis_log,
                "time [s],R_cmd_deg,R_act_deg,J5 target [deg],J5 pos [deg],i_R\n"
                "0,1,1.5,2,2.25,9\n1,2,2.5,3,3.25,9\n",
                {},
                ""});
    CHECK_THAT(result.readings, Catch::Contains("axis,R,") && Catch::Contains("axis,J5,"));
    CHECK_THAT(result.readings, Catch::Contains(",,0.5000") && Catch::Contains(",,0.2499"));
    CHECK(std::count(result.notes.begin(), result.notes.end(),
                     "dir/f.txt: 'J5 pos' taken as the actual position") == 1);
    CHECK(std::count(result.notes.begin(), result.notes.end(),
                     "dir/f.txt: column 'i_R' is not used") == 1);
    import_bench::refuses(
        setup, {imports::ImportKind::axis_log, "time [s],R [deg],v\n0,1,1\n1,1,1\n", {}, ""},
        "\"R commanded\" (cmd, target, ", 1);
}

TEST_CASE("the date of Unix names the session", "[imports][dialects]") {
    const setup::Setup setup = import_bench::setup();
    for (const char* date : {"Wed Apr 13 14:00:34 CEST 2022", "Wed Apr 13 14:00:34 2022",
                             "Wed 13 Apr 2022 02:00:34 PM CEST", "Wed 13 Apr 2022 14:00:34"})
        CHECK(
            import_bench::read_rows(setup, {imports::ImportKind::axis_log,
                                            std::string("* Date        : ") + date +
                                                "\ntime [s],X cmd [mm],X act [mm]\n0,1,1\n1,2,2\n",
                                            {},
                                            ""})[0]
                .session == "2022-04-13");
    for (const char* date : {"Wed Apr 31 14:00:34 2022", "Wed 31 Apr 2022 02:00:34 PM CEST",
                             "Wed 13 Avr 2022 02:00:34 PM CEST"})
        import_bench::refuses(
            setup,
            {imports::ImportKind::axis_log,
             std::string("Date: ") + date + "\ntime [s],X cmd [mm],X act [mm]\n0,1,1\n",
             {},
             ""},
            "is no date", 1);
}
