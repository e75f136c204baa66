#include "report/shop_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounded.h"

namespace trunnion::report {
namespace {

struct ShopUnit {
    const char *from, *to;
    double factor, below;  ///< factor for values below this limit
};

constexpr ShopUnit shop_units[] = {
    {"mm", "µm", 1e3, 1.0}, {"rad", "µrad", 1e6, 0.01}, {"s", "ms", 1e3, 0.1}};

/// "gap_rad" in rad becomes "gap"; vector components get their letter.
std::string plain_name(const identification::FitParameter& p) {
    std::string name = p.name;
    const std::string end = '_' + p.unit;
    // "cup.x_mm" and, of one session, "CMM.x_mm.monday"
    const std::size_t at = name.rfind(end);
    if (at != std::string::npos && at > 0 &&
        (at + end.size() == name.size() || name[at + end.size()] == '.'))
        name.erase(at, end.size());
    std::replace(name.begin(), name.end(), '_', ' ');
    return p.component < 0 ? name : fmt::format("{} {}", name, "xyz"[p.component]);
}

/// The other part of a wave: `sin4_rad` of `cos4_rad`.
const identification::FitParameter* other_part(const diagnosis::Cause& cause,
                                               const identification::FitParameter& part) {
    for (const auto& [one, other] : {std::pair("cos", "sin"), std::pair("sin", "cos")}) {
        if (!part.name.starts_with(one)) continue;
        for (const identification::FitParameter& p : cause.parameters)
            if (p.effect == part.effect && p.name == other + part.name.substr(3)) return &p;
    }
    return nullptr;
}

/// The size of a wave of two parts, with the larger of their uncertainties.
identification::FitParameter amplitude_of(identification::FitParameter part,
                                          const identification::FitParameter& other) {
    part.name.replace(0, 3, "amplitude");
    part.value = std::hypot(part.value, other.value);
    part.sigma = std::max(part.sigma, other.sigma);
    return part;
}

}  // namespace

ShopValue shop_value(const identification::FitParameter& p) {
    ShopValue v{plain_name(p), "", "–", p.unit == "1" ? "" : p.unit};
    double factor = 1.0;
    for (const ShopUnit& unit : shop_units)
        if (p.unit == unit.from && std::abs(p.value) < unit.below &&
            (std::isfinite(p.sigma) || p.value == 0.0 || p.unit != "s")) {
            factor = unit.factor;
            v.unit = unit.to;
        }
    const double value = factor * p.value, sigma = factor * p.sigma;
    const Rounded text = rounded(value, sigma);
    v.value = text.value;
    v.sigma = text.sigma;
    return v;
}

std::string main_size(const diagnosis::Cause& cause) {
    const identification::FitParameter* most = nullptr;
    const auto strength = [](const identification::FitParameter& p) {
        return std::isfinite(p.sigma) && p.sigma > 0.0 ? std::abs(p.value) / p.sigma : 0.0;
    };
    for (const identification::FitParameter& p : cause.parameters)
        if (!most || strength(p) > strength(*most)) most = &p;
    if (!most) return "–";
    const identification::FitParameter* other = other_part(cause, *most);
    const ShopValue v = shop_value(other ? amplitude_of(*most, *other) : *most);
    return fmt::format("{} {} ± {} {}", v.name, v.value, v.sigma, v.unit);
}

}  // namespace trunnion::report
