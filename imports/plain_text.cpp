#include "imports/plain_text.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace trunnion::imports {
namespace {

using Byte = unsigned char;

constexpr std::pair<std::string_view, char> plain_signs[] = {
    {"\xE2\x88\x92", '-'},  // minus sign
    {"\xE2\x80\x90", '-'},  // hyphens and dashes
    {"\xE2\x80\x91", '-'}, {"\xE2\x80\x92", '-'}, {"\xE2\x80\x93", '-'},
    {"\xE2\x80\x94", '-'}, {"\xEF\xBC\x8D", '-'},                     // full width
    {"\xEF\xBC\x8B", '+'}, {"\xEF\xB9\xA3", '-'}, {"\xC2\xA0", ' '},  // blanks that do not break
    {"\xE2\x80\xAF", ' '}, {"\xE2\x80\x89", ' '},
};

bool plain(char c) {
    return static_cast<Byte>(c) < 0x80;
}

/// Bytes of the character that begins here; 0 where none does.
std::size_t length_of(std::string_view text) {
    const auto first = static_cast<Byte>(text.front());
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((static_cast<Byte>(text[k]) & 0xC0) != 0x80) return 0;
    return length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = length_of(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

/// Windows-1252 is Latin-1 but for 0x80 to 0x9F: of these a number may hold the dashes.
std::string from_windows_1252(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<Byte>(c);
        if (byte == 0x96 || byte == 0x97) {
            out += '-';
        } else if (plain(c)) {
            out += c;
        } else {
            out += static_cast<char>(0xC0 | (byte >> 6));
            out += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return out;
}

}  // namespace

std::string plain_text(std::string text) {
    if (std::all_of(text.begin(), text.end(), plain)) return text;
    if (!is_utf8(text)) text = from_windows_1252(text);
    std::string out;
    out.reserve(text.size());
    for (std::size_t k = 0; k < text.size();) {
        const std::string_view left = std::string_view(text).substr(k);
        const auto* const sign =
            std::find_if(std::begin(plain_signs), std::end(plain_signs),
                         [&](const auto& pair) { return left.starts_with(pair.first); });
        const bool known = !plain(text[k]) && sign != std::end(plain_signs);
        out += known ? sign->second : text[k];
        k += known ? sign->first.size() : 1;
    }
    return out;
}

}  // namespace trunnion::imports
