#include "regression/path_record.h"

#include <algorithm>

#include "regression/arrays.h"
#include "regression/chords.h"

namespace trunnion::regression {

namespace {

bool stands(const PathPoint& from, const Segment& segment) {
    return !segment.is_arc() && from.position_mm == Vector3(segment.end_mm.data()) &&
           from.orientation == Vector3(segment.end_orientation.data());
}

}  // namespace

std::uint16_t PathRecord::program_index(const std::string& name) {
    if (!programs_.empty() && programs_.back() == name)
        return static_cast<std::uint16_t>(programs_.size() - 1);
    const auto found = std::find(programs_.begin(), programs_.end(), name);
    const auto index = static_cast<std::size_t>(found - programs_.begin());
    if (found == programs_.end()) programs_.push_back(name);
    return static_cast<std::uint16_t>(std::min<std::size_t>(index, 65535));
}

void PathRecord::add(Segment segment) {
    if (file_.size() == 0 || segment.kind == SegmentKind::origin) {
        segment.kind = SegmentKind::origin;
        file_.append(segment);
        end_ = segment.end();
        return;
    }
    if (stands(end_, segment)) return;
    const bool cut = segment.kind == SegmentKind::feed;
    const bool was_cut = open_ && pass_.cut_first < file_.size();
    if (!open_ || (was_cut && !cut) || segment.tool != pass_.tool) begin_pass(segment);
    Pass& pass = pass_;
    const double length = length_mm(end_, segment);
    const Vector3 end = Vector3(segment.end_mm.data());
    if (cut && pass.cut_first == file_.size()) pass.start_mm = array_of(end_.position_mm);
    if (!cut && pass.cut_first == file_.size()) ++pass.cut_first;
    const Vector3 middle = centroid(end_, segment);
    double& total = pass.cuts() || cut ? pass.cut_mm : pass.rapid_mm;
    if (cut && pass.cut_mm == 0.0) pass.centroid_mm = {};
    for (std::size_t k = 0; k < 3; ++k)
        pass.centroid_mm[k] += length * middle[static_cast<Eigen::Index>(k)];
    total += length;
    pass.end_mm = array_of(end);
    const unsigned mode = 1U << segment.mode;
    pass.modes = static_cast<std::uint16_t>(pass.modes | mode);
    if (cut) pass.cut_modes = static_cast<std::uint16_t>(pass.cut_modes | mode);
    modes_ = static_cast<std::uint16_t>(modes_ | mode);
    if (cut) cut_mm_ += length;
    count(segment, length);
    file_.append(segment);
    pass.last = file_.size();
    end_ = segment.end();
}

void PathRecord::begin_pass(const Segment& segment) {
    finish();
    Pass pass;
    pass.first = pass.cut_first = pass.last = file_.size();
    pass.start_mm = array_of(end_.position_mm);
    pass.line = segment.line;
    pass.tool = segment.tool;
    pass_ = pass;
    open_ = true;
    ++totals_[segment.tool].passes;
}

void PathRecord::finish() {
    if (!open_) return;
    const double length = pass_.cuts() ? pass_.cut_mm : pass_.rapid_mm;
    if (length > 0.0)
        for (double& c : pass_.centroid_mm) c /= length;
    passes_.append(pass_);
    open_ = false;
}

void PathRecord::count(const Segment& segment, double length) {
    ToolTotals& t = totals_[segment.tool];
    if (segment.kind != SegmentKind::feed) {
        t.rapid_mm += length;
        return;
    }
    const double feed = segment.feed_mm_min, spindle = segment.spindle_rpm;
    const bool first = t.cut_mm == 0.0;
    t.feed_min = first ? feed : std::min(t.feed_min, feed);
    t.feed_max = first ? feed : std::max(t.feed_max, feed);
    t.spindle_min = first ? spindle : std::min(t.spindle_min, spindle);
    t.spindle_max = first ? spindle : std::max(t.spindle_max, spindle);
    t.cut_mm += length;
    if (feed > 0.0) t.cut_s += 60.0 * length / feed;
}

}  // namespace trunnion::regression
