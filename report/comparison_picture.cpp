#include "report/comparison_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/closeup_drawing.h"
#include "report/page.h"
#include "report/svg.h"
#include "report/view_box.h"

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
/// View along (1, 1, -0.8): X to the right, Y to the left, Z up.
Point2 from_the_side(const Point3& p) {
    return {0.7071 * (p[0] - p[1]), 0.35 * (p[0] + p[1]) + 0.8 * p[2]};
}

struct View {
    const char* name;
    Point2 (*seen)(const Point3&);
};
constexpr double view_width = 380.0, view_height = 330.0, view_margin = 10.0;

class ViewDrawing {
  public:
    ViewDrawing(Svg& svg, const View& view, const regression::ComparePicture& picture)
        : svg_(svg), view_(view), picture_(picture) {
        for (const auto* lines : {&picture.cuts_a, &picture.cuts_b})
            for (const Line& line : *lines) widen(line);
        // Distant differences (a retract to machine zero) must not determine the scale.
        const double size = std::max({box_.width(), box_.height(), 1.0});
        const ViewBox near = box_.grown(0.5 * size);
        for (const regression::ComparePicture::Mark& m : picture.marks)
            for (const Line* line : {&m.a, &m.b})
                for (const Point3& p : *line)
                    if (near.holds(view_.seen(p))) box_.widen(view_.seen(p));
        box_ = box_.grown(0.06 * std::max({box_.width(), box_.height(), 1.0}));
        const double width = view_width - 2.0 * view_margin,
                     height = view_height - 3.0 * view_margin;
        scale_ = std::min(width / box_.width(), height / box_.height());
        const double spare_x = width / scale_ - box_.width();
        const double spare_y = height / scale_ - box_.height();
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
        for (const auto& closeup : picture_.closeups) draw_place(closeup);
        for (const regression::ComparePicture::Mark& m : picture_.marks) draw_number(m);
        svg_.rectangle({0.5, 0.5}, view_width - 1.0, view_height - 1.0, {"#bbb", 1.0, "none", ""});
        const double length = round_length(box_.width());
        draw_bar(svg_, {view_margin, view_height - 8.0}, length * scale_, length);
    }
    double span_mm() const { return std::max(box_.width(), box_.height()); }

  private:
    void widen(const Line& line) {
        for (const Point3& p : line) box_.widen(view_.seen(p));
    }
    Point2 pixel(const Point2& p) const {
        return {view_margin + (p.x - box_.low_x) * scale_,
                view_height - 2.0 * view_margin - (p.y - box_.low_y) * scale_};
    }
    void draw_line(const Line& line, const SvgStyle& style) {
        std::vector<Point2> seen;
        for (const Point3& p : line) seen.push_back(view_.seen(p));
        for (std::vector<Point2>& run : box_.clipped(seen)) {
            for (Point2& p : run) p = pixel(p);
            svg_.polyline(run, style);
        }
    }
    /// The number of the difference next to the middle of its first place.
    void draw_number(const regression::ComparePicture::Mark& m) {
        const Line& line = m.b.empty() ? m.a : m.b;
        if (line.empty()) return;
        Point2 a = view_.seen(line[line.size() / 2]);
        if (!box_.holds(a)) a = view_.seen(line.front());
        if (!box_.holds(a)) return;
        const Point2 at = pixel(a);
        // Of overlapping numbers only the first is drawn.
        for (const Point2& other : numbers_)
            if (std::hypot(other.x - at.x, other.y - at.y) < 14.0) return;
        numbers_.push_back(at);
        svg_.circle({at.x + 9, at.y - 9}, 8, {"#D55E00", 1.0, "#fff", ""});
        svg_.text({at.x + 9, at.y - 5}, std::to_string(m.difference + 1), {11, "middle"});
    }
    /// A ring at the place, and the tool axis with an eighth of the view's size.
    void draw_place(const regression::ComparePicture::Closeup& c) {
        const Point2 seen = view_.seen(c.place_mm);
        if (!box_.holds(seen)) return;
        const double long_mm = 0.12 * span_mm();
        Point3 tip = c.place_mm;
        for (std::size_t k = 0; k < 3; ++k) tip[k] += long_mm * c.axis_a[k];
        const Point2 from = pixel(seen);
        svg_.circle(from, 7, {"#b3261e", 2.0, "none", ""});
        draw_arrow(svg_, from, pixel(view_.seen(tip)), {"#333", 1.5, "none", ""});
        const char* name = c.first && c.worst ? "first, worst" : c.worst ? "worst" : "first";
        const bool right = from.x > 0.75 * view_width;
        svg_.text({from.x + (right ? -9 : 9), from.y + 15}, name,
                  {12, right ? "end" : "start", "#b3261e"});
    }

    Svg& svg_;
    View view_;
    const regression::ComparePicture& picture_;
    ViewBox box_;
    double scale_ = 1.0;
    std::vector<Point2> numbers_;
};

}  // namespace

std::string pictures_html(const regression::Comparison& comparison) {
    const regression::ComparePicture& picture = comparison.picture;
    if (picture.empty()) return {};
    std::string views;
    double span_mm = 0.0;
    for (const View& view :
         {View{"From the side", from_the_side}, View{"From above: X right, Y up", from_above},
          View{"From the front: X right, Z up", from_the_front}}) {
        Svg svg(view_width, view_height);
        svg.describe(view.name, "both paths, mm, in the table frame");
        ViewDrawing drawing(svg, view, picture);
        drawing.draw();
        span_mm = std::max(span_mm, drawing.span_mm());
        views += figure_html(svg.str(), view.name);
    }
    for (const auto& closeup : picture.closeups)
        if (is_small(closeup, span_mm)) views += closeup_html(closeup);
    return "<div class=\"pair\">" + views + "</div>\n";
}

}  // namespace trunnion::report
