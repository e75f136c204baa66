#include "report/iso230_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "report/svg.h"

namespace trunnion::report {
namespace {

constexpr double left = 80, top = 60, wide = 620, high = 340;

struct Scale {
    double target, deviation;  ///< in mm and um, or in deg and arcsec
    const char *target_unit, *deviation_unit;
};

Scale scale_of(bool rotary) {
    if (!rotary) return {1.0, 1e3, "mm", "µm"};
    return {deg_from_rad(1.0), 3600.0 * deg_from_rad(1.0), "deg", "arcsec"};
}

/// A range from low to high next to the plot, with its name.
struct Bracket {
    const char* name;
    double low, high;
};

/// Ends of M, E and A: the lowest and highest value that each of them spans.
std::vector<Bracket> brackets_of(const records::Iso230Figures& f) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<Bracket> list{{"M", inf, -inf}, {"E", inf, -inf}, {"A", inf, -inf}};
    const auto add = [](Bracket& b, double v) {
        b.low = std::min(b.low, v);
        b.high = std::max(b.high, v);
    };
    for (const records::TargetFigures& t : f.targets) {
        add(list[0], t.mean());
        for (const auto& [mean, s] :
             {std::pair(t.mean_up, t.s_up), std::pair(t.mean_down, t.s_down)}) {
            add(list[1], mean);
            add(list[2], mean + 2.0 * s);
            add(list[2], mean - 2.0 * s);
        }
    }
    const double width[] = {f.mean_deviation_M, f.systematic_E, f.accuracy_A};
    for (std::size_t k = list.size(); k-- > 0;)
        if (!std::isfinite(width[k])) list.erase(list.begin() + static_cast<std::ptrdiff_t>(k));
    return list;
}

class Picture {
  public:
    Picture(const std::vector<records::DeviationPoint>& points, bool rotary)
        : scale_(scale_of(rotary)),
          points_(points),
          figures_(records::iso230_2_figures(points)),
          plot_(svg_, {{left, top}, wide, high}, targets(), deviations()) {}

    std::string draw(const std::string& title, const std::string& words) {
        plot_.frame(title, fmt::format("target / {}", scale_.target_unit),
                    fmt::format("deviation / {}", scale_.deviation_unit));
        draw_direction(1);
        draw_direction(-1);
        draw_middle();
        draw_reversal();
        draw_brackets();
        svg_.text({left, top + high + 62}, words, 13);
        svg_.mark({left + 4, top + high + 82}, 3, plot_colours[0]);
        svg_.text({left + 14, top + high + 86},
                  "travelling +: readings, mean and mean ± 2 s (bars)", 12);
        svg_.mark({left + 354, top + high + 82}, 1, plot_colours[1]);
        svg_.text({left + 364, top + high + 86}, "travelling -; dashed: mean of both", 12);
        return svg_.str();
    }

  private:
    PlotRange targets() const {
        double low = points_[0].target, most = low;
        for (const records::DeviationPoint& p : points_) {
            low = std::min(low, p.target);
            most = std::max(most, p.target);
        }
        return round_range(scale_.target * low, scale_.target * most, 7);
    }
    PlotRange deviations() const {
        double low = points_[0].deviation, most = low;
        for (const records::DeviationPoint& p : points_) {
            low = std::min(low, p.deviation);
            most = std::max(most, p.deviation);
        }
        for (const Bracket& b : brackets_of(figures_)) {
            low = std::min(low, b.low);
            most = std::max(most, b.high);
        }
        if (low == most) most += 1e-6;
        return round_range(scale_.deviation * low, scale_.deviation * most, 6);
    }
    Point2 at(double target, double deviation) const {
        return plot_.at(scale_.target * target, scale_.deviation * deviation);
    }

    void draw_direction(int direction) {
        const bool up = direction > 0;
        const std::string& colour = plot_colours[up ? 0 : 1];
        for (const records::DeviationPoint& p : points_)
            if (p.direction == direction)
                svg_.mark(at(p.target, p.deviation), up ? 3 : 1, colour, 2.2);
        std::vector<Point2> means;
        for (const records::TargetFigures& t : figures_.targets) {
            const double mean = up ? t.mean_up : t.mean_down, s = up ? t.s_up : t.s_down;
            if (!std::isfinite(mean)) continue;
            means.push_back(at(t.target, mean));
            if (std::isfinite(s))
                svg_.line(at(t.target, mean - 2.0 * s), at(t.target, mean + 2.0 * s),
                          {colour, 1.0, "none", ""});
        }
        svg_.polyline(means, {colour, 1.6, "none", ""});
    }

    void draw_middle() {
        std::vector<Point2> means;
        for (const records::TargetFigures& t : figures_.targets)
            if (std::isfinite(t.mean())) means.push_back(at(t.target, t.mean()));
        svg_.polyline(means, {"#222", 1.0, "none", "5 4"});
    }

    /// B and R are drawn at the targets with the largest values.
    void draw_reversal() {
        for (const records::TargetFigures& t : figures_.targets)
            if (std::isfinite(t.reversal()) && t.reversal() == figures_.reversal_B) {
                const Point2 a = at(t.target, t.mean_up), b = at(t.target, t.mean_down);
                svg_.line({a.x + 6, a.y}, {b.x + 6, b.y}, {"#222", 2.0, "none", ""});
                svg_.text({a.x + 10, 0.5 * (a.y + b.y) + 4}, "B", 13);
                return;
            }
    }

    void draw_brackets() {
        const SvgStyle bar{"#222", 1.4, "none", ""};
        double x = left + wide + 16;
        for (const Bracket& b : brackets_of(figures_)) {
            const double low = at(0.0, b.low).y, top_y = at(0.0, b.high).y;
            svg_.line({x, low}, {x, top_y}, bar);
            svg_.line({x - 4, low}, {x + 4, low}, bar);
            svg_.line({x - 4, top_y}, {x + 4, top_y}, bar);
            svg_.text({x, top_y - 6}, b.name, {13, "middle"});
            x += 26;
        }
    }

    Scale scale_;
    const std::vector<records::DeviationPoint>& points_;
    records::Iso230Figures figures_;
    Svg svg_{left + wide + 100, top + high + 100};
    Plot plot_;
};

}  // namespace

std::string iso230_2_picture(const std::string& title,
                             const std::vector<records::DeviationPoint>& points, bool rotary) {
    const records::Iso230Figures figures = records::iso230_2_figures(points);
    return Picture(points, rotary)
        .draw("Positioning of " + title, records::iso230_2_words(figures, rotary));
}

}  // namespace trunnion::report
