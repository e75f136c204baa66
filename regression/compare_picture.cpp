#include "regression/compare_picture.h"

#include <algorithm>

#include "regression/arrays.h"
#include "regression/chords.h"
#include "regression/closeup.h"

namespace trunnion::regression {

namespace {

ComparePicture::Line thin_line(const PathRecord& record, Stretch stretch, std::uint64_t points,
                               const Tolerances& tolerances) {
    ComparePicture::Line line;
    SegmentWindow path(record.segments());
    const std::uint64_t step = 1 + (stretch.last - stretch.first) / points;
    std::vector<PathPoint> chords;
    for (std::uint64_t k = stretch.first; k < stretch.last; k += step) {
        const PathPoint start = path[k - 1].end();
        const Segment segment = path[k];
        if (segment.kind == SegmentKind::jump) continue;  // no motion
        if (line.empty()) line.push_back(array_of(start.position_mm));
        if (segment.is_arc() && step == 1) {
            chords.clear();
            append_chords(start, segment, tolerances, chords);
            const std::size_t stride = 1 + chords.size() / 12;
            for (std::size_t c = 0; c + 1 < chords.size(); c += stride)
                line.push_back(array_of(chords[c].position_mm));
        }
        line.push_back(array_of(segment.end().position_mm));
    }
    return line;
}

/// Cuts and the rapids between them; if there are many passes, an even selection.
void draw_path(const PathRecord& record, const Tolerances& tolerances,
               std::vector<ComparePicture::Line>& cuts, std::vector<ComparePicture::Line>& rapids) {
    constexpr std::uint64_t most_passes = 300, most_points = 3000;
    const std::uint64_t count = record.passes().size();
    const std::uint64_t step = 1 + count / most_passes;
    const std::uint64_t points = most_points / std::max<std::uint64_t>(1, count / step) + 4;
    SpilledWindow<Pass> passes(record.passes());
    for (std::uint64_t k = 0; k < count; k += step) {
        const Pass pass = passes[k];
        auto rapid = thin_line(record, {pass.first, pass.cut_first}, 8, tolerances);
        if (rapid.size() > 1) rapids.push_back(std::move(rapid));
        auto cut = thin_line(record, {pass.cut_first, pass.last}, points, tolerances);
        if (cut.size() > 1) cuts.push_back(std::move(cut));
    }
}

bool holds(const PathRegion& region, const PictureInput& in) {
    return (in.worst_a.first >= region.a.first && in.worst_a.first < region.a.last) ||
           (in.worst_b.first >= region.b.first && in.worst_b.first < region.b.last);
}

/// The first region with different paths, and the worst place unless it is the same.
void add_closeups(const std::vector<PathRegion>& regions, const PictureInput& in,
                  ComparePicture& picture) {
    for (std::size_t k = 0; k < regions.size() && picture.closeups.empty(); ++k) {
        const PathRegion& r = regions[k];
        if (r.position_mm <= in.tolerances.position_mm) continue;
        auto first = closeup_of(in.a, r.a, in.b, r.b, in.tolerances);
        if (!first) continue;
        first->difference = k;
        first->first = true;
        first->worst = holds(r, in);
        picture.closeups.push_back(std::move(*first));
    }
    if (!picture.closeups.empty() && picture.closeups.front().worst) return;
    auto there = closeup_of(in.a, in.worst_a, in.b, in.worst_b, in.tolerances);
    if (!there) return;
    there->difference = in.worst_difference;
    there->worst = true;
    picture.closeups.push_back(std::move(*there));
}

}  // namespace

void draw_paths(const std::vector<PathRegion>& marked_regions, const PictureInput& in,
                ComparePicture& picture) {
    if (marked_regions.empty()) return;
    Tolerances coarse = in.tolerances;
    coarse.position_mm = std::max(0.5, in.tolerances.position_mm);
    constexpr std::size_t marked = 40;
    draw_path(in.a, coarse, picture.cuts_a, picture.rapids_a);
    draw_path(in.b, coarse, picture.cuts_b, picture.rapids_b);
    for (std::size_t k = 0; k < std::min(marked, marked_regions.size()); ++k) {
        const PathRegion& r = marked_regions[k];
        picture.marks.push_back(
            {k, thin_line(in.a, r.a, 100, coarse), thin_line(in.b, r.b, 100, coarse)});
    }
    add_closeups(marked_regions, in, picture);
}

}  // namespace trunnion::regression
