#include "regression/short_runs.h"

#include "regression/chords.h"

namespace trunnion::regression {

namespace {

bool runs(const Segment& s) {
    return s.kind == SegmentKind::rapid || s.kind == SegmentKind::feed;
}

}  // namespace

void ShortRuns::add(const Segment& segment) {
    const double length = runs(last_) ? length_mm(end_, segment) : 0.0;
    end_ = segment.end();
    if (!runs(segment) || segment.turning || !runs(last_)) {
        write_held();
        return write(segment);
    }
    if (!held_.empty() && held_.front().kind != segment.kind) write_held_as(segment);
    if (held_.empty() && segment.kind == last_.kind) return write(segment);
    held_.push_back(segment);
    held_mm_ += length;
    if (held_mm_ > noise_mm_) write_held();
}

void ShortRuns::finish() {
    if (!held_.empty()) write_held_as(last_);
}

void ShortRuns::write(const Segment& segment) {
    last_ = segment;
    record_.add(segment);
}

void ShortRuns::write_held() {
    for (const Segment& s : held_) write(s);
    held_.clear();
    held_mm_ = 0.0;
}

void ShortRuns::write_held_as(const Segment& like) {
    for (Segment& s : held_) {
        s.kind = like.kind;
        s.feed_mm_min = like.feed_mm_min;
        s.spindle_rpm = like.spindle_rpm;
        s.coolant = like.coolant;
        s.tool = like.tool;
        s.timed = like.timed;
    }
    write_held();
}

}  // namespace trunnion::regression
