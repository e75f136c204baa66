#include "report/closeup_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page.h"
#include "report/view_box.h"

namespace trunnion::report {

namespace {

using Closeup = regression::ComparePicture::Closeup;
using Point3 = regression::ComparePicture::Point;

constexpr double width = 380.0, height = 330.0;

double dot(const Point3& p, const Point3& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}
Point3 minus(const Point3& p, const Point3& q) {
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

/// The distance of the paths takes a quarter of the picture's height.
class CloseupDrawing {
  public:
    CloseupDrawing(Svg& svg, const Closeup& closeup)
        : svg_(svg), closeup_(closeup), scale_(0.25 * height / closeup.apart_mm()) {}

    void draw() {
        draw_line(closeup_.a, {"#D55E00", 2.5, "none", ""});
        draw_line(closeup_.b, {"#0072B2", 2.5, "none", "5 4"});
        draw_axis(closeup_.axis_a, {"#333", 1.5, "none", ""});
        const bool other_axis = dot(closeup_.axis_a, closeup_.axis_b) < 1.0 - 4e-5;  // 0.5 deg
        if (other_axis) draw_axis(closeup_.axis_b, {"#333", 1.5, "none", "4 3"});
        const Point2 from = pixel(closeup_.place_mm), to = pixel(closeup_.other_mm);
        svg_.line(from, to, {"#b3261e", 1.5, "none", ""});
        for (const Point2& end : {from, to}) svg_.mark(end, 0, "#b3261e", 3.0);
        svg_.text({from.x + 8, 0.5 * (from.y + to.y) + 4}, fmt::format("{:.4f} mm", distance()),
                  {13, "start", "#b3261e"});
        svg_.rectangle({0.5, 0.5}, width - 1.0, height - 1.0, {"#bbb", 1.0, "none", ""});
        const double length = round_length(width / scale_);
        draw_bar(svg_, {10.0, height - 8.0}, length * scale_, length);
    }

  private:
    double distance() const { return closeup_.apart_mm(); }
    Point2 pixel(const Point3& p) const {
        const Point3 from = minus(p, closeup_.place_mm);
        return {0.5 * width + scale_ * dot(from, closeup_.right),
                0.6 * height - scale_ * dot(from, closeup_.up)};
    }
    void draw_line(const regression::ComparePicture::Line& line, const SvgStyle& style) {
        std::vector<Point2> seen;
        for (const Point3& p : line) seen.push_back(pixel(p));
        for (const std::vector<Point2>& run : ViewBox{0.0, 0.0, width, height}.clipped(seen))
            svg_.polyline(run, style);
    }
    void draw_axis(const Point3& axis, const SvgStyle& style) {
        constexpr double long_px = 90.0;
        const Point2 from = pixel(closeup_.place_mm);
        const Point2 to{from.x + long_px * dot(axis, closeup_.right),
                        from.y - long_px * dot(axis, closeup_.up)};
        draw_arrow(svg_, from, to, style);
        const double seen_px = std::hypot(to.x - from.x, to.y - from.y);
        svg_.text({0.5 * (from.x + to.x) + 8, 0.5 * (from.y + to.y) + 18},
                  seen_px > 30.0 ? "tool axis" : "tool axis, seen along", {12, "start", "#333"});
    }

    Svg& svg_;
    const Closeup& closeup_;
    double scale_;
};

}  // namespace

double round_length(double span) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(span, 1e-9) / 4.0)));
    for (const double step : {5.0, 2.0})
        if (step * power <= span / 4.0) return step * power;
    return power;
}

void draw_bar(Svg& svg, Point2 from, double length_px, double length_mm) {
    svg.line(from, {from.x + length_px, from.y}, {"#222", 2.0, "none", ""});
    svg.text({from.x, from.y - 5}, fmt::format("{:g} mm", length_mm), 12);
}

void draw_arrow(Svg& svg, Point2 from, Point2 to, const SvgStyle& style) {
    const double x = to.x - from.x, y = to.y - from.y, length = std::hypot(x, y);
    if (length < 6.0) {
        svg.circle(from, 4, {style.stroke, style.width, "none", ""});
        return svg.mark(from, 0, style.stroke, 1.5);
    }
    svg.line(from, to, style);
    const double u = x / length, v = y / length;
    svg.polyline({{to.x - 7 * u - 3 * v, to.y - 7 * v + 3 * u},
                  to,
                  {to.x - 7 * u + 3 * v, to.y - 7 * v - 3 * u}},
                 {style.stroke, style.width, "none", ""});
}

bool is_small(const Closeup& closeup, double span_mm) {
    return closeup.apart_mm() < 0.08 * span_mm;
}

std::string closeup_html(const Closeup& c) {
    const char* what = c.first && c.worst ? "The first difference and the farthest place"
                       : c.worst          ? "The farthest place"
                                          : "The first difference that lies apart";
    Svg svg(width, height);
    svg.describe(what, "both paths from near, with the distance between them and the tool axis");
    CloseupDrawing(svg, c).draw();
    return figure_html(
        svg.str(),
        fmt::format("{} (number {}): {:.4f} mm at X{:.3f} Y{:.3f} Z{:.3f} of the table. Right is "
                    "along the path, up is towards the other path.",
                    what, c.difference + 1, c.apart_mm(), c.place_mm[0], c.place_mm[1],
                    c.place_mm[2]));
}

}  // namespace trunnion::report
