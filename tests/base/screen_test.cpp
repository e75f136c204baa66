#include "base/screen.h"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>

using namespace trunnion;

namespace {

/// The screen of a terminal with these variables alone, of those that say what it can show.
Screen screen_with(const std::map<std::string, std::string>& variables) {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG", "TERM", "NO_COLOR"}) ::unsetenv(name);
    for (const auto& [name, value] : variables) ::setenv(name.c_str(), value.c_str(), 1);
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    REQUIRE(terminal >= 0);
    const auto screen = screen_of(terminal);
    ::close(terminal);
    REQUIRE(screen);
    return *screen;
}

}  // namespace

TEST_CASE("a terminal shows what its locale and its kind allow") {
    CHECK_FALSE(screen_with({{"TERM", "xterm"}}).utf8);
    CHECK(screen_with({{"LANG", "de_DE.UTF-8"}}).utf8);
    CHECK(screen_with({{"LANG", "C"}, {"LC_CTYPE", "C.utf8"}}).utf8);
    CHECK_FALSE(screen_with({{"LANG", "de_DE.UTF-8"}, {"LC_ALL", "C"}}).utf8);
    CHECK(screen_with({{"LANG", "de_DE.UTF-8"}, {"LC_ALL", ""}}).utf8);
    CHECK(screen_with({{"TERM", "xterm"}}).colour);
    CHECK(screen_with({{"TERM", "xterm"}, {"NO_COLOR", ""}}).colour);
    CHECK_FALSE(screen_with({{"TERM", "xterm"}, {"NO_COLOR", "1"}}).colour);
    CHECK_FALSE(screen_with({{"TERM", "dumb"}}).colour);
    CHECK_FALSE(screen_with({}).colour);
    const int file = ::open("/dev/null", O_WRONLY);
    CHECK_FALSE(screen_of(file));
    ::close(file);
}

TEST_CASE("a terminal without UTF-8 gets units in ASCII") {
    const std::string text = "0.5 ± 0.1 µm at 90° – 3 µrad";
    CHECK(for_screen(text, {true, false}) == text);
    CHECK(for_screen(text, {false, false}) == "0.5 +- 0.1 um at 90 deg - 3 urad");
}

TEST_CASE("colour marks the words of errors, and only these") {
    CHECK(for_screen("a.nc:2:1: error: bad\nverdict: no_gap\n", {true, true}) ==
          "a.nc:2:1: \033[31merror:\033[0m bad\n\033[1mverdict:\033[0m no_gap\n");
    CHECK(for_screen("a.nc:2:1: error: bad\n", {true, false}) == "a.nc:2:1: error: bad\n");
}
