#include "base/toml_reader.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "base/utf8_text.h"

namespace trunnion::inline base {
namespace {

TomlValue convert(const toml::node& node);

TomlValue convert_table(const toml::table& table) {
    TomlValue value;
    for (const auto& [key, child] : table)
        value.entries.push_back({std::string(key.str()), convert(child)});
    std::stable_sort(value.entries.begin(), value.entries.end(), [](const auto& a, const auto& b) {
        return std::pair(a.value.line, a.value.column) < std::pair(b.value.line, b.value.column);
    });
    return value;
}

TomlValue convert_content(const toml::node& node) {
    if (const auto* table = node.as_table()) return convert_table(*table);
    TomlValue value;
    if (const auto* array = node.as_array()) {
        value.kind = TomlValue::Kind::array;
        for (const toml::node& item : *array) value.items.push_back(convert(item));
    } else if (node.is_number()) {
        value.kind = TomlValue::Kind::number;
        value.number = *node.value<double>();
    } else if (node.is_boolean()) {
        value.kind = TomlValue::Kind::boolean;
        value.truth = *node.value<bool>();
    } else {
        value.kind = TomlValue::Kind::text;
        value.text = node.value<std::string>().value_or("");
    }
    return value;
}

TomlValue convert(const toml::node& node) {
    TomlValue value = convert_content(node);
    value.line = static_cast<int>(node.source().begin.line);
    value.column = static_cast<int>(node.source().begin.column);
    return value;
}

void list_unused(const TomlValue& value, const std::string& name, const std::string& path,
                 std::vector<std::string>& notes) {
    for (const auto& [key, child] : value.entries) {
        const std::string full = name.empty() ? key : name + '.' + key;
        if (!child.used)
            notes.push_back(path + ':' + std::to_string(child.line) + ':' +
                            std::to_string(child.column) + ": key '" + full +
                            "' is not known and ignored");
        else
            list_unused(child, full, path, notes);
    }
    for (const TomlValue& item : value.items) list_unused(item, name, path, notes);
}

/// The first key that was not used, with its full name; nullptr if none.
const TomlValue* first_unused(const TomlValue& value, std::string& name) {
    for (const auto& [key, child] : value.entries) {
        const std::string full = name.empty() ? key : name + '.' + key;
        std::string inner = full;
        const TomlValue* unused = child.used ? first_unused(child, inner) : &child;
        if (!unused) continue;
        name = inner;
        return unused;
    }
    for (const TomlValue& item : value.items)
        if (const TomlValue* unused = first_unused(item, name)) return unused;
    return nullptr;
}

/// Line of the first key with too many parts; 0: none. The parser recurses for each part and would
/// overflow the stack.
int line_of_deep_key(std::string_view text) {
    constexpr std::ptrdiff_t most_dots = 64;
    int line = 1;
    for (; !text.empty(); ++line) {
        const std::string_view whole = text.substr(0, text.find('\n'));
        const std::string_view key = whole.substr(0, whole.find('='));
        if (std::count(key.begin(), key.end(), '.') > most_dots) return line;
        text.remove_prefix(std::min(whole.size() + 1, text.size()));
    }
    return 0;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
    for (const auto& [name, value] : entries)
        if (name == key) {
            value.used = true;
            return &value;
        }
    return nullptr;
}

TomlFile::TomlFile(std::string text, std::string path)
    : text_(is_utf16(text) ? utf8_of(text, path) : std::move(text)), path_(std::move(path)) {
    if (const int line = line_of_deep_key(text_); line > 0)
        throw InputError("a key has more than 64 parts", {path_, line, 1}, line_text(line));
    try {
        root_ = convert(toml::parse(text_, path_));
        root_.line = root_.column = 1;
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        throw InputError(std::string(error.description()),
                         {path_, static_cast<int>(at.line), static_cast<int>(at.column)},
                         line_text(static_cast<int>(at.line)));
    }
}

std::string TomlFile::line_text(int line) const {
    std::size_t start = 0;
    for (int i = 1; i < line && start < text_.size(); ++i)
        start = std::min(text_.find('\n', start), text_.size() - 1) + 1;
    std::size_t end = std::min(text_.find('\n', start), text_.size());
    if (end > start && text_[end - 1] == '\r') --end;
    return text_.substr(start, end - start);
}

void TomlFile::fail(const TomlValue& at, const std::string& message) const {
    throw InputError(message, place(at), line_text(at.line));
}

Finite TomlFile::number(const TomlValue& value) const {
    if (value.kind != TomlValue::Kind::number || !std::isfinite(value.number))
        fail(value, "a finite number is expected here");
    constexpr double largest = 1e12;  // in any unit; larger values overflow in squares and products
    if (std::abs(value.number) > largest) fail(value, "a number of at most 1e12 is expected here");
    return value.number;
}

Finite TomlFile::positive(const TomlValue& value) const {
    if (number(value) <= 0.0) fail(value, "a number above zero is expected here");
    return value.number;
}

const std::string& TomlFile::text(const TomlValue& value) const {
    if (value.kind != TomlValue::Kind::text) fail(value, "a text in quotes is expected here");
    return value.text;
}

Eigen::Vector3d TomlFile::vector3(const TomlValue& value) const {
    const std::vector<double> v = numbers(value);
    if (v.size() != 3) fail(value, "three numbers [x, y, z] are expected here");
    return {v[0], v[1], v[2]};
}

std::vector<double> TomlFile::numbers(const TomlValue& value) const {
    if (value.kind != TomlValue::Kind::array) return {number(value)};
    std::vector<double> list;
    for (const TomlValue& item : value.items) list.push_back(number(item));
    return list;
}

std::vector<std::string> TomlFile::texts(const TomlValue& value) const {
    if (value.kind != TomlValue::Kind::array) return {text(value)};
    std::vector<std::string> list;
    for (const TomlValue& item : value.items) list.push_back(text(item));
    return list;
}

const TomlValue& TomlFile::table(const TomlValue& value) const {
    if (value.kind != TomlValue::Kind::table) fail(value, "a table is expected here");
    return value;
}

std::optional<Finite> TomlFile::find_number(const TomlValue& parent, std::string_view key) const {
    const TomlValue* value = parent.find(key);
    return value ? std::optional(number(*value)) : std::nullopt;
}

std::vector<std::string> TomlFile::unknown_keys() const {
    std::vector<std::string> notes;
    list_unused(root_, "", path_, notes);
    return notes;
}

void TomlFile::refuse_unknown_keys() const {
    std::string name;
    if (const TomlValue* unused = first_unused(root_, name))
        fail(*unused, "key '" + name + "' is not known");
}

}  // namespace trunnion::inline base
