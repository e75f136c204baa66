#include "base/text.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/alarm.h"

using namespace trunnion;

TEST_CASE("printable text holds nothing that a terminal obeys") {
    CHECK(printable("a\tb \xC2\xB5m") == "a\tb \xC2\xB5m");
    CHECK(printable("\x1B[2J\a\r\n") == "?[2J???");
    CHECK(printable(std::string("\0x", 2)) == "?x");
    CHECK(printable("\x7F\xFF\xC2") == "???");
    CHECK(printable("\xC2\x9B"
                    "2J") == "?2J");  // the one-character form of ESC [
    CHECK(printable("\xC2\xA0") == "\xC2\xA0");
    // U+D7FF is the last before the surrogates, U+D800 the first of them.
    CHECK(printable("\xED\x9F\xBF") == "\xED\x9F\xBF");
    CHECK(printable("\xED\xA0\x80") == "???");
    CHECK(printable("\xE0\x9F\xBF") == "???");
    CHECK(printable("\xE0\xA4\x84") == "\xE0\xA4\x84");  // the shortest lead of three bytes
    // A byte that continues a character, or begins none, does not swallow what stands behind it.
    CHECK(printable("\x80\x80\x80\x80") == "????");
    CHECK(printable("\xF5\x80\x80\x80") == "????");
    CHECK(printable("\xF0\x8F\xBF\xBF") == "????");
    CHECK(printable("\xF4\x90\x80\x80") == "????");
    CHECK(printable("\xF0\x90\x80\x80") == "\xF0\x90\x80\x80");  // U+10000
    CHECK(printable("\xF4\x8F\xBF\xBF") == "\xF4\x8F\xBF\xBF");  // the last, U+10FFFF
    CHECK(screen_width("a\xC2\xB5m") == 3);
}

TEST_CASE("the caret stands under its column, whatever the line holds") {
    const auto diagnostic = [](const std::string& line, int column) {
        return format_diagnostic({"p.nc", 3, column}, "wrong", line);
    };
    CHECK(diagnostic("G1 X1.", 4) == "p.nc:3:4: error: wrong\n    G1 X1.\n       ^");
    CHECK(diagnostic("\tX1.", 2) == "p.nc:3:2: error: wrong\n    \tX1.\n    \t^");
    CHECK(diagnostic("(\xC2\xB5m) X", 7) ==
          "p.nc:3:7: error: wrong\n    (\xC2\xB5m) X\n         ^");
    CHECK(diagnostic("\x1B]0;x\aX", 7) == "p.nc:3:7: error: wrong\n    ?]0;x?X\n          ^");
    CHECK(diagnostic("X", 40000) == "p.nc:3:40000: error: wrong\n    X\n     ^");
}

TEST_CASE("a long line is shown around its column") {
    std::string line(100'000, '.');
    line[70'000] = 'X';
    const std::string shown =
        format_diagnostic({"p.nc", 1, 70'001}, std::string(99'999, 'm'), line);
    CHECK(shown.size() < 2000);
    const std::size_t first = shown.find('\n'), second = shown.find('\n', first + 1);
    CHECK(shown.find('X') - first == shown.find('^') - second);
}

TEST_CASE("a line of 200 characters is shown whole, of a longer one 200 characters") {
    const auto shown_of = [](std::size_t size, int column) {
        const std::string text =
            format_diagnostic({"p.nc", 1, column}, "m", std::string(size, 'x'));
        return std::count(text.begin(), text.end(), 'x');
    };
    CHECK(shown_of(200, 150) == 200);
    CHECK(shown_of(201, 50) == 200);
    CHECK(shown_of(201, 101) == 200);
    CHECK(shown_of(201, 102) == 200);  // it begins one character later
    CHECK(shown_of(301, 301) == 101);
}

TEST_CASE("a line without a known column is shown from its beginning, however long it is") {
    const std::string line = "begin " + std::string(500, 'x');
    CHECK(format_diagnostic({"a.nc", 3, 0}, "bad", line).find("\n    begin xxx") !=
          std::string::npos);
    CHECK(format_diagnostic({"a.nc", 3, 0}, "bad", "short").ends_with("\n    short"));
}
