// Where two programs are written differently: the blocks that a difference may come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/describe.h"
#include "setup/setup.h"

namespace trunnion::regression {

/// A stretch of blocks written differently, by line; a side without blocks has the line that
/// follows, and count 0.
struct WrittenGap {
    int line_a = 0, line_b = 0;
    int last_a = 0, last_b = 0;
    std::uint64_t count_a = 0, count_b = 0;
};

/// A block that is a likely cause, and what it says otherwise.
struct WrittenCause {
    int line_a = 0, line_b = 0;
    std::string what;
};

/// The gaps of the layer `words` of two main programs. Nothing is looked for in texts beyond 16 MB:
/// there the time is worth more than the hint.
class WrittenGaps {
  public:
    WrittenGaps(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                const interpreter::ProgramText& b, const setup::Setup& setup_b);

    /// The last gap at or before these lines (0: that side says nothing), said in words.
    std::optional<WrittenCause> before(int line_a, int line_b);
    /// What the block at `line_a` of A (or at `line_b` of B, the other 0) says otherwise, where a
    /// block of the other side stands for it.
    std::optional<WrittenCause> at(int line_a, int line_b);
    /// One of these lines stands in a gap that only one side has.
    std::optional<WrittenCause> block_missing(int line_a, int line_b);
    /// The first gap with a block that writes a store or variable: G10, #.
    std::optional<WrittenCause> first_that_writes();

  private:
    void find_gaps();
    std::optional<WrittenCause> said(const WrittenGap& gap, int line_a, int line_b);
    std::optional<WrittenCause> pair(int line_a, int line_b);
    std::array<std::optional<double>, 3> start_of(int line_a);
    WrittenCause missing(const WrittenGap& gap);

    interpreter::ProgramText a_, b_;
    const setup::Setup &setup_a_, &setup_b_;
    ProgramLines lines_a_, lines_b_;
    std::optional<std::vector<WrittenGap>> gaps_;
};

}  // namespace trunnion::regression
