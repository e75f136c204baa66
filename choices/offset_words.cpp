#include "choices/offset_words.h"

#include <cctype>
#include <charconv>

namespace trunnion::choices {

std::set<int> offset_words(const std::vector<interpreter::ProgramText>& texts) {
    std::set<int> out;
    for (const interpreter::ProgramText& program : texts) {
        const std::string_view text = program.text;
        bool comment = false;
        for (std::size_t k = 0; k + 1 < text.size(); ++k) {
            if (text[k] == '(') comment = true;
            if (text[k] == ')' || text[k] == '\n') comment = false;
            const int letter = std::toupper(static_cast<unsigned char>(text[k]));
            if (comment || (letter != 'H' && letter != 'D' && letter != 'T')) continue;
            // A name (LENGTH) is no word.
            if (k > 0 && std::isalpha(static_cast<unsigned char>(text[k - 1]))) continue;
            int number = 0;
            const char* from = text.data() + k + 1;
            if (std::from_chars(from, text.data() + text.size(), number).ec == std::errc() &&
                number > 0)
                out.insert(number);
        }
    }
    return out;
}

}  // namespace trunnion::choices
