#include "base/utf8_text.h"

#include <cstdint>

#include "base/alarm.h"

namespace trunnion::inline base {

namespace {

void append_utf8(std::uint32_t code, std::string& out) {
    const auto tail = [&](unsigned shift) {
        out += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
    };
    if (code < 0x80U) {
        out += static_cast<char>(code);
    } else if (code < 0x800U) {
        out += static_cast<char>(0xC0U | (code >> 6U));
        tail(0);
    } else {
        out += static_cast<char>(0xE0U | (code >> 12U));
        tail(6);
        tail(0);
    }
}

}  // namespace

bool is_utf16(std::string_view bytes) {
    return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

std::string utf8_of(const std::string& bytes, const std::string& path) {
    if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
    if (!is_utf16(bytes)) return bytes;
    const bool little = bytes.starts_with("\xFF\xFE");
    if (bytes.size() % 2 != 0)
        throw InputError("text in UTF-16 that ends within a character", {path, 1, 1});
    std::string out;
    for (std::size_t k = 2; k < bytes.size(); k += 2) {
        const auto first = static_cast<unsigned char>(bytes[k]);
        const auto second = static_cast<unsigned char>(bytes[k + 1]);
        append_utf8(little ? first + 256U * second : 256U * first + second, out);
    }
    return out;
}

}  // namespace trunnion::inline base
