// What comments and documents point to exists: files by their path, names in back quotes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source = TRUNNION_SOURCE_DIR;

bool is_left_out(const fs::path& path) {
    const std::string top = path.begin()->string();
    return top == "build" || top == "out" || top == ".git" ||
           path.string().find("node_modules") != std::string::npos ||
           path.string().starts_with("web/dist");
}

/// Paths of the files of the repository with one of these endings, relative to its root.
std::vector<fs::path> files_with(const std::set<std::string>& endings) {
    std::vector<fs::path> files;
    for (auto it = fs::recursive_directory_iterator(source);
         it != fs::recursive_directory_iterator(); ++it) {
        const fs::path path = fs::relative(it->path(), source);
        if (is_left_out(path)) {
            if (it->is_directory()) it.disable_recursion_pending();
            continue;
        }
        if (it->is_regular_file() &&
            (endings.empty() || endings.contains(path.extension().string())))
            files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(source / path, std::ios::binary).rdbuf();
    return text.str();
}

/// The comments of a C++ file; the whole of a document.
std::string prose_of(const fs::path& path) {
    const std::string text = text_of(path);
    if (path.extension() == ".md") return text;
    std::istringstream lines(text);
    std::string prose, line;
    while (std::getline(lines, line))
        if (const auto at = line.find("//"); at != std::string::npos)
            prose += line.substr(at) + '\n';
    return prose;
}

std::vector<fs::path> written_for_readers() {
    std::vector<fs::path> files;
    for (const fs::path& path : files_with({".h", ".cpp", ".md"}))
        if (path != "CHANGELOG.md") files.push_back(path);
    return files;
}

/// Every word of the repository's files that are no documents.
std::set<std::string> words_of_code() {
    std::set<std::string> words;
    for (const fs::path& path : files_with({})) {
        if (path.extension() == ".md") continue;
        words.insert(path.stem().string());
        if (*path.begin() == "tests")
            words.insert("test_" + path.parent_path().filename().string());
        const bool code = path.extension() == ".h" || path.extension() == ".cpp";
        std::istringstream lines(text_of(path));
        for (std::string line; std::getline(lines, line);) {
            if (code) line = line.substr(0, line.find("// "));
            std::string word;
            for (const char c : line + ' ') {
                if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
                    word += c;
                } else if (!word.empty()) {
                    words.insert(word);
                    word.clear();
                }
            }
        }
    }
    return words;
}

bool ends_a_path(const std::set<std::string>& known, const std::string& name) {
    return std::any_of(known.begin(), known.end(),
                       [&](const std::string& path) { return path.ends_with('/' + name); });
}

/// snake_case, CamelCase or a call: what can only be a name of the code.
bool is_name(const std::string& text) {
    static const std::regex name(R"([A-Za-z]\w*(::\w+)*(\(\))?)");
    static const std::regex camel(R"([A-Z][a-z]+[A-Z]\w*)");
    static const std::regex frames("(pose|p)_[A-Z][A-Z]");  // notation, any two frames
    return std::regex_match(text, name) && !std::regex_match(text, frames) &&
           (text.find('_') != std::string::npos || text.ends_with("()") ||
            std::regex_match(text, camel));
}

}  // namespace

TEST_CASE("every file that a comment or a document names is in the repository") {
    const std::regex path(
        R"(([A-Za-z0-9_.\-]+/)*[A-Za-z0-9_\-]+\.(h|cpp|md|toml|nc|cmake|py|sh|mjs))"
        R"((?![\w/]))");
    std::set<std::string> known;
    for (const fs::path& file : files_with({})) {
        known.insert(file.string());
        known.insert(file.filename().string());
    }
    // A reader's own files in examples; a stem in capitals stands for any name.
    const std::set<std::string> examples{"a.nc",
                                         "b.nc",
                                         "main.nc",
                                         "old.nc",
                                         "new.nc",
                                         "part.nc",
                                         "program.nc",
                                         "other.nc",
                                         "next.nc",
                                         "machine.toml",
                                         "setup.toml",
                                         "suite.toml",
                                         "identified.toml",
                                         "learned.toml",
                                         "my_machine.toml",
                                         "S2.toml",
                                         "O1234.nc",
                                         "1234.nc",
                                         "data/suite.toml",
                                         "machines/vmc.toml",
                                         "posts/impeller.nc",
                                         "map.toml"};
    const std::regex placeholder("([a-z]+/)*[A-Z]+\\.[a-z]+");
    for (const fs::path& file : written_for_readers()) {
        const std::string prose = prose_of(file);
        for (std::sregex_iterator it(prose.begin(), prose.end(), path), end; it != end; ++it) {
            std::string name = it->str();
            while (name.starts_with("./") || name.starts_with("../"))
                name = name.substr(name.find('/') + 1);
            INFO(file.string() << " names " << name);
            const bool found = known.contains(name) || examples.contains(name) ||
                               std::regex_match(name, placeholder) || ends_a_path(known, name) ||
                               known.contains((file.parent_path() / name).string()) ||
                               fs::exists(fs::path("/usr/include") / name);
            CHECK(found);
        }
    }
}

TEST_CASE("every name of the code that a comment or a document quotes is in the code") {
    const std::set<std::string> words = words_of_code();
    const std::regex quoted("`([^`\n]+)`");
    for (const fs::path& file : written_for_readers()) {
        if (file == "docs/effects.md") continue;  // its names are made from axes; another test
        const std::string prose = prose_of(file);
        for (std::sregex_iterator it(prose.begin(), prose.end(), quoted), end; it != end; ++it) {
            std::string name = (*it)[1];
            if (!is_name(name)) continue;
            // Made from an axis's name; a column of a reader's own file.
            if (name == "EX0J1_mm" || name == "X_cmd") continue;
            if (name.ends_with("()")) name.resize(name.size() - 2);
            if (const auto at = name.rfind("::"); at != std::string::npos)
                name = name.substr(at + 2);
            INFO(file.string() << " quotes " << (*it)[1]);
            CHECK(words.contains(name));
        }
    }
}
