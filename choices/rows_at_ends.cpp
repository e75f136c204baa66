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
constexpr double most_cosine = 0.9;   ///< of a turn: a way back looks like a corner at a row anyhow
constexpr double shorter_step = 0.9;  ///< of the next one: part of it went to an end without a row
constexpr std::size_t least_passed = 2;  ///< ends without a row; one may be a last whole step
constexpr std::size_t passed_in = 4;     ///< one in so many ways back

class Corners {
  public:
    explicit Corners(const LogView& log) : log_(log), space_(log.axes) {}

    bool are_rows() const {
        std::size_t at_row = 0, between = 0, back = 0, passed = 0;
        for (std::size_t i = 2; i + 3 < log_.rows.size(); ++i) {
            if (turns(i, i) && is_straight(i - 1) && is_straight(i + 1))
                ++at_row;
            else if (turns(i, i + 1) && bends(i) && bends(i + 1) && is_straight(i - 1) &&
                     is_straight(i + 2))
                ++between;
            else if (goes_back(i)) {
                ++back;
                passed += passes_end(i) ? 1 : 0;
            }
        }
        if (passed >= least_passed && passed_in * passed >= back) between += passed;
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
    double step(std::size_t to) const {
        return std::sqrt(space_.square(log_.rows[to - 1].at, log_.rows[to].at));
    }
    /// Straight to this row, and the same way back.
    bool goes_back(std::size_t i) const {
        return cosine(i, i) < -most_cosine && is_straight(i - 1) && is_straight(i + 1) &&
               step(i - 1) > 0.0 && step(i + 2) > 0.0;
    }
    /// A whole step to the row, and less than one from there: the axes went on to an end that has
    /// no row, in the time of the next one. With a row at the end the step before it is the rest of
    /// the way, or those behind it are whole ones.
    bool passes_end(std::size_t i) const {
        return std::abs(step(i) - step(i - 1)) <= on_chord * step(i - 1) &&
               step(i + 1) < shorter_step * step(i + 2);
    }
    /// Neither nearly straight on nor nearly back, from the way to a row to the way from another.
    bool turns(std::size_t to, std::size_t from) const {
        return std::abs(cosine(to, from)) < most_cosine;
    }
    /// Of the angle from the way to a row to the way from another; 1 without a way.
    double cosine(std::size_t to, std::size_t from) const {
        const auto in = space_.apart(log_.rows[to].at, log_.rows[to - 1].at),
                   out = space_.apart(log_.rows[from + 1].at, log_.rows[from].at);
        const double lengths = std::sqrt(space_.square(in, {}) * space_.square(out, {}));
        if (lengths <= 0.0) return 1.0;
        double along = 0.0;
        for (const Axis axis : log_.axes) along += in[axis] * out[axis];
        return along / lengths;
    }

    const LogView& log_;
    Space space_;
};

}  // namespace

bool has_rows_at_ends(const LogView& log) {
    return !log.ends && Corners(log).are_rows();
}

}  // namespace trunnion::choices
