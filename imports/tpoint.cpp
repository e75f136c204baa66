#include "imports/tpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::imports {
namespace {

constexpr int most_head_lines = 200;
constexpr std::size_t numbers_a_line = 4;       ///< star and telescope, two angles each
constexpr std::size_t numbers_of_latitude = 3;  ///< degrees, minutes and seconds

bool is_comment(std::string_view line) {
    return line.empty() || line.front() == '!' || line.front() == '#';
}

std::string upper(std::string_view text) {
    std::string copy(text);
    for (char& c : copy) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return copy;
}

/// ": ALTAZ" gives "ALTAZ"; empty for another line.
std::string option_in(std::string_view line) {
    if (line.empty() || line.front() != ':') return {};
    return upper(records::without_blanks(line.substr(1)));
}

bool is_mount(const std::string& option) {
    return option == "ALTAZ" || option == "EQUAT";
}

std::vector<std::string_view> words_in(std::string_view line) {
    std::vector<std::string_view> words;
    while (!(line = records::without_blanks(line)).empty()) {
        const std::size_t end = std::min(line.find_first_of(" \t,"), line.size());
        if (end > 0) words.push_back(line.substr(0, end));
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return words;
}

/// The record before the first star, if it stands there: latitude, with or without the date and
/// the weather.
bool is_site(std::string_view line) {
    const std::size_t numbers = words_in(line.substr(0, line.find(';'))).size();
    return numbers == numbers_of_latitude || numbers > numbers_of_latitude + 2;
}

/// Names of the two axes that carry the line of sight.
std::pair<std::string, std::string> axes_of(const setup::Setup& setup, const std::string& path) {
    std::vector<std::string> names;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.tool)
        if (axis.rotary) names.push_back(axis.name);
    if (names.size() != 2)
        throw InputError(
            "a run in azimuth and altitude needs a setup with two rotary axes that "
            "carry the line of sight",
            {path, 1, 1});
    return {names[0], names[1]};
}

/// "star az, star alt, telescope az, telescope alt" in a line of the table.
std::string row_of(std::string_view line, const SourceRef& place) {
    const std::vector<std::string_view> words = words_in(line);
    std::string row;
    for (std::size_t k = 0; k < numbers_a_line; ++k) {
        if (k >= words.size() || !parse_number(words[k]))
            throw InputError(
                "four angles in degrees are needed here: those of the star and those "
                "of the telescope",
                place, std::string(line));
        row += (k == 0 ? "" : ";") + std::string(words[k]);
    }
    return row;
}

}  // namespace

bool is_tpoint(std::string_view text) {
    for (int k = 0; k < most_head_lines && !text.empty(); ++k)
        if (is_mount(option_in(records::without_blanks(records::take_line(text))))) return true;
    return false;
}

MadeTable tpoint_table(const ImportFile& file, const setup::Setup& setup) {
    const auto [first, second] = axes_of(setup, file.path);
    const std::string names =
        fmt::format("{0} act [deg];{1} act [deg];{0} cmd [deg];{1} cmd [deg]", first, second);
    MadeTable table;
    std::string_view text = file.text;
    bool options = false, begun = false;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = records::without_blanks(records::take_line(text));
        if (is_comment(line)) continue;
        if (const std::string option = option_in(line); !option.empty()) {
            if (option == "EQUAT")
                throw InputError(
                    "an equatorial run is not read in this form: give hour angle and "
                    "declination, commanded and actual, in columns",
                    {file.path, number, 1}, std::string(line));
            options = true;
            continue;
        }
        if (upper(line) == "END") break;
        if (!options) continue;  // the caption
        if (!begun) table.add(names, number);
        const bool about_the_site = !begun && is_site(line);
        begun = true;
        if (!about_the_site) table.add(row_of(line, {file.path, number, 1}), number);
    }
    return table;
}

}  // namespace trunnion::imports
