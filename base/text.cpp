#include "base/text.h"

#include <algorithm>

namespace trunnion::inline base {

namespace {

/// Length of the UTF-8 sequence that starts with `lead`; 0 when invalid.
std::size_t sequence_length(unsigned char lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead < 0xE0) return 2;
    if (lead >= 0xE0 && lead < 0xF0) return 3;
    return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// The second byte excludes overlong forms, surrogates and values beyond U+10FFFF.
bool second_byte_fits(unsigned char lead, unsigned char second) {
    if (lead == 0xE0) return second >= 0xA0;
    if (lead == 0xED) return second < 0xA0;
    if (lead == 0xF0) return second >= 0x90;
    return lead != 0xF4 || second < 0x90;
}

}  // namespace

std::string valid_utf8(std::string_view text) {
    std::string out;
    for (std::size_t k = 0; k < text.size();) {
        const auto lead = static_cast<unsigned char>(text[k]);
        const std::size_t length = sequence_length(lead);
        bool good = length > 0 && k + length <= text.size();
        for (std::size_t n = 1; good && n < length; ++n)
            good = (static_cast<unsigned char>(text[k + n]) & 0xC0) == 0x80;
        if (good && length > 1)
            good = second_byte_fits(lead, static_cast<unsigned char>(text[k + 1]));
        if (good)
            out += text.substr(k, length);
        else
            out += '?';
        k += good ? length : 1;
    }
    return out;
}

std::string printable(std::string_view text) {
    std::string out;
    const std::string valid = valid_utf8(text);
    for (std::size_t k = 0; k < valid.size(); ++k) {
        const auto byte = static_cast<unsigned char>(valid[k]);
        // U+0080 to U+009F are control characters of two bytes.
        const bool two = byte == 0xC2 && static_cast<unsigned char>(valid[k + 1]) < 0xA0;
        const bool control = two || (byte < 0x20 && byte != '\t') || byte == 0x7F;
        out += control ? '?' : valid[k];
        if (two) ++k;
    }
    return out;
}

std::size_t screen_width(std::string_view text) {
    const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts));
}

}  // namespace trunnion::inline base
