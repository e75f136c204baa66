#include "regression/golden.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "base/alarm.h"
#include "base/units.h"

namespace trunnion::regression {

namespace {

constexpr const char* head =
    "motion,tool,feed_mm_min,spindle_rpm,coolant,mode,x_mm,y_mm,z_mm,tool_i,tool_j,tool_k,"
    "center_x_mm,center_y_mm,center_z_mm,normal_x,normal_y,normal_z,sweep_deg\n";
constexpr std::array<const char*, 4> motions{"START", "G0", "G1", "JUMP"};

/// Six decimals without trailing zeros, never "-0".
std::string number(double value) {
    std::string text = fmt::format("{:.6f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string row(const Segment& s) {
    const char* motion = s.is_arc() ? "ARC" : motions[static_cast<std::size_t>(s.kind)];
    std::string out = fmt::format("{},{},{},{},{},{}", motion, s.tool, number(s.feed_mm_min),
                                  number(s.spindle_rpm), s.coolant ? 1 : 0, s.mode);
    for (const double v : s.end_mm) out += "," + number(v);
    for (const double v : s.end_orientation) out += "," + number(v);
    if (!s.is_arc()) return out + ",,,,,,,\n";
    for (const double v : s.centre_mm) out += "," + number(v);
    for (const float v : s.normal) out += "," + number(v);
    return out + "," + number(deg_from_rad(s.sweep_rad)) + "\n";
}

/// True when `next` continues start -> last in the same direction with everything else equal.
bool goes_on(const PathPoint& start, const Segment& last, const Segment& next) {
    if (last.kind != next.kind || last.is_arc() || next.is_arc() || last.tool != next.tool ||
        last.feed_mm_min != next.feed_mm_min || last.spindle_rpm != next.spindle_rpm ||
        last.coolant != next.coolant || last.mode != next.mode || next.turning || last.turning)
        return false;
    if (last.end_orientation != next.end_orientation || last.kind == SegmentKind::jump)
        return false;
    const Vector3 done = last.end().position_mm - start.position_mm;
    const Vector3 more = next.end().position_mm - last.end().position_mm;
    return done.dot(more) > 0.0 && done.cross(more).norm() <= 1e-7 * (done + more).norm();
}

/// Six decimals of a path in mm: a larger number is no path, and its distance to another overflows,
/// which no comparison would call a difference.
constexpr double largest = 1e9;

class RowReader {
  public:
    RowReader(std::string_view line, const std::string& path, int number)
        : line_(line), path_(path), number_(number) {}

    std::string_view field() {
        if (at_ > line_.size()) fail("a column is missing");
        const std::size_t comma = std::min(line_.find(',', at_), line_.size());
        const std::string_view text = line_.substr(at_, comma - at_);
        field_at_ = at_;
        at_ = comma + 1;
        return text;
    }
    double value() {
        const std::string_view text = field();
        double v = 0.0;
        if (text.empty()) return v;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
        if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(v))
            fail("not a number: '" + std::string(text) + "'");
        if (std::abs(v) > largest) fail(std::string(text) + " is beyond 1e9");
        return v;
    }
    /// A count of the type's range: the conversion of another number is undefined.
    template <class Count>
    Count count() {
        const double v = value();
        if (v < 0.0 || v > std::numeric_limits<Count>::max() || v != std::floor(v))
            fail(fmt::format("a whole number of 0 to {} is expected here",
                             std::numeric_limits<Count>::max()));
        return static_cast<Count>(v);
    }
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {path_, number_, static_cast<int>(field_at_) + 1},
                         std::string(line_));
    }

  private:
    std::string_view line_;
    const std::string& path_;
    int number_;
    std::size_t at_ = 0, field_at_ = 0;
};

Segment segment_of(RowReader row, int line) {
    Segment s;
    const std::string_view motion = row.field();
    if (motion == "START")
        s.kind = SegmentKind::origin;
    else if (motion == "G0")
        s.kind = SegmentKind::rapid;
    else if (motion == "G1" || motion == "ARC")
        s.kind = SegmentKind::feed;
    else if (motion == "JUMP")
        s.kind = SegmentKind::jump;
    else
        row.fail("not a motion (START, G0, G1, ARC, JUMP)");
    s.tool = row.count<std::uint16_t>();
    s.feed_mm_min = static_cast<float>(row.value());
    s.spindle_rpm = static_cast<float>(row.value());
    s.coolant = row.value() != 0.0;
    s.mode = row.count<std::uint8_t>();
    for (double& v : s.end_mm) v = row.value();
    for (double& v : s.end_orientation) v = row.value();
    for (double& v : s.centre_mm) v = row.value();
    for (float& v : s.normal) v = static_cast<float>(row.value());
    s.sweep_rad = rad_from_deg(row.value());
    s.line = static_cast<std::uint32_t>(line);
    return s;
}

std::string tool_lines(const PathRecord& path) {
    std::string out;
    for (const auto& [tool, t] : path.totals())
        out += fmt::format(
            "# T{}: {} passes, cut {:.3f} mm, rapid {:.3f} mm, feed {:g}..{:g} mm/min, spindle "
            "{:g}..{:g} rpm\n",
            tool, t.passes, t.cut_mm, t.rapid_mm, t.feed_min, t.feed_max, t.spindle_min,
            t.spindle_max);
    return out;
}

}  // namespace

std::string format_golden(const PathRecord& path, const std::vector<std::string>& reasons) {
    std::string out = "# schema = trunnion.golden/1\n";
    for (const std::string& reason : reasons) out += "# reason = " + reason + "\n";
    out += tool_lines(path) + head;
    SegmentWindow window(path.segments());
    std::optional<Segment> pending;
    PathPoint start;
    for (std::uint64_t k = 0; k < window.size(); ++k) {
        const Segment next = window[k];
        if (pending && k > 1 && goes_on(start, *pending, next)) {
            pending = next;
            continue;
        }
        if (pending) {
            out += row(*pending);
            start = pending->end();
        }
        pending = next;
    }
    if (pending) out += row(*pending);
    return out;
}

Golden parse_golden(const std::string& text, const std::string& path) {
    Golden golden;
    golden.path.program_index(path);
    std::string_view rest(text);
    bool schema = false;
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.starts_with("# schema = trunnion.golden/1")) schema = true;
        if (line.starts_with("# reason = ")) golden.reasons.emplace_back(line.substr(11));
        if (line.empty() || line.starts_with("#") || line.starts_with("motion,")) continue;
        if (!schema)
            throw InputError("not a golden: no '# schema = trunnion.golden/1'", {path, 1, 1});
        golden.path.add(segment_of(RowReader(line, path, number), number));
    }
    if (!schema) throw InputError("not a golden: no '# schema = trunnion.golden/1'", {path, 1, 1});
    golden.path.finish();
    return golden;
}

}  // namespace trunnion::regression
