#include "regression/compare_picture.h"

#include <algorithm>

#include "regression/chords.h"

namespace trunnion::regression {

namespace {

std::array<double, 3> array_of(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

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

/// Cuts and the rapids between them; of many passes evenly chosen ones.
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

}  // namespace

void draw_paths(const std::vector<PathRegion>& marked_regions, const PathRecord& a,
                const PathRecord& b, const Tolerances& tolerances, ComparePicture& picture) {
    if (marked_regions.empty()) return;
    Tolerances coarse = tolerances;
    coarse.position_mm = std::max(0.5, tolerances.position_mm);
    constexpr std::size_t marked = 40;
    draw_path(a, coarse, picture.cuts_a, picture.rapids_a);
    draw_path(b, coarse, picture.cuts_b, picture.rapids_b);
    for (std::size_t k = 0; k < std::min(marked, marked_regions.size()); ++k) {
        const PathRegion& r = marked_regions[k];
        picture.marks.push_back(
            {k, thin_line(a, r.a, 100, coarse), thin_line(b, r.b, 100, coarse)});
    }
}

}  // namespace trunnion::regression
