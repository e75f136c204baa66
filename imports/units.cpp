#include "imports/units.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <string>
#include <utility>

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
        } else if (name.substr(k, 3) == "\xE2\x80\xB2") {
            out += '\'';
            k += 2;
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

constexpr double deg_rad = pi / 180.0, minute_s = 60.0;

constexpr std::pair<const char*, Unit> unit_names[] = {
    {"mm", {Quantity::length, 1.0}},
    {"um", {Quantity::length, 1e-3}},
    {"micron", {Quantity::length, 1e-3}},
    {"microns", {Quantity::length, 1e-3}},
    {"nm", {Quantity::length, 1e-6}},
    {"cm", {Quantity::length, 10.0}},
    {"m", {Quantity::length, 1e3}},
    {"in", {Quantity::length, 25.4}},
    {"inch", {Quantity::length, 25.4}},
    {"inches", {Quantity::length, 25.4}},
    {"zoll", {Quantity::length, 25.4}},
    {"mil", {Quantity::length, 0.0254}},
    {"mils", {Quantity::length, 0.0254}},
    {"thou", {Quantity::length, 0.0254}},
    {"uin", {Quantity::length, 25.4e-6}},
    {"uinch", {Quantity::length, 25.4e-6}},
    {"uinches", {Quantity::length, 25.4e-6}},
    {"microin", {Quantity::length, 25.4e-6}},
    {"microinch", {Quantity::length, 25.4e-6}},
    {"microinches", {Quantity::length, 25.4e-6}},
    {"micrometer", {Quantity::length, 1e-3}},
    {"micrometers", {Quantity::length, 1e-3}},
    {"micrometre", {Quantity::length, 1e-3}},
    {"micrometres", {Quantity::length, 1e-3}},
    {"mikrometer", {Quantity::length, 1e-3}},
    {"millimeter", {Quantity::length, 1.0}},
    {"millimeters", {Quantity::length, 1.0}},
    {"millimetre", {Quantity::length, 1.0}},
    {"millimetres", {Quantity::length, 1.0}},
    {"deg", {Quantity::angle, deg_rad}},
    {"degree", {Quantity::angle, deg_rad}},
    {"degrees", {Quantity::angle, deg_rad}},
    {"grad", {Quantity::angle, deg_rad}},
    {"turn", {Quantity::angle, 360.0 * deg_rad}},
    {"rev", {Quantity::angle, 360.0 * deg_rad}},
    {"mdeg", {Quantity::angle, 1e-3 * deg_rad}},
    {"rad", {Quantity::angle, 1.0}},
    {"mrad", {Quantity::angle, 1e-3}},
    {"urad", {Quantity::angle, 1e-6}},
    {"um/m", {Quantity::angle, 1e-6}},  // of a level
    {"mm/m", {Quantity::angle, 1e-3}},
    {"arcsec", {Quantity::angle, deg_rad / 3600.0}},
    {"arcsecs", {Quantity::angle, deg_rad / 3600.0}},
    {"arcsecond", {Quantity::angle, deg_rad / 3600.0}},
    {"arcseconds", {Quantity::angle, deg_rad / 3600.0}},
    {"bogensekunde", {Quantity::angle, deg_rad / 3600.0}},
    {"bogensekunden", {Quantity::angle, deg_rad / 3600.0}},
    {"winkelsekunde", {Quantity::angle, deg_rad / 3600.0}},
    {"winkelsekunden", {Quantity::angle, deg_rad / 3600.0}},
    {"arc-sec", {Quantity::angle, deg_rad / 3600.0}},
    {"asec", {Quantity::angle, deg_rad / 3600.0}},
    {"\'\'", {Quantity::angle, deg_rad / 3600.0}},
    {"mas", {Quantity::angle, deg_rad / 3.6e6}},
    {"arcmin", {Quantity::angle, deg_rad / 60.0}},
    {"bogenminuten", {Quantity::angle, deg_rad / 60.0}},
    {"winkelminuten", {Quantity::angle, deg_rad / 60.0}},
    {"\'", {Quantity::angle, deg_rad / 60.0}},
    {"\"", {Quantity::angle, deg_rad / 3600.0}},
    {"s", {Quantity::time, 1.0}},
    {"sec", {Quantity::time, 1.0}},
    {"ms", {Quantity::time, 1e-3}},
    {"us", {Quantity::time, 1e-6}},
    {"ns", {Quantity::time, 1e-9}},
    {"min", {Quantity::time, minute_s}},
    {"h", {Quantity::time, 3600.0}},
    {"mm/s", {Quantity::speed, 1.0}},
    {"mm/min", {Quantity::speed, 1.0 / minute_s}},
    {"mm/sec", {Quantity::speed, 1.0}},
    {"mmpm", {Quantity::speed, 1.0 / minute_s}},
    {"m/min", {Quantity::speed, 1e3 / minute_s}},
    {"in/min", {Quantity::speed, 25.4 / minute_s}},
    {"inch/min", {Quantity::speed, 25.4 / minute_s}},
    {"inches/min", {Quantity::speed, 25.4 / minute_s}},
    {"ipm", {Quantity::speed, 25.4 / minute_s}},
    {"in/s", {Quantity::speed, 25.4}},
    {"ips", {Quantity::speed, 25.4}},
    {"m/s", {Quantity::speed, 1e3}},
    {"deg/s", {Quantity::turning, deg_rad}},
    {"rad/s", {Quantity::turning, 1.0}},
    {"deg/min", {Quantity::turning, deg_rad / minute_s}},
    {"mm/s2", {Quantity::per_s2, 1.0}},
    {"mm/s^2", {Quantity::per_s2, 1.0}},
    {"m/s2", {Quantity::per_s2, 1e3}},
    {"m/s^2", {Quantity::per_s2, 1e3}},
    {"degc", {Quantity::temperature, 1.0}},
    {"c", {Quantity::temperature, 1.0}},
};

const std::map<std::string, Unit, std::less<>>& units() {
    static const std::map<std::string, Unit, std::less<>> table(std::begin(unit_names),
                                                                std::end(unit_names));
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
