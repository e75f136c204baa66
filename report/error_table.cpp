#include "report/error_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/units.h"
#include "report/diagnosis_words.h"
#include "report/page.h"
#include "report/svg.h"

namespace trunnion::report {
namespace {

using diagnosis::TablePoint;

/// Points error by error, in the order of the cause.
std::vector<std::vector<TablePoint>> by_error(const diagnosis::Cause& cause) {
    std::vector<std::vector<TablePoint>> list;
    for (const TablePoint& p : cause.points) {
        if (list.empty() || list.back().front().error != p.error) list.emplace_back();
        list.back().push_back(p);
    }
    return list;
}

double place_of(const TablePoint& p) {
    return p.at_unit == "rad" ? deg_from_rad(p.at) : p.at;
}

const char* place_unit(const TablePoint& p) {
    return p.at_unit == "rad" ? "deg" : "mm";
}

const char* small_unit(const TablePoint& p) {
    return p.unit == "rad" ? "µrad" : "µm";
}

double small_size(const TablePoint& p) {
    return p.unit == "rad" ? 1e6 : 1e3;
}

/// The sense of an error that counts against its axis.
std::string against_words(const TablePoint& p) {
    if (!p.against) return {};
    const bool turn = p.unit == "rad";
    const char direction = turn ? static_cast<char>(p.error[1] - 'A' + 'X') : p.error[1];
    return fmt::format(" ({} +{} of M: the axis counts the other way)", turn ? "about" : "along",
                       direction);
}

}  // namespace

std::optional<PitchErrorData> pitch_error_data(const diagnosis::Cause& cause, double unit) {
    const diagnosis::BeyondCommand& beyond = cause.beyond;
    // Nothing is typed into a control for what is not claimed: between the places a rival differs.
    if (!cause.holds_between || !is_claimed(cause) || beyond.at.size() < 2) return std::nullopt;
    const double first = beyond.at.front(),
                 interval = (beyond.at.back() - first) / static_cast<double>(beyond.at.size() - 1);
    const double of_one = beyond.rotary ? rad_from_deg(1.0) : 1.0;
    PitchErrorData data{beyond.rotary, first / of_one, interval / of_one, unit, {}};
    long sum = 0;
    for (std::size_t k = 1; k < beyond.at.size(); ++k) {
        const double at = first + interval * static_cast<double>(k);
        const double whole = -(beyond(at) - beyond.too_far.front()) / (unit * of_one);
        const long next = std::lround(whole);
        data.value.push_back(static_cast<int>(next - sum));
        sum = next;
    }
    return data;
}

std::string pitch_error_text(const diagnosis::Cause& cause) {
    if (cause.beyond.at.empty()) return "";
    if (!cause.holds_between)
        return "  no pitch error data: a control interpolates, and between its places the table\n"
               "  does not hold\n";
    if (!is_claimed(cause)) return "  no pitch error data: the cause is not claimed\n";
    const auto data = pitch_error_data(cause);
    if (!data) return "";
    return fmt::format(
        "  pitch error data{0}, from {1:.4f} {4} every {2:.4f} {4},\n"
        "  in {3:.4f} {4} (incremental; assumed):\n"
        "  {5}\n",
        cause.includes.empty() ? "" : " (" + cause.includes + " included)", data->first,
        data->interval, data->unit, data->rotary ? "deg" : "mm", fmt::join(data->value, " "));
}

std::string error_table(const diagnosis::Cause& cause) {
    std::string text;
    for (const std::vector<TablePoint>& curve : by_error(cause)) {
        text += fmt::format("  {}{}: at {}, error {}, sigma\n", curve.front().error,
                            against_words(curve.front()), place_unit(curve.front()),
                            small_unit(curve.front()));
        for (const TablePoint& p : curve) {
            const Rounded shown = rounded(small_size(p) * p.value, small_size(p) * p.sigma);
            text +=
                fmt::format("  {:>12.4f} {:>10} {:>8}\n", place_of(p), shown.value, shown.sigma);
        }
    }
    return text + pitch_error_text(cause);
}

std::string error_curves(const diagnosis::Cause& cause) {
    std::string text;
    for (const std::vector<TablePoint>& curve : by_error(cause)) {
        if (curve.size() < 2) continue;
        const double size = small_size(curve.front());
        double most = 0.0;
        for (const TablePoint& p : curve)
            most = std::max(most, size * (std::abs(p.value) + 2.0 * p.sigma));
        if (most == 0.0) continue;
        const PlotRange x = round_range(place_of(curve.front()), place_of(curve.back()), 6),
                        y = round_range(-most, most, 6);
        Svg svg(740.0, 260.0);
        svg.describe(fmt::format("{} over the place", curve.front().error),
                     "The curve of the error with two sigma of each place.");
        Plot plot(svg, {{64.0, 14.0}, 650.0, 190.0}, x, y);
        plot.frame("", fmt::format("place, {}", place_unit(curve.front())),
                   fmt::format("{}, {}", curve.front().error, small_unit(curve.front())));
        for (std::size_t k = 0; k < curve.size(); ++k) {
            const TablePoint& p = curve[k];
            const auto point = [&](double v) { return plot.at(place_of(p), size * v); };
            svg.line(point(p.value - 2.0 * p.sigma), point(p.value + 2.0 * p.sigma),
                     {"#9ecae9", 3.0, "none", ""});
            if (k > 0)
                svg.line(plot.at(place_of(curve[k - 1]), size * curve[k - 1].value), point(p.value),
                         {"#0072b2", 1.5, "none", ""});
        }
        text += figure_html(
            svg.str(),
            fmt::format("{}: what was found, with two sigma at each place", curve.front().error));
    }
    return text;
}

}  // namespace trunnion::report
