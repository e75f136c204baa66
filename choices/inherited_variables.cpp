#include "choices/inherited_variables.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace trunnion::choices {

namespace {

bool is_common(int number) {
    return (number >= 100 && number <= 199) || (number >= 500 && number <= 999);
}

/// The common variables of one line.
struct Mentions {
    std::set<int> read, stored;
};

/// `text` begins behind a variable's number: an equals sign stores in it. Comparisons are words.
bool is_stored(std::string_view text) {
    const std::size_t next = text.find_first_not_of(" \t");
    return next != std::string_view::npos && text[next] == '=';
}

Mentions mentions_of(std::string_view line) {
    Mentions out;
    bool comment = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '(') comment = true;
        if (line[k] == ')') comment = false;
        if (comment || line[k] != '#') continue;
        int number = 0;
        const char *from = line.data() + k + 1, *last = line.data() + line.size();
        const auto [end, fault] = std::from_chars(from, last, number);
        if (fault != std::errc() || !is_common(number)) continue;
        const bool stores = is_stored(line.substr(static_cast<std::size_t>(end - line.data())));
        (stores ? out.stored : out.read).insert(number);
    }
    return out;
}

}  // namespace

std::set<int> inherited_variables(const std::vector<interpreter::ProgramText>& texts) {
    std::set<int> out, stored;
    for (const interpreter::ProgramText& program : texts) {
        std::string_view text = program.text;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            const Mentions own = mentions_of(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
            // The value is computed before it is stored: #500=#500+1 takes the old one.
            for (const int number : own.read)
                if (!stored.contains(number) && out.size() < most_inherited) out.insert(number);
            stored.insert(own.stored.begin(), own.stored.end());
        }
    }
    return out;
}

}  // namespace trunnion::choices
