// docs/setup_file.md is true: its examples load, and it names every key that the reader asks for.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "setup/setup.h"

using namespace trunnion;

namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

const std::filesystem::path source = TRUNNION_SOURCE_DIR;

/// All TOML examples of the page as one file.
std::string examples() {
    std::istringstream page(text_of(source / "docs/setup_file.md"));
    std::string all, line;
    for (bool inside = false; std::getline(page, line);) {
        if (line == "```toml")
            inside = true;
        else if (line == "```")
            inside = false;
        else if (inside)
            all += line + '\n';
    }
    return all;
}

/// Words in quotes that the reader hands to find or find_number.
std::set<std::string> keys_of_reader() {
    std::set<std::string> keys;
    const std::regex call(
        R"re((?:find|find_number|read_switch|code)\([^;]*?"([a-z][a-z0-9_]*)")re");
    const std::regex also(R"re("([a-z][a-z0-9_]*_(?:mm|deg|rad|um|hz|s2|min|k|c))")re");
    for (const auto& entry : std::filesystem::directory_iterator(source / "setup")) {
        if (entry.path().extension() != ".cpp" || entry.path().stem() == "setup_format") continue;
        const std::string code = text_of(entry.path());
        for (const std::regex& pattern : {call, also})
            for (std::sregex_iterator it(code.begin(), code.end(), pattern), end; it != end; ++it)
                keys.insert((*it)[1]);
    }
    return keys;
}

}  // namespace

TEST_CASE("the examples of docs/setup_file.md load as one file without an unknown key") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(examples(), "docs/setup_file.md", notes);
    CHECK(setup.name == "Example");
    CHECK(setup.artefacts.size() >= 2);
    for (const std::string& note : notes) {
        INFO(note);
        CHECK(note.find("is not known") == std::string::npos);
    }
}

TEST_CASE("docs/setup_file.md names every key that the reader asks for") {
    const std::string page = text_of(source / "docs/setup_file.md");
    const std::set<std::string> keys = keys_of_reader();
    CHECK(keys.size() > 40);
    for (const std::string& key : keys) {
        INFO(key);
        CHECK(std::regex_search(page, std::regex("\\b" + key + "\\b")));
    }
}
