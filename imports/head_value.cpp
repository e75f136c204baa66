#include "imports/head_value.h"

#include <algorithm>

#include "imports/units.h"
#include "records/table_line.h"

namespace trunnion::imports {
namespace {

bool digit_at(std::string_view text, std::size_t k) {
    return k < text.size() && text[k] >= '0' && text[k] <= '9';
}

}  // namespace

std::string head_value(std::string_view text, const std::string& cuts) {
    const std::string ends = cuts.substr(2) + '"', between = cuts + " \"";
    // Behind "Feed," a comma divides the values.
    const bool one_value = text.starts_with(':') || text.starts_with('=');
    text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
    std::size_t end = std::min(text.find_first_of(ends), text.size());
    while (one_value && end > 0 && end < text.size() && text[end] == ',' &&
           digit_at(text, end - 1) && digit_at(text, end + 1))
        end = std::min(text.find_first_of(ends, end + 1), text.size());
    const std::string value(records::without_blanks(text.substr(0, end)));
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
    const std::string_view next =
        records::without_blanks(text.substr(0, std::min(text.find_first_of(ends), text.size())));
    const bool has_unit = !value.empty() && digit_at(value, value.size() - 1) && !next.empty() &&
                          !digit_at(next, 0) && find_unit(next).has_value();
    return has_unit ? value + ' ' + std::string(next) : value;
}

}  // namespace trunnion::imports
