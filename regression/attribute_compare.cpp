#include "regression/attribute_compare.h"

#include <algorithm>
#include <cmath>

namespace trunnion::regression {

namespace {

bool is_attribute(RegionKind kind) {
    return kind == RegionKind::feed || kind == RegionKind::spindle || kind == RegionKind::coolant ||
           kind == RegionKind::tool;
}

double apart(double a, double b) {
    const double larger = std::max(std::abs(a), std::abs(b));
    return larger > 0.0 ? std::abs(a - b) / larger : 0.0;
}

}  // namespace

void AttributeComparer::begin(std::vector<PathRegion>& regions) {
    regions_ = &regions;
    first_region_ = regions.size();
    window_ = {};
    gone_mm_ = 0.0;
}

void AttributeComparer::pair(std::uint64_t i, std::uint64_t j, double length_a_mm,
                             double length_b_mm) {
    const Segment &sa = a_[i], &sb = b_[j];
    const bool cuts_a = sa.kind == SegmentKind::feed, cuts_b = sb.kind == SegmentKind::feed;
    if (!cuts_a || !cuts_b) close_window();
    gone_mm_ += length_a_mm;
    if (!cuts_a && !cuts_b) return;  // a rapid beside a cut is a cut without feed
    const Stretch at_a{i, i + 1}, at_b{j, j + 1};
    if (sa.tool != sb.tool)
        add(RegionKind::tool, at_a, at_b, {double(sa.tool), double(sb.tool)}, length_a_mm);
    if (apart(sa.spindle_rpm, sb.spindle_rpm) > tolerances_.feed_ratio)
        add(RegionKind::spindle, at_a, at_b, {sa.spindle_rpm, sb.spindle_rpm}, length_a_mm);
    if (sa.coolant != sb.coolant)
        add(RegionKind::coolant, at_a, at_b, {sa.coolant ? 1.0 : 0.0, sb.coolant ? 1.0 : 0.0},
            length_a_mm);
    feeds(i, j, length_a_mm, length_b_mm);
}

void AttributeComparer::alone(std::uint64_t i, std::uint64_t j, double length_mm) {
    const Values feeds{a_[i].feed_mm_min, b_[j].feed_mm_min};
    close_window();
    gone_mm_ += length_mm;
    if (apart(feeds.a, feeds.b) > tolerances_.feed_ratio)
        add(RegionKind::feed, {i, i + 1}, {j, j + 1}, feeds, length_mm);
}

void AttributeComparer::feeds(std::uint64_t i, std::uint64_t j, double length_a_mm,
                              double length_b_mm) {
    const Segment &sa = a_[i], &sb = b_[j];
    const double feed_a = sa.feed_mm_min, feed_b = sb.feed_mm_min;
    const bool timed = (sa.timed || sb.timed) && feed_a > 0.0 && feed_b > 0.0;
    if (!timed) {
        close_window();
        if (apart(feed_a, feed_b) > tolerances_.feed_ratio)
            add(RegionKind::feed, {i, i + 1}, {j, j + 1}, {feed_a, feed_b}, length_a_mm);
        return;
    }
    Window& w = window_;
    if (!w.open) w = {{i, i}, {j, j}, 0.0, 0.0, 0.0, 0.0, true};
    w.a.last = i + 1;
    w.b.last = j + 1;
    w.length_a_mm += length_a_mm;
    w.length_b_mm += length_b_mm;
    w.time_a += length_a_mm / feed_a;
    w.time_b += length_b_mm / feed_b;
    const double enough_mm = 4.0 * tolerances_.position_mm / std::max(1e-4, tolerances_.feed_ratio);
    if (std::min(w.length_a_mm, w.length_b_mm) >= enough_mm) close_window();
}

void AttributeComparer::close_window() {
    const Window w = window_;
    window_.open = false;
    if (!w.open || w.time_a <= 0.0 || w.time_b <= 0.0) return;
    const double feed_a = w.length_a_mm / w.time_a, feed_b = w.length_b_mm / w.time_b;
    const double length_mm = std::min(w.length_a_mm, w.length_b_mm);
    const double uncertain = tolerances_.position_mm / std::max(length_mm, 1e-9);
    if (apart(feed_a, feed_b) > tolerances_.feed_ratio + uncertain)
        add(RegionKind::feed, w.a, w.b, {feed_a, feed_b}, length_mm);
}

/// Continuation of the same change: one difference, also across rapids.
bool AttributeComparer::continues(const PathRegion& r, RegionKind kind, Values values) const {
    if (r.kind != kind) return false;
    const bool same = apart(r.value_a, values.a) <= 1e-3 && apart(r.value_b, values.b) <= 1e-3;
    if (same || kind != RegionKind::feed || r.value_a <= 0.0 || values.a <= 0.0) return same;
    return window_.time_a > 0.0 && apart(r.value_b / r.value_a, values.b / values.a) <= 0.01;
}

void AttributeComparer::add(RegionKind kind, Stretch a, Stretch b, Values values,
                            double length_mm) {
    const std::size_t look_back = std::min<std::size_t>(4, regions_->size() - first_region_);
    for (std::size_t k = 1; k <= look_back; ++k) {
        PathRegion& r = (*regions_)[regions_->size() - k];
        if (!continues(r, kind, values)) continue;
        r.a.last = std::max(r.a.last, a.last);
        r.b.last = std::max(r.b.last, b.last);
        const bool goes_on = gone_mm_ - length_mm <= r.run_end_mm + tolerances_.position_mm;
        r.run_mm = goes_on ? r.run_mm + length_mm : length_mm;
        r.run_end_mm = gone_mm_;
        r.length_mm = std::max(r.length_mm, r.run_mm);
        return;
    }
    PathRegion region;
    region.kind = kind;
    region.a = a;
    region.b = b;
    region.value_a = values.a;
    region.value_b = values.b;
    region.length_mm = region.run_mm = length_mm;
    region.run_end_mm = gone_mm_;
    regions_->push_back(region);
}

void AttributeComparer::end() {
    close_window();
    const double least_mm = 4.0 * tolerances_.position_mm;
    const auto noise = [&](const PathRegion& r) {
        return is_attribute(r.kind) && r.length_mm <= least_mm;
    };
    regions_->erase(std::remove_if(regions_->begin() + static_cast<std::ptrdiff_t>(first_region_),
                                   regions_->end(), noise),
                    regions_->end());
}

}  // namespace trunnion::regression
