// The trace of a run as CSV: one row a programmed move, with samples along it on request.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motion/motion.h"

namespace trunnion::emulator {

/// Believed tip and unit vector from tip to spindle, in W, at machine positions q of a move.
struct BelievedTool {
    Vector3 tip_W_mm = Vector3::Zero();
    Vector3 direction_W = Vector3::UnitZ();
};
BelievedTool believed_tool(const motion::AxisMove& move, const AxisPositions& q);

/// Receives the trace piece by piece, in whole lines.
using TraceChunk = std::function<void(std::string_view)>;

/// A number with cached text, because most columns of a row repeat the previous value.
class TraceNumber {
  public:
    /// Formats the shortest text that reads back as the same double.
    void set(double value);
    /// The same, in degrees.
    void set_angle(double angle_rad);
    /// Appends ",number" at `out`, which must have `room` bytes; returns the end of the text.
    char* write(char* out) const;

    static constexpr std::size_t room = 33;

  private:
    double value_ = std::numeric_limits<double>::quiet_NaN();
    std::size_t size_ = 0;
    std::array<char, room - 1> text_{};
};

/// Columns: formats.md.
class TraceWriter {
  public:
    /// Without `chunk` the whole text is returned by `take`.
    TraceWriter(std::vector<Axis> axes, bool truth, TraceChunk chunk = {});

    /// A row at `s` of a move; `true_tip_W` only with truth. `end` false: a SAMPLE row.
    void add(const motion::AxisMove& move, double s, double time_s, bool end,
             const Vector3* true_tip_W);
    /// Text not yet passed to `chunk`.
    std::string take() { return std::move(text_); }

  private:
    void add_head(const motion::AxisMove& move, bool end);
    void add_numbers(std::span<const TraceNumber> numbers);

    std::vector<Axis> axes_;
    bool truth_ = false;
    TraceChunk chunk_;
    std::uint64_t rows_ = 0;
    std::string program_, program_cell_;  ///< of the latest row
    std::vector<TraceNumber> numbers_;    ///< values of the row, in the order of the columns
    std::string text_;
};

}  // namespace trunnion::emulator
