// What a control does without an alarm and what is seldom meant: noted by a run, found by check.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace trunnion::controller {

enum class CautionKind : unsigned char {
    bare_words,    ///< numbers without a decimal point, 3401 not given
    unset_offset,  ///< H or D names an offset that nothing has set
    no_offset,     ///< G43 without any H, G41 without any D
    open_arc,      ///< the end of an arc is not on its circle, and 3410 compares nothing
    straight_arc   ///< G2 or G3 without R and centre: a straight line (3403#5 = 0)
};

struct Caution {
    CautionKind kind = CautionKind::bare_words;
    int line = 0;
    char letter = 0;  ///< of an offset
    int number = 0;
    double start_mm = 0.0, end_mm = 0.0;  ///< radii of an arc
};

/// The same for a reader of the block.
struct ToldCaution {
    const char* rule = "";  ///< of check
    std::string text;
    const char* remedy = "";
};
ToldCaution told(const Caution& caution);

/// Those of a run, each cause once.
class Cautions {
  public:
    void add(const Caution& caution);
    /// Those since the last call.
    std::vector<Caution> take() { return std::exchange(fresh_, {}); }
    /// One line for each kind.
    std::vector<std::string> notes() const;

  private:
    std::vector<Caution> all_, fresh_;
    std::set<std::pair<char, int>> offsets_;
    std::set<int> arc_lines_;
    bool straight_told_ = false;
    std::size_t more_ = 0;  ///< arcs and offsets beyond those kept
};

}  // namespace trunnion::controller
