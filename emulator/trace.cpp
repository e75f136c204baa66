#include "emulator/trace.h"

#include <array>
#include <charconv>

#include "controller/rotary_transform.h"
#include "geometry/numbers.h"

namespace trunnion {
namespace {

constexpr std::size_t chunk_bytes = 1 << 16;
constexpr const char* motion_names[] = {"G0", "G1", "G2", "G3"};

void append(std::string& out, double value) {
    out += ',';
    if (value == 0.0) value = 0.0;  // no "-0"
    std::array<char, 32> text;
    out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

template <class Integer>
void append_integer(std::string& out, Integer value) {
    std::array<char, 24> text;
    out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

/// A program's name as a CSV cell.
void append_name(std::string& out, const std::string* name) {
    if (!name) return;
    const bool quoted = name->find(',') != std::string::npos;
    if (quoted) out += '"';
    out += *name;
    if (quoted) out += '"';
}

void append(std::string& out, const Vector3& v) {
    for (int i = 0; i < 3; ++i) append(out, v[i]);
}

}  // namespace

BelievedTool believed_tool(const AxisMove& move, const AxisPositions& q) {
    if (move.transform)
        return {move.transform->tip_W(q, move.tool_vector_mm), move.transform->tool_direction_W(q)};
    return {Vector3(q[Axis::X], q[Axis::Y], q[Axis::Z]) - move.tool_vector_mm, Vector3::UnitZ()};
}

TraceWriter::TraceWriter(std::vector<Axis> axes, bool truth, TraceChunk chunk)
    : axes_(std::move(axes)), truth_(truth), chunk_(std::move(chunk)) {
    text_ = "seq,program,line,motion,tool,feed_mm_min";
    for (const Axis axis : axes_) {
        const char lower = static_cast<char>(letter_of(axis) + ('a' - 'A'));
        text_ += std::string(",") + lower + (is_rotary(axis) ? "_deg" : "_mm");
    }
    text_ +=
        ",tip_x_mm,tip_y_mm,tip_z_mm,tool_i,tool_j,tool_k,length_mm,time_s,"
        "center_x_mm,center_y_mm,center_z_mm,normal_x,normal_y,normal_z,turns";
    if (truth_) text_ += ",true_x_mm,true_y_mm,true_z_mm";
    text_ += '\n';
}

void TraceWriter::add(const AxisMove& move, double s, double time_s, bool end,
                      const Vector3* true_tip_W) {
    const AxisPositions q = move.at(s);
    append_integer(text_, rows_++);
    text_ += ',';
    append_name(text_, move.program);
    text_ += ',';
    append_integer(text_, move.line);
    text_ += ',';
    text_ += end ? motion_names[static_cast<std::size_t>(move.kind)] : "SAMPLE";
    text_ += ',';
    append_integer(text_, move.tool);
    append(text_, move.feed_mm_min);
    for (const Axis axis : axes_)
        is_rotary(axis) ? void(text_ += ',' + shortest_degrees(q[axis])) : append(text_, q[axis]);
    const BelievedTool tool = believed_tool(move, q);
    append(text_, tool.tip_W_mm);
    append(text_, tool.direction_W);
    append(text_, move.length_mm * s);
    append(text_, time_s);
    if (move.arc) {
        append(text_, move.arc->centre_mm);
        append(text_, move.arc->normal);
        append(text_, move.arc->turns);
    } else {
        text_ += ",,,,,,,";
    }
    if (truth_) append(text_, true_tip_W ? *true_tip_W : Vector3::Zero());
    text_ += '\n';
    if (chunk_ && text_.size() > chunk_bytes) {
        chunk_(text_);
        text_.clear();
    }
}

}  // namespace trunnion
