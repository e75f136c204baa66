#include "base/screen.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

namespace trunnion::inline base {
namespace {

bool environment_has(const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
}

/// The character set of the locale, as the C library chooses its name.
bool locale_is_utf8() {
    for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"})
        if (environment_has(name)) {
            std::string value = std::getenv(name);
            std::erase(value, '-');
            std::transform(value.begin(), value.end(), value.begin(),
                           [](unsigned char c) { return std::tolower(c); });
            return value.find("utf8") != std::string::npos;
        }
    return false;
}

/// Nothing for a file or a pipe: they get the bytes as they are.
void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

}  // namespace

std::optional<Screen> screen_of(int descriptor) {
    if (::isatty(descriptor) != 1) return std::nullopt;
    const char* terminal = std::getenv("TERM");
    const bool dumb = !terminal || std::string_view(terminal) == "dumb";
    return Screen{locale_is_utf8(), !dumb && !environment_has("NO_COLOR")};
}

std::string for_screen(std::string_view text, Screen screen) {
    std::string out(text);
    if (!screen.utf8)
        for (const auto& [from, to] : {std::pair{"µ", "u"}, {"±", "+-"}, {"–", "-"}, {"°", " deg"}})
            replace_all(out, from, to);
    if (screen.colour)
        for (const auto& [from, to] : {std::pair{"error: ", "\033[31merror:\033[0m "},
                                       {"warning: ", "\033[33mwarning:\033[0m "},
                                       {"verdict: ", "\033[1mverdict:\033[0m "}})
            replace_all(out, from, to);
    return out;
}

}  // namespace trunnion::inline base
