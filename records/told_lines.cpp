#include "records/told_lines.h"

#include <algorithm>
#include <cctype>

#include "base/numbers.h"
#include "base/units.h"
#include "records/table_line.h"

namespace trunnion::records {
namespace {

struct ToldWord {
    std::string_view word;
    void (*set)(ShopState&, double);
};

constexpr ToldWord told_list[] = {
    {"SPINDLE", [](ShopState& s, double v) { s.spindle_rad = rad_from_deg(v); }},
    {"TEMPERATURE", [](ShopState& s, double v) { s.temperature_c = v; }},
    {"LOAD", [](ShopState& s, double v) { s.load_kg = v; }},
    {"CLAMPED", [](ShopState& s, double v) { s.clamped = v != 0.0; }},
    {"EXTENSION", [](ShopState& s, double v) { s.extension_mm = v; }},
};

struct ShopColumn {
    const char* name;
    bool (*set)(const Reading&);
};

bool has_point(const Reading& row) {
    return row.point_W_mm.has_value();
}

constexpr ShopColumn shop_list[] = {
    {"px_mm", has_point},
    {"py_mm", has_point},
    {"pz_mm", has_point},
    {"spindle_deg", [](const Reading& r) { return r.spindle_rad != 0.0; }},
    {"temperature_c", [](const Reading& r) { return r.temperature_c != 20.0; }},
    {"load_kg", [](const Reading& r) { return r.load_kg != 0.0; }},
    {"clamped", [](const Reading& r) { return r.clamped; }},
    {"extension_mm", [](const Reading& r) { return r.extension_mm != 0.0; }},
    {"instrument", [](const Reading& r) { return !r.instrument.empty(); }},
};

}  // namespace

std::optional<std::string_view> told_words(std::string_view line, std::string_view word) {
    if (!line.starts_with(word) || line.size() <= word.size() || line[word.size()] != ' ')
        return std::nullopt;
    return without_blanks(line.substr(word.size()));
}

void take_told(std::string_view line, ShopState& shop) {
    for (const ToldWord& told : told_list)
        if (const auto words = told_words(line, told.word))
            if (const auto value = parse_number(*words)) told.set(shop, *value);
}

std::optional<PositioningMode> told_mode(std::string_view line) {
    static constexpr std::string_view words[] = {"DIRECT", "DPP", "RTDFO", "RTCP", "TW"};
    const auto told = told_words(line, "MODE");
    const auto* const it = std::find(std::begin(words), std::end(words), told.value_or(""));
    if (it == std::end(words)) return std::nullopt;
    return static_cast<PositioningMode>(it - std::begin(words));
}

void put_shop(const ShopState& shop, Reading& row) {
    row.spindle_rad = shop.spindle_rad;
    row.temperature_c = shop.temperature_c;
    row.load_kg = shop.load_kg;
    row.clamped = shop.clamped;
    row.extension_mm = shop.extension_mm;
}

std::string told_name(std::string_view words) {
    std::string name, word;
    for (std::size_t i = 0; i <= words.size(); ++i) {
        if (i < words.size() && words[i] != ' ') {
            word += words[i];
            continue;
        }
        if (word.size() > 1)
            for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (!word.empty()) name += (name.empty() ? "" : "_") + word;
        word.clear();
    }
    return name;
}

std::vector<std::string> shop_columns(const std::vector<Reading>& rows) {
    std::vector<std::string> names;
    for (const ShopColumn& column : shop_list)
        if (std::any_of(rows.begin(), rows.end(), column.set)) names.emplace_back(column.name);
    return names;
}

}  // namespace trunnion::records
