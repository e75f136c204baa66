#include "report/view_box.h"

#include <algorithm>

namespace trunnion::report {

namespace {

/// Clips a - b to the box (Liang and Barsky 1984); false when nothing remains.
bool clip(const ViewBox& box, Point2& a, Point2& b) {
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

}  // namespace

void ViewBox::widen(const Point2& p) {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y);
    high_y = std::max(high_y, p.y);
}

bool ViewBox::holds(const Point2& p) const {
    return p.x >= low_x && p.x <= high_x && p.y >= low_y && p.y <= high_y;
}

std::vector<std::vector<Point2>> ViewBox::clipped(const std::vector<Point2>& line) const {
    std::vector<std::vector<Point2>> runs(1);
    for (std::size_t k = 1; k < line.size(); ++k) {
        Point2 a = line[k - 1], b = line[k];
        if (!holds(a) && !runs.back().empty()) runs.emplace_back();
        if (!clip(*this, a, b)) continue;
        if (runs.back().empty()) runs.back().push_back(a);
        runs.back().push_back(b);
    }
    std::erase_if(runs, [](const std::vector<Point2>& run) { return run.size() < 2; });
    return runs;
}

}  // namespace trunnion::report
