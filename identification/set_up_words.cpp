#include "identification/set_up_words.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/rounded.h"
#include "base/units.h"

namespace trunnion::identification {
namespace {

using Kind = SetUpQuantity::Kind;

/// Pose and scale of one instrument in one session, as far as they are observable.
struct Found {
    Vector3 shift_mm = Vector3::Zero(), tilt_rad = Vector3::Zero();
    std::array<bool, 7> seen{};
    double scale = 0.0;
    std::string session;
};

std::string words(const setup::Instrument& instrument, const Found& found) {
    std::string text = found.session.empty() ? "" : found.session + ": ";
    if (instrument.sees_table)
        text += "the part was";
    else
        text += instrument.name + " sees the machine";
    const bool turned = found.seen[3] || found.seen[4] || found.seen[5];
    const bool shifted = found.seen[0] || found.seen[1] || found.seen[2];
    if (turned)
        text += fmt::format(" turned by {} deg", decimal(deg_from_rad(found.tilt_rad.norm()), 5));
    if (shifted)
        text += fmt::format("{} shifted by ({}, {}, {}) mm", turned ? "," : "",
                            decimal(found.shift_mm.x(), 4), decimal(found.shift_mm.y(), 4),
                            decimal(found.shift_mm.z(), 4));
    if (found.seen[6])
        text += fmt::format("{} scaled by {} ppm", turned || shifted ? "," : "",
                            decimal(1e6 * found.scale, 2));
    return text;
}

}  // namespace

namespace {

/// The zero of an axis's encoder, where it is more than its uncertainty. Empty where it is not.
std::string encoder_words(const FitParameter& zero) {
    constexpr double sure_sigmas = 5.0;
    if (zero.set_up.kind != Kind::encoder || !std::isfinite(zero.sigma) ||
        std::abs(zero.value) < sure_sigmas * zero.sigma)
        return {};
    const std::string axis = zero.name.substr(0, zero.name.find('.'));
    const bool turns = zero.unit == "rad";
    return fmt::format("{}{} is read {} {} beside its commanded position in all rows",
                       zero.set_up.session_name.empty() ? "" : zero.set_up.session_name + ": ",
                       axis, three_digits(turns ? 1e6 * zero.value : 1e3 * zero.value),
                       turns ? "µrad" : "µm");
}

}  // namespace

std::vector<std::string> set_up_words(const setup::Setup& setup,
                                      const std::vector<FitParameter>& parameters) {
    std::map<std::pair<int, int>, Found> list;
    for (const FitParameter& p : parameters) {
        const SetUpQuantity& q = p.set_up;
        if (q.kind != Kind::instrument || !std::isfinite(p.sigma)) continue;
        Found& found = list[{q.session, q.index}];
        found.seen[static_cast<std::size_t>(q.component)] = true;
        found.session = q.session_name;
        if (q.component < 3) found.shift_mm(q.component) = p.value;
        if (q.component >= 3 && q.component < 6) found.tilt_rad(q.component - 3) = p.value;
        if (q.component == 6) found.scale = p.value;
    }
    std::vector<std::string> sentences;
    for (const auto& [place, found] : list)
        sentences.push_back(
            words(setup.instruments[static_cast<std::size_t>(place.second)], found));
    for (const FitParameter& p : parameters)
        if (std::string text = encoder_words(p); !text.empty())
            sentences.push_back(std::move(text));
    return sentences;
}

}  // namespace trunnion::identification
