// Textual differences of two programs: the blocks that may cause a difference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/describe.h"
#include "setup/setup.h"

namespace trunnion::regression {

/// A range of differently written blocks, by line. A side without blocks has the following line,
/// and count 0.
struct WrittenGap {
    int line_a = 0, line_b = 0;
    int last_a = 0, last_b = 0;
    std::uint64_t count_a = 0, count_b = 0;
};

/// A block that is a likely cause, and its difference in words.
struct WrittenCause {
    int line_a = 0, line_b = 0;
    std::string what;
    std::string name = {};  ///< what several blocks have in common: "decimal point lost"
};

/// The gaps of the layer `words` of two main programs. Texts beyond 16 MB are not searched, because
/// the hint is not worth the time.
class WrittenGaps {
  public:
    WrittenGaps(const interpreter::ProgramText& a, const setup::Setup& setup_a,
                const interpreter::ProgramText& b, const setup::Setup& setup_b);

    /// The last gap at or before these lines (0: unknown on that side), in words.
    std::optional<WrittenCause> before(int line_a, int line_b);
    /// The difference of the block at `line_a` of A (or at `line_b` of B, the other 0), if a block
    /// of the other side corresponds to it.
    std::optional<WrittenCause> at(int line_a, int line_b);
    /// A gap on one side only that contains one of these lines.
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
