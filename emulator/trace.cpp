#include "emulator/trace.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include "base/numbers.h"
#include "positioning/rotary_transform.h"

namespace trunnion::emulator {
namespace {

constexpr std::size_t chunk_bytes = 1 << 16;
constexpr std::string_view motion_names[] = {"G0", "G1", "G2", "G3"};

constexpr std::ptrdiff_t integer_room = 24;

template <class Integer>
char* write_integer(char* out, Integer value) {
    return std::to_chars(out, out + integer_room, value).ptr;
}

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
    return cell + '"';
}

}  // namespace

BelievedTool believed_tool(const motion::AxisMove& move, const AxisPositions& q) {
    if (move.transform)
        return {move.transform->tip_W(q, move.tool_vector_mm), move.transform->tool_direction_W(q)};
    return {move.parallel.linear(q) - move.tool_vector_mm, Vector3::UnitZ()};
}

void TraceNumber::set(double value) {
    if (value == value_) return;
    value_ = value;
    const double shown = value == 0.0 ? 0.0 : value;  // no "-0"
    char* const end = std::to_chars(text_.data(), text_.data() + text_.size(), shown).ptr;
    size_ = static_cast<std::size_t>(end - text_.data());
}

void TraceNumber::set_angle(double angle_rad) {
    if (angle_rad == value_) return;
    value_ = angle_rad;
    size_ = shortest_degrees(angle_rad).copy(text_.data(), text_.size());
}

char* TraceNumber::write(char* out) const {
    *out = ',';
    std::memcpy(out + 1, text_.data(), text_.size());  // a fixed length compiles to one or two
                                                       // instructions
    return out + 1 + size_;
}

TraceWriter::TraceWriter(std::vector<Axis> axes, bool truth, TraceChunk chunk)
    : axes_(std::move(axes)), truth_(truth), chunk_(std::move(chunk)) {
    constexpr std::size_t feed = 1, tip = 6, way = 2, arc = 7, true_tip = 3;
    numbers_.resize(feed + axes_.size() + tip + way + arc + true_tip);
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

void TraceWriter::add_numbers(std::span<const TraceNumber> numbers) {
    std::array<char, 8 * TraceNumber::room> text;
    for (; !numbers.empty(); numbers = numbers.subspan(std::min<std::size_t>(8, numbers.size()))) {
        char* end = text.data();
        for (const TraceNumber& n : numbers.first(std::min<std::size_t>(8, numbers.size())))
            end = n.write(end);
        text_.append(text.data(), end);
    }
}

/// seq, program, line, motion, tool.
void TraceWriter::add_head(const motion::AxisMove& move, bool end) {
    const std::string_view name = move.program ? std::string_view(*move.program) : "";
    if (name != program_) {
        program_ = name;
        program_cell_ = csv_cell(program_);
    }
    std::array<char, 4 * integer_room> text;
    char* at = write_integer(text.data(), rows_++);
    *at++ = ',';
    text_.append(text.data(), at);
    text_ += program_cell_;
    at = text.data();
    *at++ = ',';
    at = write_integer(at, move.line);
    *at++ = ',';
    const std::string_view motion =
        end ? motion_names[static_cast<std::size_t>(move.kind)] : "SAMPLE";
    at += motion.copy(at, motion.size());
    *at++ = ',';
    at = write_integer(at, move.tool);
    text_.append(text.data(), at);
}

void TraceWriter::add(const motion::AxisMove& move, double s, double time_s, bool end,
                      const Vector3* true_tip_W) {
    const AxisPositions q = move.at(s);
    add_head(move, end);
    TraceNumber* next = numbers_.data();
    const auto set = [&next](const Vector3& v) {
        for (int i = 0; i < 3; ++i) (next++)->set(v[i]);
    };
    (next++)->set(move.feed_mm_min);
    for (const Axis axis : axes_)
        is_rotary(axis) ? (next++)->set_angle(q[axis]) : (next++)->set(q[axis]);
    const BelievedTool tool = believed_tool(move, q);
    set(tool.tip_W_mm);
    set(tool.direction_W);
    (next++)->set(move.length_mm * s);
    (next++)->set(time_s);
    add_numbers({numbers_.data(), next});
    if (move.arc) {
        TraceNumber* const arc = next;
        set(move.arc->centre_mm);
        set(move.arc->normal);
        (next++)->set(move.arc->turns);
        add_numbers({arc, next});
    } else {
        text_ += ",,,,,,,";
    }
    if (truth_) {
        TraceNumber* const truth = next = &numbers_[numbers_.size() - 3];
        set(true_tip_W ? *true_tip_W : Vector3::Zero());
        add_numbers({truth, next});
    }
    text_ += '\n';
    if (chunk_ && text_.size() > chunk_bytes) {
        chunk_(text_);
        text_.clear();
    }
}

}  // namespace trunnion::emulator
