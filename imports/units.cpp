#include "imports/units.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

#include "base/numbers.h"
#include "base/units.h"

namespace trunnion::imports {
namespace {

/// Lower case, without blanks; both micro signs (U+00B5, U+03BC) and that of Latin-1 become u.
std::string plain(std::string_view name) {
    std::string out;
    for (std::size_t k = 0; k < name.size(); ++k) {
        const std::string_view two = name.substr(k, 2);
        if (two == "\xC2\xB5" || two == "\xCE\xBC") {
            out += 'u';
            ++k;
        } else if (two == "\xC2\xB0") {
            out += "deg";
            ++k;
        } else if (two == "\xC2\xB2" || name[k] == '\xB2') {
            out += '2';
            k += two == "\xC2\xB2";
        } else if (name.substr(k, 3) == "\xE2\x80\xB3") {
            out += '"';
            k += 2;
        } else if (name[k] == '\xB5') {
            out += 'u';
        } else if (name[k] == '\xB0') {
            out += "deg";
        } else if (name[k] != ' ') {
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(name[k])));
        }
    }
    return out;
}

const std::map<std::string, Unit, std::less<>>& units() {
    using Q = Quantity;
    constexpr double deg = pi / 180.0, minute = 60.0;
    static const std::map<std::string, Unit, std::less<>> table{
        {"mm", {Q::length, 1.0}},
        {"um", {Q::length, 1e-3}},
        {"micron", {Q::length, 1e-3}},
        {"microns", {Q::length, 1e-3}},
        {"nm", {Q::length, 1e-6}},
        {"cm", {Q::length, 10.0}},
        {"m", {Q::length, 1e3}},
        {"in", {Q::length, 25.4}},
        {"inch", {Q::length, 25.4}},
        {"mil", {Q::length, 0.0254}},
        {"deg", {Q::angle, deg}},
        {"degree", {Q::angle, deg}},
        {"degrees", {Q::angle, deg}},
        {"grad", {Q::angle, deg}},
        {"turn", {Q::angle, 360.0 * deg}},
        {"rev", {Q::angle, 360.0 * deg}},
        {"mdeg", {Q::angle, 1e-3 * deg}},
        {"rad", {Q::angle, 1.0}},
        {"mrad", {Q::angle, 1e-3}},
        {"urad", {Q::angle, 1e-6}},
        {"arcsec", {Q::angle, deg / 3600.0}},
        {"arcseconds", {Q::angle, deg / 3600.0}},
        {"arc-sec", {Q::angle, deg / 3600.0}},
        {"asec", {Q::angle, deg / 3600.0}},
        {"\'\'", {Q::angle, deg / 3600.0}},
        {"mas", {Q::angle, deg / 3.6e6}},
        {"arcmin", {Q::angle, deg / 60.0}},
        {"\"", {Q::angle, deg / 3600.0}},
        {"s", {Q::time, 1.0}},
        {"sec", {Q::time, 1.0}},
        {"ms", {Q::time, 1e-3}},
        {"us", {Q::time, 1e-6}},
        {"ns", {Q::time, 1e-9}},
        {"min", {Q::time, minute}},
        {"h", {Q::time, 3600.0}},
        {"mm/s", {Q::speed, 1.0}},
        {"mm/min", {Q::speed, 1.0 / minute}},
        {"m/min", {Q::speed, 1e3 / minute}},
        {"m/s", {Q::speed, 1e3}},
        {"deg/s", {Q::turning, deg}},
        {"rad/s", {Q::turning, 1.0}},
        {"deg/min", {Q::turning, deg / minute}},
        {"mm/s2", {Q::per_s2, 1.0}},
        {"mm/s^2", {Q::per_s2, 1.0}},
        {"m/s2", {Q::per_s2, 1e3}},
        {"m/s^2", {Q::per_s2, 1e3}},
        {"degc", {Q::temperature, 1.0}},
        {"c", {Q::temperature, 1.0}},
    };
    return table;
}

}  // namespace

std::optional<Unit> find_unit(std::string_view name) {
    const std::string word = plain(name);
    if (const auto it = units().find(word); it != units().end()) return it->second;
    const std::size_t digits = std::min(word.find_first_not_of("0123456789.,"), word.size());
    std::string count = word.substr(0, digits);
    std::replace(count.begin(), count.end(), ',', '.');
    const auto times = parse_number(count);
    const auto it = units().find(word.substr(digits));
    if (!times || *times <= 0.0 || it == units().end()) return std::nullopt;
    return Unit{it->second.quantity, *times * it->second.factor};
}

std::optional<Unit> find_unit_of_angle(std::string_view name) {
    constexpr double hour_rad = pi / 12.0;
    return plain(name) == "h" ? Unit{Quantity::angle, hour_rad} : find_unit(name);
}

}  // namespace trunnion::imports
