#include "report/svg.h"

#include <fmt/format.h>

#include <cmath>

#include "report/xml.h"

namespace trunnion::report {

const std::vector<std::string> plot_colours{"#0072B2", "#E69F00", "#009E73", "#CC79A7",
                                            "#D55E00", "#56B4E9", "#000000", "#999999"};

namespace {

/// Two decimals, never "-0.00".
std::string px(double value) {
    std::string s = fmt::format("{:.2f}", value);
    return s == "-0.00" ? "0.00" : s;
}

std::string attributes(const SvgStyle& style) {
    std::string s = fmt::format("stroke=\"{}\" stroke-width=\"{}\" fill=\"{}\"", style.stroke,
                                px(style.width), style.fill);
    if (!style.dash.empty()) s += fmt::format(" stroke-dasharray=\"{}\"", style.dash);
    return s;
}

}  // namespace

Svg::Svg(double width, double height) : width_(width), height_(height) {}

void Svg::line(Point2 a, Point2 b, const SvgStyle& style) {
    body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" {}/>\n", px(a.x), px(a.y),
                         px(b.x), px(b.y), attributes(style));
}

void Svg::polyline(const std::vector<Point2>& points, const SvgStyle& style) {
    std::string list;
    for (const Point2& p : points) list += (list.empty() ? "" : " ") + px(p.x) + "," + px(p.y);
    body_ += fmt::format("<polyline points=\"{}\" stroke-linejoin=\"round\" {}/>\n", list,
                         attributes(style));
}

void Svg::circle(Point2 centre, double radius, const SvgStyle& style) {
    body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}/>\n", px(centre.x), px(centre.y),
                         px(radius), attributes(style));
}

void Svg::rectangle(Point2 corner, double width, double height, const SvgStyle& style) {
    body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", px(corner.x),
                         px(corner.y), px(width), px(height), attributes(style));
}

void Svg::mark(Point2 at, int shape, const std::string& colour, double size) {
    const SvgStyle style{"none", 0.0, colour, ""};
    if (shape % 4 == 0) return circle(at, size, style);
    if (shape % 4 == 1) return rectangle({at.x - size, at.y - size}, 2 * size, 2 * size, style);
    const double s = 1.35 * size;
    if (shape % 4 == 2)
        return polyline({{at.x, at.y - s}, {at.x + s, at.y}, {at.x, at.y + s}, {at.x - s, at.y}},
                        style);
    polyline({{at.x, at.y - s}, {at.x + s, at.y + 0.7 * s}, {at.x - s, at.y + 0.7 * s}}, style);
}

void Svg::text(Point2 at, const std::string& text, const TextStyle& style) {
    const std::string turn = style.turn_deg == 0.0
                                 ? ""
                                 : fmt::format(" transform=\"rotate({} {} {})\"",
                                               px(style.turn_deg), px(at.x), px(at.y));
    body_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n",
        px(at.x), px(at.y), px(style.size), style.anchor, style.colour, turn, escape_xml(text));
}

void Svg::describe(const std::string& title, const std::string& description) {
    title_ = title;
    description_ = description;
}

std::string Svg::str() const {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\"",
        px(width_), px(height_));
    const std::string title = escape_xml(title_), description = escape_xml(description_);
    if (!title.empty()) out += fmt::format(" role=\"img\" aria-label=\"{}\"", title);
    out += ">\n";
    if (!title.empty()) out += fmt::format("<title>{}</title>\n", title);
    if (!description.empty()) out += fmt::format("<desc>{}</desc>\n", description);
    return out + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" + body_ + "</svg>\n";
}

PlotRange round_range(double low, double high, int about_ticks) {
    if (!(high > low)) {
        const double pad = low == 0.0 ? 1.0 : std::abs(low) * 0.1;
        low -= pad;
        high += pad;
    }
    const double raw = (high - low) / about_ticks;
    const double decade = std::pow(10.0, std::floor(std::log10(raw)));
    double tick = 10.0 * decade;
    for (const double step : {1.0, 2.0, 5.0})
        if (step * decade >= raw * 0.999) {
            tick = step * decade;
            break;
        }
    return {std::floor(low / tick + 1e-9) * tick, std::ceil(high / tick - 1e-9) * tick, tick};
}

Plot::Plot(Svg& svg, const Frame& frame, PlotRange x, PlotRange y)
    : svg_(svg), corner_(frame.corner), width_(frame.width), height_(frame.height), x_(x), y_(y) {}

Point2 Plot::at(double x, double y) const {
    return {corner_.x + (x - x_.low) / (x_.high - x_.low) * width_,
            corner_.y + height_ - (y - y_.low) / (y_.high - y_.low) * height_};
}

void Plot::frame(const std::string& title, const std::string& x_label, const std::string& y_label) {
    const SvgStyle grid{"#e0e0e0", 1.0, "none", ""};
    const auto ticks = [](const PlotRange& r) {
        return static_cast<int>(std::lround((r.high - r.low) / r.tick));
    };
    for (int i = 0; i <= ticks(x_); ++i) {
        const double v = x_.low + i * x_.tick;
        svg_.line(at(v, y_.low), at(v, y_.high), grid);
        svg_.text({at(v, y_.low).x, corner_.y + height_ + 16}, fmt::format("{:.6g}", v),
                  {11, "middle"});
    }
    for (int i = 0; i <= ticks(y_); ++i) {
        double v = y_.low + i * y_.tick;
        if (std::abs(v) < 1e-9 * y_.tick) v = 0.0;
        svg_.line(at(x_.low, v), at(x_.high, v), grid);
        svg_.text({corner_.x - 6, at(x_.low, v).y + 4}, fmt::format("{:.6g}", v), {11, "end"});
    }
    svg_.rectangle(corner_, width_, height_, {"#555", 1.0, "none", ""});
    svg_.text({corner_.x + width_ / 2, corner_.y - 8}, title, {13, "middle"});
    svg_.text({corner_.x + width_ / 2, corner_.y + height_ + 34}, x_label, {12, "middle"});
    svg_.text({corner_.x - 44, corner_.y + height_ / 2}, y_label, {12, "middle", "#222", -90.0});
}

}  // namespace trunnion::report
