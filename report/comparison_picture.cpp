#include "report/comparison_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/svg.h"

namespace trunnion::report {

namespace {

using Line = regression::ComparePicture::Line;
using Point3 = std::array<double, 3>;

Point2 from_above(const Point3& p) {
    return {p[0], p[1]};
}
Point2 from_the_front(const Point3& p) {
    return {p[0], p[2]};
}
/// Along (1, 1, -0.8): X and Y to the right and left, Z up.
Point2 from_the_side(const Point3& p) {
    return {0.7071 * (p[0] - p[1]), 0.35 * (p[0] + p[1]) + 0.8 * p[2]};
}

/// A box in the plane of a view.
struct Box {
    double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
    double high_x = -low_x, high_y = -low_x;

    void widen(const Point2& p) {
        low_x = std::min(low_x, p.x);
        high_x = std::max(high_x, p.x);
        low_y = std::min(low_y, p.y);
        high_y = std::max(high_y, p.y);
    }
    bool holds(const Point2& p) const {
        return p.x >= low_x && p.x <= high_x && p.y >= low_y && p.y <= high_y;
    }
    double width() const { return high_x - low_x; }
    double height() const { return high_y - low_y; }
    Box grown(double by) const { return {low_x - by, low_y - by, high_x + by, high_y + by}; }
};

struct View {
    const char* name;
    Point2 (*seen)(const Point3&);
    Point2 corner;  ///< of its frame, pixels
    double width, height;
};

/// The part of a - b within the box (Liang and Barsky 1984); false: nothing.
bool clip(const Box& box, Point2& a, Point2& b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double p[] = {-dx, dx, -dy, dy};
    const double q[] = {a.x - box.low_x, box.high_x - a.x, a.y - box.low_y, box.high_y - a.y};
    double from = 0.0, to = 1.0;
    for (int k = 0; k < 4; ++k) {
        if (p[k] == 0.0 && q[k] < 0.0) return false;
        if (p[k] < 0.0) from = std::max(from, q[k] / p[k]);
        if (p[k] > 0.0) to = std::min(to, q[k] / p[k]);
    }
    if (from > to) return false;
    b = {a.x + to * dx, a.y + to * dy};
    a = {a.x + from * dx, a.y + from * dy};
    return true;
}

/// 1, 2 or 5 times a power of ten, about a quarter of `span`.
double bar_length(double span) {
    const double power = std::pow(10.0, std::floor(std::log10(std::max(span, 1e-9) / 4.0)));
    for (const double step : {5.0, 2.0})
        if (step * power <= span / 4.0) return step * power;
    return power;
}

class ViewDrawing {
  public:
    ViewDrawing(Svg& svg, const View& view, const regression::ComparePicture& picture)
        : svg_(svg), view_(view), picture_(picture) {
        for (const auto* lines : {&picture.cuts_a, &picture.cuts_b})
            for (const Line& line : *lines) widen(line);
        // What differs far away (a retract to machine zero) must not set the scale.
        const double size = std::max({box_.width(), box_.height(), 1.0});
        const Box near = box_.grown(0.5 * size);
        for (const regression::ComparePicture::Mark& m : picture.marks)
            for (const Line* line : {&m.a, &m.b})
                for (const Point3& p : *line)
                    if (near.holds(view_.seen(p))) box_.widen(view_.seen(p));
        box_ = box_.grown(0.06 * std::max({box_.width(), box_.height(), 1.0}));
        scale_ = std::min(view.width / box_.width(), view.height / box_.height());
        const double spare_x = view.width / scale_ - box_.width();
        const double spare_y = view.height / scale_ - box_.height();
        box_ = {box_.low_x - spare_x / 2, box_.low_y - spare_y / 2, box_.high_x + spare_x / 2,
                box_.high_y + spare_y / 2};
    }

    void draw() {
        const SvgStyle faint_a{"#cfcfcf", 0.6, "none", "2 3"},
            faint_b{"#c3def0", 0.6, "none", "2 3"};
        for (const Line& line : picture_.rapids_a) draw_line(line, faint_a);
        for (const Line& line : picture_.rapids_b) draw_line(line, faint_b);
        for (const Line& line : picture_.cuts_a) draw_line(line, {"#8a8a8a", 1.0, "none", ""});
        for (const Line& line : picture_.cuts_b) draw_line(line, {"#56B4E9", 1.0, "none", "4 3"});
        for (const regression::ComparePicture::Mark& m : picture_.marks) {
            draw_line(m.a, {"#D55E00", 3.0, "none", ""});
            draw_line(m.b, {"#0072B2", 3.0, "none", "5 4"});
        }
        for (const regression::ComparePicture::Mark& m : picture_.marks) draw_number(m);
        svg_.rectangle(view_.corner, view_.width, view_.height, {"#bbb", 1.0, "none", ""});
        svg_.text({view_.corner.x, view_.corner.y - 6}, view_.name, 13);
        draw_bar();
    }

  private:
    void widen(const Line& line) {
        for (const Point3& p : line) box_.widen(view_.seen(p));
    }
    Point2 pixel(const Point2& p) const {
        return {view_.corner.x + (p.x - box_.low_x) * scale_,
                view_.corner.y + view_.height - (p.y - box_.low_y) * scale_};
    }
    void draw_line(const Line& line, const SvgStyle& style) {
        std::vector<Point2> run;
        const auto flush = [&] {
            if (run.size() > 1) svg_.polyline(run, style);
            run.clear();
        };
        for (std::size_t k = 1; k < line.size(); ++k) {
            Point2 a = view_.seen(line[k - 1]), b = view_.seen(line[k]);
            const bool from_inside = box_.holds(a), to_inside = box_.holds(b);
            if (!clip(box_, a, b)) {
                flush();
                continue;
            }
            if (run.empty() || !from_inside) {
                flush();
                run.push_back(pixel(a));
            }
            run.push_back(pixel(b));
            if (!to_inside) flush();
        }
        flush();
    }
    /// The difference's number beside the middle of its first place.
    void draw_number(const regression::ComparePicture::Mark& m) {
        const Line& line = m.b.empty() ? m.a : m.b;
        if (line.empty()) return;
        Point2 a = view_.seen(line[line.size() / 2]);
        if (!box_.holds(a)) a = view_.seen(line.front());
        if (!box_.holds(a)) return;
        const Point2 at = pixel(a);
        // Numbers that would cover one another: the first stands for them all.
        for (const Point2& other : numbers_)
            if (std::hypot(other.x - at.x, other.y - at.y) < 14.0) return;
        numbers_.push_back(at);
        svg_.circle({at.x + 9, at.y - 9}, 8, {"#D55E00", 1.0, "#fff", ""});
        svg_.text({at.x + 9, at.y - 5}, std::to_string(m.difference + 1), 11, "middle");
    }
    void draw_bar() {
        const double length = bar_length(box_.width());
        const Point2 from{view_.corner.x + 10, view_.corner.y + view_.height - 10};
        svg_.line(from, {from.x + length * scale_, from.y}, {"#222", 2.0, "none", ""});
        svg_.text({from.x, from.y - 5}, fmt::format("{:g} mm", length), 11);
    }

    Svg& svg_;
    View view_;
    const regression::ComparePicture& picture_;
    Box box_;
    double scale_ = 1.0;
    std::vector<Point2> numbers_;
};

}  // namespace

std::string picture_html(const regression::Comparison& comparison) {
    const regression::ComparePicture& picture = comparison.picture;
    if (picture.empty()) return {};
    Svg svg(1040.0, 700.0);
    for (const View& view :
         {View{"from the side", from_the_side, {10, 30}, 510, 660},
          View{"from above: X right, Y up", from_above, {540, 30}, 490, 380},
          View{"from the front: X right, Z up", from_the_front, {540, 440}, 490, 250}})
        ViewDrawing(svg, view, picture).draw();
    return "<figure>" + svg.str() +
           "<figcaption>Grey: cuts of A. Light blue, dashed: cuts of B. Thick orange: what differs "
           "in "
           "A; thick blue, dashed: in B; the numbers are those below. Faint: rapids.</figcaption>"
           "</figure>\n";
}

}  // namespace trunnion::report
