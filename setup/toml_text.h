// Values as TOML text that reads back as the same value.
#pragma once

#include <string>

#include "base/numbers.h"

namespace trunnion::setup {

inline std::string toml_quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

inline std::string toml_number(double value) {
    return shortest(value);
}

template <class List, class Text>
std::string toml_list(const List& list, const Text& text) {
    std::string out = "[";
    for (const auto& item : list) out += (out.size() > 1 ? ", " : "") + text(item);
    return out + ']';
}

template <class List>
std::string toml_numbers(const List& list) {
    return toml_list(list, toml_number);
}

}  // namespace trunnion::setup
