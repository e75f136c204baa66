// The edges of the language: what holds before a program is open, at limits, and for odd options.
#include <catch2/catch.hpp>
#include <cmath>

#include "interpreter/parse.h"
#include "interpreter/word_rules.h"
#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

namespace {

interpreter::ParsedProgram parsed(std::string_view text) {
    return interpreter::parse_program({"p", text, nullptr}, {});
}

}  // namespace

TEST_CASE("an interpreter that has opened nothing is nowhere") {
    interpreter::ProgramsInMemory none;
    PlainSystem system;
    const interpreter::Interpreter nc(none, {}, system, {});
    CHECK(nc.where().line == 0);
    CHECK(nc.program_name().empty());
    CHECK(nc.block_text().empty());
    CHECK(nc.program_number() == 0);
}

TEST_CASE("a program is opened by its number; one that is missing is alarm 76") {
    interpreter::ProgramsInMemory folder;
    folder.add(7, "O7\nX1.\n#1=1/0\n");
    PlainSystem system;
    interpreter::Interpreter nc(folder, {}, system, {});
    CHECK_THROWS_AS(nc.open(8), Alarm);
    nc.open(7);
    REQUIRE(nc.next());
    CHECK(nc.program_number() == 7);
    CHECK_THROWS_AS(nc.next(), Alarm);
}

TEST_CASE("a text without a name is called by its program number") {
    interpreter::ProgramsInMemory none;
    PlainSystem system;
    interpreter::Interpreter nc(none, {}, system, {});
    nc.open(interpreter::ProgramText{"", "O12\nX1.\n", nullptr});
    REQUIRE(nc.next());
    CHECK(nc.where().program == "O12");
    CHECK(nc.where().line == 2);
}

TEST_CASE("a number without a row in the table of alarms is an alarm all the same") {
    CHECK(interpreter::language_alarm(9999) == nullptr);
    try {
        interpreter::raise_language_alarm(9999, 5, "detail");
        FAIL("no alarm");
    } catch (const Alarm& alarm) {
        CHECK(alarm.number == 9999);
        CHECK(alarm.text == "ALARM: detail");
        CHECK(alarm.where.column == 5);
    }
}

TEST_CASE("an alarm of a system variable that knows its place keeps it") {
    struct Placed : PlainSystem {
        double get(int) override { throw Alarm(115, "T", {"store", 3, 4}); }
        void set(int, double, const char*) override {
            Alarm alarm(116, "T", {"store", 5, 6});
            alarm.block = "B";
            throw alarm;
        }
    };
    interpreter::ProgramsInMemory none;
    for (const bool writes : {false, true}) {
        Placed system;
        interpreter::Interpreter nc(none, {}, system, {});
        nc.open(interpreter::ProgramText{"p", writes ? "#5001=1\n" : "#1=#5001\n", nullptr});
        try {
            nc.next();
            FAIL("no alarm");
        } catch (const Alarm& alarm) {
            CHECK(alarm.where.program == "store");
            CHECK(alarm.where.line == (writes ? 5 : 3));
            CHECK(alarm.where.column == (writes ? 6 : 4));
            CHECK(alarm.block == (writes ? "B" : "#1=#5001"));
        }
    }
}

TEST_CASE("angles: exact at quarters, far angles, both ranges of the arc functions") {
    CHECK(value_of("TAN[180]") == 0.0);
    CHECK(value_of("TAN[0]") == 0.0);
    CHECK(value_of("SIN[100000000035]") == std::sin(100000000035.0 * (std::acos(-1.0) / 180.0)));
    CHECK(value_of("COS[100000000035]") == std::cos(100000000035.0 * (std::acos(-1.0) / 180.0)));
    CHECK(value_of("ATAN[1]/[0]") == 90.0);
    CHECK(value_of("ATAN[0]/[1]") == 0.0);
    CHECK(value_of("ATAN[0]/[-1]") == 180.0);
    CHECK(value_of("POW[0,2]") == 0.0);
    CHECK(value_of("POW[0,0]") == 1.0);
    CHECK(value_of("+5") == 5.0);
    interpreter::InterpreterOptions options;
    options.asin_0_to_minus_90 = true;
    CHECK(value_of("ASIN[-0.5]", options) == Approx(-30.0));
    CHECK(value_of("ASIN[0.5]", options) == Approx(30.0));
    CHECK(value_of("ATAN[-1]/[1]", options) == Approx(-45.0));
}

TEST_CASE("an indirect number reaches each kind of variable") {
    CHECK(run("#100=#[#0]\n").common.empty());
    CHECK(run("#[2]=5\n#100=#[1+1]\n")[100] == 5.0);
    CHECK(run("#[33]=5\n#100=#33\n")[100] == 5.0);
    CHECK(alarm_of("#100=#[34]\n") == 115);
    CHECK(alarm_of("#100=#[-1]\n") == 115);
    CHECK(alarm_of("#[-1]=1\n") == 115);
    CHECK(alarm_of("#[0]=1\n") == 116);
    CHECK(value_of("PRM[#0]") == Approx(0.0 - 0.1 - 0.01));
    CHECK(run("BPRNT[#1[2]]\n").printed == std::string(4, '\0') + "\n");
}

TEST_CASE("an expression holds 48 operands, over all its functions") {
    const auto nested = [](int levels) {
        std::string text, ends;
        for (int i = 0; i < levels; ++i) text += "1+1*ABS[", ends += ']';
        return text + "1" + ends;
    };
    CHECK(value_of(nested(23)) == 24.0);
    CHECK(alarm_of("#100=" + nested(24) + "\n") == 118);
}

TEST_CASE("code that no cache holds runs from the text") {
    // Two hundred long sums are more code than the cache keeps.
    std::string sum = "#100=#100+0";
    for (int i = 0; i < 2000; ++i) sum += "+#2";
    std::string text = "#1=0\n#2=0\n#100=0\nWHILE[#1LT2]DO1\n";
    for (int i = 0; i < 200; ++i) text += sum + "+1\n";
    const Run r = run(text + "#1=#1+1\nEND1\nX#100\n");
    CHECK(r.blocks == Blocks{"X400"});
}

TEST_CASE("a loop inside a macro outlives the flush of the block cache") {
    // 66,000 blocks are twice what the cache holds; after 131,072 misses it begins anew.
    std::string text = "#100=0\nG65P9L2\nM30\nO9\n#1=0\nWHILE[#1LT3]DO1\n#2=0\n";
    for (int i = 0; i < 66000; ++i) text += "X1.\n";
    text += "#100=#100+1\n#1=#1+1\nEND1\nM99\n";
    interpreter::InterpreterOptions options;
    options.max_blocks = 1000000;
    const Run r = run(text, options);
    CHECK_FALSE(r.alarm);
    CHECK(r[100] == 6.0);
    CHECK(r.blocks.size() == 396001u);
}

TEST_CASE("a limit too large to count lines by still counts blocks") {
    interpreter::InterpreterOptions options;
    options.max_blocks = ~std::uint64_t{0};
    int asked = 0;
    options.go_on = [&](std::uint64_t) { return ++asked < 3; };
    const Run r = run("N1GOTO1\n", options);
    CHECK(r.limit);
    CHECK(asked == 3);
}

TEST_CASE(
    "codes of the options: those the language cannot write call nothing, M1000 and above do") {
    interpreter::InterpreterOptions options;
    options.calls.g[-10] = options.calls.g[10000] = {9, true, false};
    options.calls.m[-1] = {9, true, false};
    options.calls.m[1234] = {9, true, false};
    options.skip_switches = {false, true};
    const std::string sub = "M30\nO9\nY9.\nM99\n";
    CHECK(run("M1234\n" + sub, options).blocks == Blocks{"Y9", "M30"});
    CHECK(run("M1233\n" + sub, options).blocks == Blocks{"M1233", "M30"});
    CHECK(run("/X1.\n/2X2.\n" + sub, options).blocks == Blocks{"X2", "M30"});
}

TEST_CASE("calls: arguments of G66.1, words that are no argument, too many modal calls") {
    const Run r = run("G66.1P9\nG1L2.P3.F100\nG67\nM30\nO9\n#100=#10\n#101=#12\n#102=#16\nM99\n");
    CHECK(r[100] == 1.0);
    CHECK(r[101] == 2.0);
    CHECK(r[102] == 3.0);
    CHECK(alarm_of("G65P9,R1.\nM30\nO9\nM99\n") == 129);
    std::string modal;
    for (int i = 0; i < 7; ++i) modal += "G66P9\n";
    CHECK(alarm_of(modal + "M30\nO9\nM99\n") == 122);
    CHECK(alarm_of("G66P9\nG66P9\nX1.\nM30\nO9\nM99\n") == 0);
    const std::string deep =
        "G65P1\nM30\nO1\nG65P2\nO2\nG65P3\nO3\nG65P4\nO4\nG65P5\nO5\nX1.\nM99\nO9\nM99\n";
    CHECK(alarm_of(deep) == 0);
    CHECK(alarm_of("G66P9\n" + deep) == 122);
}

TEST_CASE("a call of every block is not made inside the macro of a later G66") {
    const std::string subs = "G67\nG67\nM30\nO8\nM8\nM99\nO9\nY1.\nM99\n";
    CHECK(run("G66.1P8\nG66P9\nX1.\n" + subs).blocks == Blocks{"X1", "Y1", "M30"});
    CHECK(run("G66P9\nG66.1P8\nX1.\n" + subs).blocks == Blocks{"M8", "M30"});
}

TEST_CASE("vacant words of a call stand for nothing") {
    CHECK(run("G65P9L#1\nG#1M98P9\nM30\nO9\nY9.\nM99\n").blocks == Blocks{"Y9", "", "Y9", "M30"});
    CHECK(run("G#1G67X1.\n").blocks == Blocks{"X1"});
}

TEST_CASE("a call that is made no times does nothing") {
    const std::string sub = "M30\nO9\nY9.\nM99\n";
    CHECK(run("G65P9L0\n" + sub).blocks == Blocks{"M30"});
    CHECK(run("M98P9L0\n" + sub).blocks == Blocks{"M30"});
    CHECK(run("G66P9L0\nX1.\nG67\n" + sub).blocks == Blocks{"X1", "M30"});
}

TEST_CASE("a modal call by code counts with the others; codes in its macro call nothing") {
    interpreter::InterpreterOptions options;
    options.calls.g[1010] = {9, true, true};
    options.calls.m[50] = {8, true, false};
    const std::string subs = "G67\nM30\nO9\nY9.M50\nM99\nO8\nG101\nM98P7\nM99\nO7\nM50\nM99\n";
    CHECK(run("M50\n" + subs, options).blocks == Blocks{"G101", "M50", "M30"});
    std::string modal;
    for (int i = 0; i < 7; ++i) modal += "G101\n";
    CHECK(alarm_of(modal + subs, options) == 122);
}

TEST_CASE("deep calls by code end in an alarm, as others do") {
    interpreter::InterpreterOptions options;
    options.dialect.total_levels = 6;
    CHECK(alarm_of("M98P9\nM30\nO9\nM98P9\n", options) == 77);
    options.calls.g[1000] = {9, true, false};
    CHECK(alarm_of("G65P8\nM30\nO8\nG65P8\nO9\nM99\n", options) == 122);
    CHECK(alarm_of("G65P8A1.\nM30\nO8\nG65P8A1.\nO9\nM99\n", options) == 122);
}

TEST_CASE("eight hexadecimal bytes or alarm 1144") {
    CHECK(alarm_of("G10L85P500(40077 CED9168730)\n") == 1144);
    CHECK(alarm_of("G10L85P500(ZZ0777CED9168730)\n") == 1144);
    CHECK(alarm_of("G10L85P500(400777CED916873Z)\n") == 1144);
    CHECK(run("G10L85\n").blocks == Blocks{"G10 L85"});
    CHECK(run("(A)G10L85P500(3FF8000000000000)\n")[500] == 1.5);
}

TEST_CASE("M99 P in the main program, and a return to a number that is missing") {
    CHECK(run("GOTO5\nN1X1.\nM30\nN5M99P1\n").blocks == Blocks{"X1", "M30"});
    CHECK(alarm_of("M99P7\n") == 78);
    CHECK(alarm_of("M98P9\nM30\nO9\nM99P7\n") == 78);
}

TEST_CASE("a number that stands more than once: the next one, else the first") {
    std::string many;
    for (int i = 0; i < 300001; ++i) many += "N3\n";
    const std::string body =
        "#1=#1+1\nIF[#1GT1]GOTO9\nGOTO5\nX2.\nN5X5.\n" + many + "GOTO2\nN9M30\n";
    interpreter::InterpreterOptions options;
    options.max_blocks = 1000000;
    const Run r = run("#1=0\nN2X1.\nN2\n" + body, options);
    CHECK_FALSE(r.alarm);
    CHECK(r.blocks == Blocks{"X1", "X5", "X1", "M30"});
}

TEST_CASE("programs of a file whose own number differs, and by a name that only the source knows") {
    interpreter::ProgramsInMemory folder;
    folder.add(50, "O51\nX51.\nM99\n");
    folder.add(60, "X60.\nM99\n");
    CHECK(run_on(folder, "M98P50\nM98<O60>\nM98<60>\nM30\n").blocks ==
          Blocks{"X51", "X60", "X60", "M30"});
    for (const char* name : {"<O61>", "<6A>", "<->"}) {
        INFO(name);
        CHECK(run_on(folder, std::string("M98") + name + "\n").alarm.value().number == 76);
    }
}

TEST_CASE("a program is found by its name inside a file of the source, and once for all calls") {
    struct Parts : interpreter::ProgramSource {
        std::string text = "O1\nX1.\nM99\n<PARTS>\nX2.\nM99\n";
        int asked = 0;
        std::optional<interpreter::ProgramText> find(int) override {
            ++asked;
            return interpreter::ProgramText{"parts.nc", text, nullptr};
        }
        std::optional<interpreter::ProgramText> find(std::string_view) override { return find(1); }
    } source;
    CHECK(run_on(source, "M98<PARTS>\nM98<PARTS>\nM30\n").blocks == Blocks{"X2", "X2", "M30"});
    CHECK(source.asked == 1);
    CHECK(run_on(source, "M198P1\nM198P1\nM30\n").blocks == Blocks{"X1", "X1", "M30"});
    CHECK(source.asked == 2);
}

TEST_CASE("lines of DPRNT go nowhere when nobody takes them; M99 may repeat the main program") {
    interpreter::ProgramsInMemory none;
    PlainSystem system;
    interpreter::InterpreterOptions options;
    options.main_m99_ends = false;
    interpreter::Interpreter nc(none, options, system, {});
    nc.open(interpreter::ProgramText{"p", "DPRNT[A]\nX1.\nM99\n", nullptr});
    for (int i = 0; i < 3; ++i) REQUIRE(nc.next());
}

TEST_CASE("#3000 takes the first comment behind its '=', else the first of the block") {
    CHECK(run("(A)#3000=1(B)(C)\n").alarm.value().text == "B");
    CHECK(run("(A)(B)#3000=1\n").alarm.value().text == "A");
    CHECK(run("#3000=1\n").alarm.value().text.empty());
}

TEST_CASE("two programs with many numbers are searched in turn") {
    std::string many;
    for (int i = 10; i < 30020; ++i) many += "N" + std::to_string(i) + "\n";
    const Run r = run("#1=0\nN1#1=#1+1\nM98P9\nIF[#1LT3]GOTO1\nGOTO7\n" + many +
                      "N7M30\nO9\nGOTO5\n" + many + "N5X#1\nM99\n");
    CHECK(r.blocks == Blocks{"X1", "X2", "X3", "M30"});
    CHECK(alarm_of("GOTO99999\n" + many) == 128);
}

TEST_CASE("two blocks are the same when nothing that they say differs") {
    std::vector<std::string> texts{"X1.",           "X1",
                                   "X2.",           "Y1.",
                                   "X-1.",          "N5X1.",
                                   "O5X1.",         "<A>X1.",
                                   "<B>X1.",        "X1.(c)",
                                   "X1.(d)",        "X1.Y1.",
                                   "/X1.",          "/2X1.",
                                   "X#1",           "X#2",
                                   "X-#1",          "X[1.]",
                                   "X[2.]",         "X[#1+1]",
                                   "X[#1-1]",       "#1=1",
                                   "#2=1",          "#[1]=1",
                                   "#[2]=1",        "DPRNT[A]",
                                   "DPRNT[B]",      "DPRNT[#1[12]]",
                                   "DPRNT[#1[22]]", "DPRNT[#1[13]]",
                                   "SETVN500[A]",   "SETVN500[B]",
                                   "SETVN501[A]",   "M98<A>",
                                   "M98<B>",        "DO1",
                                   "DO2",           "END1",
                                   "GOTO1",         "GOTO2",
                                   "GOTO#1",        "%"};
    std::vector<interpreter::ParsedProgram> programs;
    for (std::string& text : texts) programs.push_back(parsed(text += '\n'));
    for (std::size_t i = 0; i < texts.size(); ++i)
        for (std::size_t k = 0; k < texts.size(); ++k) {
            INFO(texts[i] << " and " << texts[k]);
            const interpreter::ParsedProgram &a = programs[i], &b = programs[k];
            REQUIRE(a.blocks.size() == 1);
            CHECK(interpreter::same_block(a, a.blocks[0], b, b.blocks[0]) == (i == k));
        }
}

TEST_CASE("the value of a word without variables") {
    const auto value = [](std::string_view text) {
        const interpreter::ParsedProgram p = parsed(text);
        return interpreter::constant_value(p, p.items(p.blocks.at(0))[0]);
    };
    CHECK(value("X5.\n") == 5.0);
    CHECK(value("X[5.]\n") == 5.0);
    CHECK(value("X-[5.]\n") == -5.0);
    CHECK(value("X[5.+5.]\n") == 10.0);
    CHECK(value("X-[5.+5.]\n") == -10.0);
    CHECK(value("P[-1 OR 2]\n") == -1.0);
    for (const char* text : {"X#5\n", "X[5.+#5]\n", "X#0\n", "X[1/0]\n", "X[PRM[20]]\n", "X#[5]\n",
                             "X[ROUND[2.4]]\n", "X[ASIN[-1]]\n"}) {
        INFO(text);
        CHECK_FALSE(value(text));
    }
}

TEST_CASE("a call needs the program that it calls; where it begins is a whole number") {
    const auto alarm_of_words = [](const std::vector<interpreter::WordValue>& words) {
        interpreter::BlockWords block;
        for (const interpreter::WordValue& word : words) block.words[block.count++] = word;
        const auto fault = interpreter::find_word_fault(block, interpreter::DialectFamily::fanuc);
        return fault ? fault->alarm : 0;
    };
    CHECK(alarm_of_words({{65.0, 'G'}, {1.0, 'A'}}) == 76);
    CHECK(alarm_of_words({{65.0, 'G'}, {100.0, 'P'}}) == 0);
    CHECK(alarm_of_words({{65.0, 'G'}, {0.0, '<'}, {1.0, 'A'}}) == 0);
    CHECK(alarm_of_words({{98.0, 'M'}, {9.0, 'P'}, {5.0, 'Q'}}) == 0);
    CHECK(alarm_of_words({{98.0, 'M'}, {9.0, 'P'}, {5.5, 'Q'}}) == 7);
}
