// Writes plain NC blocks: absolute axis words in G54, lines, arcs, and codes between them.
#pragma once

#include <string>

#include "motion/motion.h"
#include "setup/program_language.h"

namespace trunnion::compensation {

class FlatProgram {
  public:
    /// `setup` must outlive the writer: its offsets and tool lengths are active when the program
    /// runs.
    FlatProgram(const setup::Setup& setup, int decimals);

    void m_code(int code);
    void dwell(double duration_s);
    /// Tool, spindle and length offset of the move.
    void prepare(const motion::AxisMove& move);
    /// A line to machine position `to` in `duration_s`; false when nothing moves.
    bool line(const motion::AxisMove& move, const AxisPositions& to, double duration_s);
    /// G31 to `to` with the feed of the move.
    bool skip(const motion::AxisMove& move, const AxisPositions& to);
    /// An arc in the plane whose normal is the + direction of axis `normal` (0 X, 1 Y, 2 Z); centre
    /// in machine coordinates, mm.
    void arc(const motion::AxisMove& move, const AxisPositions& to, int normal,
             bool counter_clockwise, const Vector3& centre_mm);
    /// Position reached by the words written so far, rounded to their decimals.
    const AxisPositions& position() const { return at_; }
    /// Line number of the last block in the text, from 1.
    int last_line() const { return lines_; }
    std::string take();

  private:
    std::string axis_words(const AxisPositions& to, bool all);
    std::string word(char letter, double value) const;
    std::string feed_words(const motion::AxisMove& move, bool rotary, double duration_s);
    bool moves(const AxisPositions& to) const;
    void block(const motion::AxisMove& move, const std::string& words);
    double offset(Axis axis) const;

    const setup::Setup& setup_;
    const setup::ProgramLanguage language_;
    int decimals_;
    AxisPositions at_;
    bool first_ = true;
    std::string text_, pending_, feed_, plane_ = "G17", motion_, feed_mode_ = "G94";
    std::size_t counted_ = 0;  ///< characters of the text already counted in lines_
    int lines_ = 2;            ///< including the two lines added by `take`
    int tool_ = 0, length_offset_ = 0;
    bool tool_change_ = false;
    double spindle_rpm_ = 0.0, length_mm_ = 0.0;
};

}  // namespace trunnion::compensation
