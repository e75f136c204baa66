#include "base/toml_reader.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("a message shows the line as it stands in the file, whatever ends it") {
    for (const std::string end : {"\n", "\r\n"}) {
        const TomlFile file("[a]" + end + "x = \"y\"" + end + "z = [1, 2" + "]" + end, "s.toml");
        const TomlValue* const x = file.root().find("a")->find("x");
        REQUIRE(x);
        try {
            file.number(*x);
            FAIL("a text was taken for a number");
        } catch (const InputError& e) {
            CHECK(e.where.line == 2);
            CHECK(e.line_text == "x = \"y\"");
        }
    }
    const TomlFile last("x = \"y\"", "s.toml");  // no end of line at all
    CHECK_THROWS_AS(last.number(*last.root().find("x")), InputError);
}

TEST_CASE("a message about a place behind the end shows no line") {
    for (const char* text : {"a = 1", "a = 1\n", ""}) {
        const TomlFile file(text, "s.toml");
        TomlValue place;
        place.line = 7;
        try {
            file.fail(place, "nothing stands here");
        } catch (const InputError& e) {
            CHECK(e.where.line == 7);
            CHECK(e.line_text.empty());
        }
    }
}

TEST_CASE("a key that nobody asked for is told, one that was asked for is not") {
    const TomlFile file("known = 1\nunknwon = 2\n[a]\nknown = 3\nother = 4\n", "s.toml");
    file.root().find("known");
    file.root().find("a")->find("known");
    CHECK(file.unknown_keys() ==
          std::vector<std::string>{"s.toml:2:11: key 'unknwon' is not known and ignored",
                                   "s.toml:5:9: key 'a.other' is not known and ignored"});
}

TEST_CASE("a key has at most 65 parts") {
    std::string key = "a";
    for (int dots = 0; dots < 64; ++dots) key += ".a";
    CHECK_NOTHROW(TomlFile(key + " = 1\n", "s.toml"));
    CHECK_THROWS_AS(TomlFile(key + ".a = 1\n", "s.toml"), InputError);
}

TEST_CASE("numbers are finite, at most 1e12, and positive where that is asked") {
    const TomlFile file("a = 1e12\nb = 1.0000001e12\nc = nan\nd = -1\ne = 0\nf = inf\n", "s.toml");
    const auto value = [&](const char* key) { return *file.root().find(key); };
    CHECK(double(file.number(value("a"))) == 1e12);
    CHECK(double(file.number(value("d"))) == -1.0);
    for (const char* key : {"b", "c", "f"}) CHECK_THROWS_AS(file.number(value(key)), InputError);
    CHECK(double(file.positive(value("a"))) == 1e12);
    for (const char* key : {"d", "e"}) CHECK_THROWS_AS(file.positive(value(key)), InputError);
}

TEST_CASE("a text stands for a list of one, and every item of a list is one") {
    const TomlFile file("a = \"x\"\nb = [\"x\", \"y\"]\nc = [\"x\", 1]\nd = 2.5\ne = [1, 2]\n",
                        "s.toml");
    const auto value = [&](const char* key) { return *file.root().find(key); };
    CHECK(file.texts(value("a")) == std::vector<std::string>{"x"});
    CHECK(file.texts(value("b")) == std::vector<std::string>{"x", "y"});
    CHECK_THROWS_AS(file.texts(value("c")), InputError);
    CHECK_THROWS_AS(file.texts(value("d")), InputError);
    CHECK(file.numbers(value("d")) == std::vector<double>{2.5});
    CHECK(file.numbers(value("e")) == std::vector<double>{1.0, 2.0});
    CHECK_THROWS_AS(file.numbers(value("b")), InputError);
}
