// Small SVG drawings: shapes, text and a plot with axes, with a fixed number of decimals.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trunnion::report {

/// Colours that colour-blind readers can distinguish (Okabe and Ito), in order of use.
extern const std::vector<std::string> plot_colours;

struct Point2 {
    double x = 0.0, y = 0.0;
};

struct SvgStyle {
    std::string stroke = "black";
    double width = 1.0;
    std::string fill = "none";
    std::string dash;  ///< e.g. "4 3"
};

/// A size alone converts to a style with the default anchor and colour.
struct TextStyle {
    TextStyle(double size_px = 12.0, std::string anchor_word = "start",
              std::string colour_word = "#222", double turned_deg = 0.0)
        : size(size_px),
          anchor(std::move(anchor_word)),
          colour(std::move(colour_word)),
          turn_deg(turned_deg) {}

    double size;         ///< px
    std::string anchor;  ///< start, middle, end
    std::string colour;
    double turn_deg;
};

/// A drawing in pixels, y downwards, white background.
class Svg {
  public:
    Svg(double width, double height);

    void line(Point2 a, Point2 b, const SvgStyle& style = {});
    void polyline(const std::vector<Point2>& points, const SvgStyle& style = {});
    void circle(Point2 centre, double radius, const SvgStyle& style = {});
    void rectangle(Point2 corner, double width, double height, const SvgStyle& style = {});
    /// A filled mark of about 3.5 px: shape 0 disc, 1 square, 2 diamond, 3 triangle.
    void mark(Point2 at, int shape, const std::string& colour, double size = 3.5);
    void text(Point2 at, const std::string& text, const TextStyle& style = {});

    /// Text for screen readers; `description` may be empty.
    void describe(const std::string& title, const std::string& description = {});

    std::string str() const;  ///< the whole file

  private:
    double width_, height_;
    std::string title_, description_;
    std::string body_;
};

/// A linear axis of a plot: range in data units, and position of ticks.
struct PlotRange {
    double low = 0.0, high = 1.0;
    double tick = 0.2;
};

/// A range with round ticks (1, 2, 5 x 10^n) that contains low..high.
PlotRange round_range(double low, double high, int about_ticks = 5);

/// Place of a plot in its drawing: upper left corner and size, px.
struct Frame {
    Point2 corner;
    double width, height;
};

/// A frame with axes inside a drawing; `at` maps data to pixels.
class Plot {
  public:
    Plot(Svg& svg, const Frame& frame, PlotRange x, PlotRange y);
    void frame(const std::string& title, const std::string& x_label, const std::string& y_label);
    Point2 at(double x, double y) const;
    double scale_x() const { return width_ / (x_.high - x_.low); }  ///< px per data unit

  private:
    Svg& svg_;
    Point2 corner_;
    double width_, height_;
    PlotRange x_, y_;
};

}  // namespace trunnion::report
