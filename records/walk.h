// The travel of each axis through the rows of a session: sides and reversal points (walk.cpp).
#pragma once

#include <span>
#include <vector>

#include "records/readings.h"
#include "records/travel.h"

namespace trunnion::records {

/// The rows whose samples are computed, and where these stand.
class Chosen {
  public:
    explicit Chosen(std::size_t all) : count_(all) {}
    /// Of `all` rows from row `begin` on, those of `list`.
    Chosen(std::size_t all, std::size_t begin, std::span<const std::size_t> list)
        : count_(list.size()), place_(all, no_place) {
        for (std::size_t i = 0; i < list.size(); ++i) place_[list[i] - begin] = i;
    }

    bool has(std::size_t row) const { return place_.empty() || place_[row] != no_place; }
    std::size_t place_of(std::size_t row) const { return place_.empty() ? row : place_[row]; }
    std::size_t count() const { return count_; }

  private:
    static constexpr std::size_t no_place = static_cast<std::size_t>(-1);
    std::size_t count_;
    std::vector<std::size_t> place_;  ///< empty: all rows
};

/// Samples of the chosen rows with what the history tells: travel, side, way since the reversal.
std::vector<AxisSample> walked(std::span<const Reading> rows, const TravelHistory& history,
                               const Chosen& chosen);

}  // namespace trunnion::records
