#include "pivot/affected_programs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace trunnion::pivot {

namespace {

/// Letters and numbers of a program without comments; a number keeps its decimal point.
struct Word {
    char letter = 0;
    std::string number;
};

std::vector<Word> words_of(std::string_view text) {
    std::vector<Word> words;
    bool comment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
        if (comment || c == '(') {
            comment = c != ')' && c != '\n';
            continue;
        }
        if (c < 'A' || c > 'Z') continue;
        Word word{c, {}};
        for (std::size_t k = i + 1; k < text.size() && word.number.size() < 12; ++k) {
            const char d = text[k];
            if (d == ' ') continue;
            if ((d < '0' || d > '9') && d != '.') break;
            word.number += d;
        }
        const bool inside_a_name =
            i > 0 && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0;
        if (!inside_a_name) words.push_back(std::move(word));
    }
    return words;
}

/// True when a rotary word with this letter occurs: followed by a number, a variable or an
/// expression.
bool turns(std::string_view text, char letter) {
    for (std::size_t at = text.find(letter); at != std::string_view::npos;
         at = text.find(letter, at + 1)) {
        const bool name = at > 0 && std::isalpha(static_cast<unsigned char>(text[at - 1])) != 0;
        const char next = at + 1 < text.size() ? text[at + 1] : ' ';
        if (!name && std::string_view("0123456789.-+#[").find(next) != std::string_view::npos)
            return true;
    }
    return false;
}

std::string without_comments(std::string_view text) {
    std::string out;
    bool comment = false;
    for (const char c : text) {
        if (c == '(') comment = true;
        if (!comment) out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        if (c == ')' || c == '\n') comment = false;
    }
    return out;
}

const std::vector<std::pair<std::string, std::string>>& code_table() {
    static const std::vector<std::pair<std::string, std::string>> table{
        {"G43.4", "RTCP"}, {"G43.5", "RTCP"}, {"M128", "RTCP"}, {"G54.2", "RTDFO"}, {"G68.2", "TW"},
        {"G68.3", "TW"},   {"G68.4", "TW"},   {"G53.1", "TW"},  {"G53.6", "TW"}};
    return table;
}

}  // namespace

std::vector<std::string> functions_used(std::string_view program, Axis first, Axis second) {
    std::set<std::string> used;
    for (const Word& word : words_of(program))
        for (const auto& [code, function] : code_table())
            if (code[0] == word.letter && code.substr(1) == word.number) used.insert(function);
    const std::string plain = without_comments(program);
    if (used.empty() && (turns(plain, letter_of(first)) || turns(plain, letter_of(second))))
        used.insert("DPP");
    return {used.begin(), used.end()};
}

std::string codes_of(const std::string& function, bool hurco) {
    if (function == "RTCP") return hurco ? "M128" : "G43.4, G43.5";
    if (function == "TW") return "G68.2 with G53.1";
    if (function == "RTDFO") return "G54.2";
    return "points turned by the post, about G54";
}

std::vector<AffectedPart> affected_parts(
    const PivotVerdict& verdict, const std::vector<PivotFunction>& functions,
    const std::vector<std::pair<std::string, std::vector<std::string>>>& programs) {
    std::vector<AffectedPart> parts;
    const auto add = [&](const std::string& path, const PivotFunction& function) {
        const GroupVerdict* group = verdict.find(function.group);
        if (!group) return;
        parts.push_back({path, function.name, function.group, group->visible_um, group->stale});
    };
    for (const PivotFunction& function : functions) add({}, function);
    for (const auto& [path, used] : programs)
        for (const std::string& name : used)
            if (const PivotFunction* function = find_pivot_function(name)) add(path, *function);
    return parts;
}

}  // namespace trunnion::pivot
