#include "report/error_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/units.h"
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

/// Linear interpolation between two points; beyond the curve the nearest end.
double too_far_at(const std::vector<TablePoint>& curve, double at) {
    const auto after =
        std::find_if(curve.begin(), curve.end(), [&](const TablePoint& p) { return p.at >= at; });
    if (after == curve.begin()) return *curve.front().too_far_mm;
    if (after == curve.end()) return *curve.back().too_far_mm;
    const TablePoint& before = *std::prev(after);
    const double part = (at - before.at) / (after->at - before.at);
    return *before.too_far_mm + part * (*after->too_far_mm - *before.too_far_mm);
}

/// The sense of an error that counts against its axis.
std::string against_words(const TablePoint& p) {
    if (!p.against) return {};
    const bool turn = p.unit == "rad";
    const char direction = turn ? static_cast<char>(p.error[1] - 'A' + 'X') : p.error[1];
    return fmt::format(" ({} +{} of M: the axis counts the other way)", turn ? "about" : "along",
                       direction);
}

/// A positioning error of a linear axis.
bool has_pitch(const std::vector<TablePoint>& curve) {
    return curve.front().too_far_mm && curve.size() > 1;
}

}  // namespace

std::optional<PitchErrorData> pitch_error_data(const diagnosis::Cause& cause, double unit_mm) {
    if (!cause.holds_between) return std::nullopt;
    for (const std::vector<TablePoint>& curve : by_error(cause)) {
        if (!has_pitch(curve)) continue;
        const double range = curve.back().at - curve.front().at;
        PitchErrorData data{
            curve.front().at, range / static_cast<double>(curve.size() - 1), unit_mm, {}};
        long sum = 0;
        for (std::size_t k = 1; k < curve.size(); ++k) {
            const double at = data.first_mm + data.interval_mm * static_cast<double>(k);
            const double whole = -(too_far_at(curve, at) - *curve.front().too_far_mm) / unit_mm;
            const long next = std::lround(whole);
            data.value.push_back(static_cast<int>(next - sum));
            sum = next;
        }
        return data;
    }
    return std::nullopt;
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
    const auto curves = by_error(cause);
    if (!cause.holds_between && std::any_of(curves.begin(), curves.end(), has_pitch))
        return text +
               "  no pitch error data: a control interpolates, and between its places the table\n"
               "  does not hold\n";
    const auto data = pitch_error_data(cause);
    if (!data) return text;
    text += fmt::format(
        "  pitch error data{}, from {:.4f} mm every {:.4f} mm,\n"
        "  in {:.4f} mm (incremental; assumed):\n"
        "  {}\n",
        cause.includes.empty() ? "" : " (" + cause.includes + " included)", data->first_mm,
        data->interval_mm, data->unit_mm, fmt::join(data->value, " "));
    return text;
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
