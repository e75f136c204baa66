#include "choices/rows_at_ends.h"

#include <algorithm>
#include <cmath>

#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t least_corners = 5;
constexpr std::size_t most_beside = 20;  ///< corners at a row for one that stands between two
constexpr double on_chord = 0.02;        ///< of the shorter distance: on a straight way
constexpr double off_chord = 0.1;        ///< and off it
constexpr double most_cosine = 0.9;  ///< of a turn: a way back looks like a corner at a row anyhow

class Corners {
  public:
    explicit Corners(const LogView& log) : log_(log), space_(log.axes) {}

    bool are_rows() const {
        std::size_t at_row = 0, between = 0;
        for (std::size_t i = 2; i + 3 < log_.rows.size(); ++i) {
            if (turns(i, i) && is_straight(i - 1) && is_straight(i + 1))
                ++at_row;
            else if (turns(i, i + 1) && bends(i) && bends(i + 1) && is_straight(i - 1) &&
                     is_straight(i + 2))
                ++between;
        }
        return at_row >= least_corners && at_row >= most_beside * between;
    }

  private:
    /// Square of a row's distance from its neighbours' chord, in shorter distances to them.
    double off(std::size_t i) const {
        const auto &a = log_.rows[i - 1].at, &here = log_.rows[i].at, &b = log_.rows[i + 1].at;
        const double shorter = std::min(space_.square(a, here), space_.square(here, b));
        if (shorter <= 0.0) return 0.0;
        return space_.square(space_.between(a, b, space_.nearest(a, b, here)), here) / shorter;
    }
    bool is_straight(std::size_t i) const { return off(i) <= on_chord * on_chord; }
    bool bends(std::size_t i) const { return off(i) > off_chord * off_chord; }
    /// Neither nearly straight on nor nearly back, from the way to a row to the way from another.
    bool turns(std::size_t to, std::size_t from) const {
        const auto in = space_.apart(log_.rows[to].at, log_.rows[to - 1].at),
                   out = space_.apart(log_.rows[from + 1].at, log_.rows[from].at);
        const double lengths = std::sqrt(space_.square(in, {}) * space_.square(out, {}));
        if (lengths <= 0.0) return false;
        double along = 0.0;
        for (const Axis axis : log_.axes) along += in[axis] * out[axis];
        return std::abs(along) < most_cosine * lengths;
    }

    const LogView& log_;
    Space space_;
};

}  // namespace

bool has_rows_at_ends(const LogView& log) {
    return !log.ends && Corners(log).are_rows();
}

}  // namespace trunnion::choices
