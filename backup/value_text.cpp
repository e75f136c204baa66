#include "backup/value_text.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "backup/parameter_names.h"
#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"

namespace trunnion::backup {

namespace {

/// The fewest decimals that give `number` back; no control reads an exponent.
std::string decimal_text(double number, bool inch) {
    const double in_file = inch ? inch_from_mm(number) : number;
    std::string text;
    for (int decimals = 0; decimals <= 340; ++decimals) {
        text = fmt::format("{:.{}f}", in_file, decimals);
        const double read = *parse_number(text);
        if (inch ? std::abs(mm_from_inch(read) - number) <= 1e-15 * std::abs(number)
                 : read == number)
            break;
    }
    return text;
}

bool is_bits(const std::string& text) {
    return text.size() == 8 && text.find_first_not_of("01") == std::string::npos;
}
bool is_hex_double(const BackupValue& v) {
    return v.kind == BackupValue::Kind::variable && v.text.size() == 16 && is_hex(v.text);
}

/// The offset vector of a BackupValue's number; const if the stores are.
template <class S>
auto work_offset(S& stores, int number) -> decltype(&stores.work.external) {
    if (number == 0) return &stores.work.external;
    if (number >= 1 && number <= 6)
        return &stores.work.standard[static_cast<std::size_t>(number - 1)];
    if (number > 100 && number <= 400)
        return &stores.work.additional[static_cast<std::size_t>(number - 101)];
    return nullptr;
}

bool has_tool(const offsets::Stores& stores, int number) {
    return number > 0 && static_cast<std::size_t>(number) < stores.tools.tool.size();
}

double offsets::ToolOffset::*tool_field(int l) {
    switch (l) {
        case 10: return &offsets::ToolOffset::length_geometry_mm;
        case 11: return &offsets::ToolOffset::length_wear_mm;
        case 12: return &offsets::ToolOffset::radius_geometry_mm;
        default: return &offsets::ToolOffset::radius_wear_mm;
    }
}

}  // namespace

bool is_hex(std::string_view text) {
    return text.find_first_not_of("0123456789ABCDEFabcdef") == std::string_view::npos;
}

double number_from_hex(std::string_view digits) {
    std::uint64_t bits = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
    return std::bit_cast<double>(bits);
}

double stored_value(const BackupValue& v) {
    if (is_hex_double(v)) {
        const double number = number_from_hex(v.text);
        // All F is taken as vacant (assumed; docs/backup_files.md), and so is any other NaN.
        return std::isnan(number) ? std::numeric_limits<double>::quiet_NaN() : number;
    }
    if (v.text == vacant_text) return std::numeric_limits<double>::quiet_NaN();
    if (v.kind == BackupValue::Kind::parameter && is_bits(v.text)) {
        unsigned byte = 0;
        std::from_chars(v.text.data(), v.text.data() + 8, byte, 2);
        return byte;
    }
    const char* begin = v.text.data() + (v.text[0] == '+' ? 1 : 0);
    double number = 0.0;
    std::from_chars(begin, v.text.data() + v.text.size(), number);
    return v.inch ? mm_from_inch(number) : number;
}

void store_value(const BackupValue& v, offsets::Stores& stores) {
    const double number = stored_value(v);
    switch (v.kind) {
        case BackupValue::Kind::parameter: {
            if (v.sub >= other_path) break;
            offsets::Parameter& p = stores.parameters.entry[v.number];
            if (v.sub == 0)
                p.value = number;
            else
                p.by_axis[v.sub] = number;
            if (v.sub == 1) p.value = number;
            break;
        }
        case BackupValue::Kind::work_offset:
            if (offsets::OffsetVector* offset = work_offset(stores, v.number))
                (*offset)[*axis_of(static_cast<char>(v.sub))] = number;
            break;
        case BackupValue::Kind::tool_offset:
            if (has_tool(stores, v.number))
                stores.tools.tool[static_cast<std::size_t>(v.number)].*tool_field(v.sub) = number;
            break;
        case BackupValue::Kind::variable:
            if (std::isnan(number))
                stores.variables.erase(v.number);
            else
                stores.variables[v.number] = number;
            break;
    }
}

double value_in(const BackupValue& v, const offsets::Stores& stores) {
    switch (v.kind) {
        case BackupValue::Kind::parameter: {
            const auto entry = stores.parameters.entry.find(v.number);
            if (entry == stores.parameters.entry.end() || v.sub >= other_path)
                return stored_value(v);
            if (v.sub == 0) return entry->second.value;
            const auto by_axis = entry->second.by_axis.find(v.sub);
            return by_axis == entry->second.by_axis.end() ? stored_value(v) : by_axis->second;
        }
        case BackupValue::Kind::work_offset: {
            const offsets::OffsetVector* offset = work_offset(stores, v.number);
            return offset ? (*offset)[*axis_of(static_cast<char>(v.sub))] : stored_value(v);
        }
        case BackupValue::Kind::tool_offset:
            if (!has_tool(stores, v.number)) return stored_value(v);
            return stores.tools.tool[static_cast<std::size_t>(v.number)].*tool_field(v.sub);
        case BackupValue::Kind::variable: {
            const auto it = stores.variables.find(v.number);
            return it == stores.variables.end() ? std::numeric_limits<double>::quiet_NaN()
                                                : it->second;
        }
    }
    return 0.0;
}

Standing standing_of_value(const BackupValue& v) {
    if (v.kind == BackupValue::Kind::parameter) {
        const Standing first = standing_of_parameter(v.number);
        return v.sub >= other_path && first == Standing::obeyed ? Standing::known : first;
    }
    if (v.kind == BackupValue::Kind::variable) return Standing::obeyed;
    static const offsets::Stores stores;
    const bool stored = v.kind == BackupValue::Kind::work_offset
                            ? work_offset(stores, v.number) != nullptr
                            : has_tool(stores, v.number);
    return stored ? Standing::obeyed : Standing::ignored;
}

bool same_value(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

std::string format_value(const BackupValue& like, double number) {
    if (is_hex_double(like))
        return std::isnan(number) ? std::string(16, 'F')
                                  : fmt::format("{:016X}", std::bit_cast<std::uint64_t>(number));
    if (std::isnan(number)) {
        if (like.assigned) return std::string(vacant_text);
        throw InputError(like.name + " is vacant now, and G10 with R has no text for that",
                         {like.file, like.line, 1});
    }
    const bool byte = number >= 0.0 && number <= 255.0 && number == std::floor(number);
    if (byte && like.kind == BackupValue::Kind::parameter && is_bits(like.text))
        return fmt::format("{:08b}", static_cast<unsigned>(number));
    std::string text = decimal_text(number, like.inch);
    const std::size_t point = like.text.find('.');
    if (point == std::string::npos && like.kind == BackupValue::Kind::parameter) return text;
    if (text.find('.') == std::string::npos) text += '.';
    if (point == std::string::npos) return text;
    const std::size_t decimals = like.text.size() - point - 1;
    const std::size_t written = text.size() - text.find('.') - 1;
    if (written < decimals) text.append(decimals - written, '0');
    return text;
}

}  // namespace trunnion::backup
