#include <catch2/catch.hpp>

#include "interpreter/arguments.h"
#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

TEST_CASE("programs in memory have a number, and a name with the letter O or without") {
    interpreter::ProgramsInMemory programs;
    programs.add(12, "O12\nM99\n");
    for (const char* name : {"12", "O12", "o12", "O0012"}) {
        INFO(name);
        CHECK(programs.find(std::string_view(name)));
    }
    for (const char* name : {"", "O", "O13", "P12", "OO12", "12A"}) {
        INFO(name);
        CHECK_FALSE(programs.find(std::string_view(name)));
    }
}

TEST_CASE("G65 passes arguments to a new level and returns to the old one") {
    const Run r =
        run("O1\n#1=7\nG65P9010A2.5B-1.C#1X10Z3.\n#100=#1\nM30\n"
            "O9010\n#101=#1\n#102=#2\n#103=#3\n#104=#24\n#105=#26\n#1=99\nX#1\nM99\n");
    CHECK(r.blocks == Blocks{"X99", "M30"});
    CHECK(r[100] == 7.0);
    CHECK(r[101] == 2.5);
    CHECK(r[102] == -1.0);
    CHECK(r[103] == 7.0);
    CHECK(r[104] == 10.0);
    CHECK(r[105] == 3.0);
    interpreter::InterpreterOptions increments;
    increments.whole_arguments_as_written = false;
    CHECK(run("G65P9X10T5\nM30\nO9\n#100=#24\n#101=#20\nM99\n", increments)[100] == 0.01);
    CHECK(run("G65P9X10T5\nM30\nO9\n#100=#24\n#101=#20\nM99\n", increments)[101] == 5.0);
}

TEST_CASE("argument specification II counts I J K sets") {
    const Run r =
        run("#156=1.\n#23=2.\n#24=3.\nG65P9735A7.0B#9C0.0I#156J#23K#24I#135J0.5K0.6I0.7\n"
            "M30\nO9735\n#100=#1\n#101=#2\n#102=#4\n#103=#5\n#104=#6\n#105=#7\n#106=#8\n"
            "#107=#9\n#108=#10\nM99\n");
    CHECK(r[100] == 7.0);
    CHECK(interpreter::is_vacant(r[101]));
    CHECK(r[102] == 1.0);
    CHECK(r[103] == 2.0);
    CHECK(r[104] == 3.0);
    CHECK(interpreter::is_vacant(r[105]));
    CHECK(r[106] == 0.5);
    CHECK(r[107] == 0.6);
    CHECK(r[108] == 0.7);
    CHECK(run("G65P9I1.D5.\nM30\nO9\n#100=#4\n#101=#7\nM99\n")[101] == 5.0);
    CHECK(run("G65P9K1.I2.\nM30\nO9\n#100=#6\n#101=#7\nM99\n")[101] == 2.0);
    CHECK(alarm_of("G65P9A1.G1\nM30\nO9\nM99\n") == 129);
    CHECK(alarm_of("G65P9A1.N1\nM30\nO9\nM99\n") == 129);
    CHECK(alarm_of("X1.G65P9\nM30\nO9\nM99\n") == 127);
}

TEST_CASE("L repeats a macro with the same arguments") {
    const Run r = run("G65P9L3A1.\nM30\nO9\n#1=#1+1\nX#1\nM99\n");
    CHECK(r.blocks == Blocks{"X2", "X2", "X2", "M30"});
}

TEST_CASE("M98 shares the caller's variables and takes its repeats packed or as L") {
    const std::string sub = "M30\nO0005\n#1=#1+1.\nX#1\nM99\nO5101\nX51.\nM99\n";
    CHECK(run("#1=0\nM98P5\n" + sub).blocks == Blocks{"X1", "M30"});
    CHECK(run("#1=0\nM98P5L2\n" + sub).blocks == Blocks{"X1", "X2", "M30"});
    CHECK(run("#1=0\nM98P30005\n" + sub).blocks == Blocks{"X1", "X2", "X3", "M30"});
    CHECK(run("M98P25101\n" + sub).blocks == Blocks{"X51", "X51", "M30"});
    CHECK(run("M98P915101L1\nM30\nO915101\nX9.\nM99\n").blocks == Blocks{"X9", "M30"});
    CHECK(run("M98P915101\nM30\nO915101\nX9.\nM99\n").blocks == Blocks{"X9", "M30"});
    CHECK(run("G90M98P5X3.\n" + sub).blocks == Blocks{"G90 X3", "X1", "M30"});
    CHECK(run("M98P7Q20\nM30\nO7\nX1.\nN20X2.\nM99\n").blocks == Blocks{"X2", "M30"});
    CHECK(alarm_of("M98P77\n") == 76);
    CHECK(alarm_of("M198P-7\n") == 6);
    CHECK(alarm_of("M198P7.5\n") == 7);
    CHECK(alarm_of("M198\n") == 76);
    CHECK(alarm_of("M98P7Q21\nM30\nO7\nX1.\nN20X2.\nM99\n") == 78);
}

TEST_CASE("M99 P and L") {
    CHECK(run("M98P7\nX1.\nN30X3.\nM30\nO7\nX7.\nM99P30\n").blocks == Blocks{"X7", "X3", "M30"});
    CHECK(run("M98P7L5\nM30\nO7\nX7.\nM99L0\n").blocks == Blocks{"X7", "M30"});
    CHECK(run("X1.\nM99\nX2.\n").blocks == Blocks{"X1"});
    CHECK(run("#1=#1+1\nX#1\nIF[#1EQ3]GOTO9\nM99P5\nX99.\nN5 M99 "
              "P7\nN7GOTO8\nN8#1=#1+1\nX#1\nN9M30\n")
              .blocks == Blocks{"X1", "X2", "M30"});
    CHECK(alarm_of("M98P7\nM30\nO7\nM99P30\n") == 78);
    // P0 names a block too, and is not M99 alone.
    CHECK(alarm_of("M98P7\nM30\nO7\nX7.\nM99P0\n") == 78);
    CHECK(alarm_of("X1.\nM99P0\n") == 78);
}

TEST_CASE("called programs that end without M99 return") {
    CHECK(run("M98P7\nM30\nO7\nX7.\nO8\nX8.\n").blocks == Blocks{"X7", "M30"});
    CHECK(run("O1\nX1.\nO2\nX2.\n").blocks == Blocks{"X1"});
}

TEST_CASE("nesting limits") {
    CHECK(alarm_of("G65P9\nM30\nO9\nG65P9\nM99\n") == 122);
    CHECK(alarm_of("M98P9\nM30\nO9\nM98P9\nM99\n") == 77);
    const Run r =
        run("#100=0\nM98P9\nM30\nO9\n#100=#100+1\nIF[#100LT10]GOTO1\nM99\nN1M98P9\nM99\n");
    CHECK_FALSE(r.alarm);
    interpreter::InterpreterOptions old;
    old.dialect = interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_16i);
    const std::string four =
        "#100=0\nG65P9\nM30\nO9\n#100=#100+1\nIF[#100LT5]GOTO1\nM99\nN1G65P9\nM99\n";
    CHECK(alarm_of(four) == 0);
    CHECK(alarm_of(four, old) == 122);
}

TEST_CASE("programs come from the source, M198 only from there") {
    interpreter::ProgramsInMemory folder;
    folder.add(50, "O0050\nX50.\nM99\n");
    folder.add(51, "X51.\nM99\n");
    folder.add(60, "O60\nX60.\nM99\nO61\nX61.\nM99\n");
    CHECK(run_on(folder, "M98P50\nM98P51\nG65P50\nM30\n").blocks ==
          Blocks{"X50", "X51", "X50", "M30"});
    CHECK(run_on(folder, "M198P50\nM30\nO50\nX5.\nM99\n").blocks == Blocks{"X50", "M30"});
    CHECK(run_on(folder, "M98P50\nM30\nO50\nX5.\nM99\n").blocks == Blocks{"X5", "M30"});
    CHECK(run_on(folder, "M98P50\nM98P50\nM98P50\nM30\n").blocks ==
          Blocks{"X50", "X50", "X50", "M30"});
}

TEST_CASE("a block with G67 may call or return as well") {
    CHECK(run("G67M98P9\nX1.\nM30\nO9\nZ9.\nM99\n").blocks == Blocks{"Z9", "X1", "M30"});
    const Run r = run("G66P9\nX1.\nG67M98P8\nX2.\nM30\nO9\nY9.\nM99\nO8\nX8.\nM99\n");
    CHECK(r.blocks == Blocks{"X1", "Y9", "X8", "X2", "M30"});
    CHECK(run("G67J2M98\nM30\n").alarm.value().number == 76);
    CHECK(run("G65P9G67\nM30\nO9\nM99\n").alarm.value().number == 129);
    CHECK(run("G67G65P9\nM30\nO9\nM99\n").alarm.value().number == 127);
}

TEST_CASE("G66 calls behind every motion until G67") {
    const Run r = run("G66P9A5.\nX1.\nM8\nX2.\nG67\nX3.\nM30\nO9\nZ#1\n#1=#1+1.\nM99\n");
    CHECK(r.blocks == Blocks{"X1", "Z5", "M8", "X2", "Z6", "X3", "M30"});
    CHECK(run("G40G67G80\n").blocks == Blocks{"G40 G80"});
}

TEST_CASE("nested G66: a move of the later macro calls the earlier one") {
    const Run r = run("G66P91\nG66P92\nX1.\nG67\nG67\nX2.\nM30\nO91\nM91\nM99\nO92\nY1.\nM99\n");
    CHECK(r.blocks == Blocks{"X1", "Y1", "M91", "X2", "M30"});
}

TEST_CASE("G66.1 passes whole blocks as arguments") {
    const Run r = run("G66.1P9\nG1X5.F100\nG67\nM30\nO9\n#100=#10\n#101=#24\n#102=#9\nM99\n");
    CHECK(r[100] == 1.0);
    CHECK(r[101] == 5.0);
    CHECK(r[102] == 100.0);
}

TEST_CASE("codes mapped to programs by parameters") {
    interpreter::InterpreterOptions options;
    options.calls.m[6] = {9001, false, false};
    options.calls.g[1000] = {9010, true, false};
    options.calls.g[1010] = {9011, true, true};
    options.calls.m[50] = {9020, true, false};
    const std::string subs =
        "M30\nO9001\nM6\nX#100\nM99\nO9010\nY#1\nM99\nO9011\nZ9.\nM99\nO9020\nB#24\nM99\n";
    CHECK(run("T5M6\n" + subs, options).blocks == Blocks{"T5", "M6", "", "M30"});
    CHECK(run("G100A3.\n" + subs, options).blocks == Blocks{"Y3", "M30"});
    CHECK(run("G101\nX1.\nG67\nX2.\n" + subs, options).blocks == Blocks{"X1", "Z9", "X2", "M30"});
    CHECK(run("M50X4.\n" + subs, options).blocks == Blocks{"B4", "M30"});
    CHECK(run("#1=94\nG[#1+6]A8.\n" + subs, options).blocks == Blocks{"Y8", "M30"});
    interpreter::InterpreterOptions tools;
    tools.calls.t_calls_9000 = true;
    CHECK(run("T7M6\nM30\nO9000\nS#149\nT#149\nM99\n", tools).blocks ==
          Blocks{"M6", "S7", "T7", "M30"});
}

TEST_CASE("programs are called by name") {
    const std::string sub = "M30\n<SUB-1>\nX#1\nM99\n";
    CHECK(run("#1=2\nM98<SUB-1>L2\nG65<SUB-1>A5.\n" + sub).blocks ==
          Blocks{"X2", "X2", "X5", "M30"});
    CHECK(run("#1=2\n#2=0\nWHILE[#2LT2]DO1\nG90M98 <SUB-1>\n#2=#2+1\nEND1\n" + sub).blocks ==
          Blocks{"G90", "X2", "G90", "X2", "M30"});
    CHECK(alarm_of("M98<OTHER>\n") == 76);
    CHECK(alarm_of("X1.<SUB-1>\n" + sub) == 9);
}

TEST_CASE("MACRO.TXT lines set variables and names") {
    const Run r =
        run("%\nG10L85P500(400777CED9168730)\nG10L85P501(FFFFFFFFFFFFFFFF)\n"
            "G10L85P502(3FF8000000000000)\nSETVN500[LEN,,RAD]\n#[#RAD]=#[#RAD]*2\nM02\n%\n");
    CHECK_FALSE(r.alarm);
    CHECK(r[500] == 2.933500000000002);
    CHECK(interpreter::is_vacant(r[501]));
    CHECK(r[502] == 3.0);
    CHECK(r.blocks == Blocks{"M2"});
    CHECK(alarm_of("G10L85P500(12)\n") == 1144);
    CHECK(run("G10L2P1X5.\n").blocks == Blocks{"G10 L2 P1 X5"});
}

TEST_CASE("from five digits on, P of M98 holds the repeats in front of four digits of the number") {
    const auto is = [](int p, int l, bool packed, int number, int repeats) {
        const interpreter::SubprogramCall call = interpreter::unpack_subprogram(p, l, packed);
        const auto& [found, times] = call;
        return found == number && times == repeats;
    };
    CHECK(is(9999, -1, true, 9999, 1));
    CHECK(is(10000, -1, true, 0, 1));
    CHECK(is(30012, -1, true, 12, 3));
    CHECK(is(30012, 2, true, 30012, 2));
    CHECK(is(30012, -1, false, 30012, 1));
    CHECK(is(12, 0, true, 12, 0));
}
