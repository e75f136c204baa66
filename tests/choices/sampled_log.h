// A log of samples, written by hand: straight ways, each with its own distance a period.
#pragma once

#include <cmath>
#include <string>

#include "tests/choices/log_bench.h"

namespace trunnion::log_bench {

/// mm, machine coordinates.
using Place = std::array<double, 3>;

constexpr double feed_mm = 0.05, rapid_mm = 3.0;  ///< in a period

class SampledLog {
  public:
    explicit SampledLog(const Place& start) : at_(start) {
        log.path = "log.csv";
        log.axes = {Axis::X, Axis::Y, Axis::Z};
        log.blocks = records::BlockColumn::number;
        log.step = 1e-4;
    }
    void to(int block, const Place& end, double step_mm) {
        const double length = std::hypot(end[0] - at_[0], end[1] - at_[1], end[2] - at_[2]);
        double along = left_ * step_mm;
        for (; along <= length; along += step_mm) add(block, along / length, end);
        if (length > 0.0) left_ = (along - length) / step_mm;
        at_ = end;
    }
    const Place& at() const { return at_; }
    /// One row.
    void add(int block, const Place& end) {
        add(block, 1.0, end);
        at_ = end;
    }
    records::PositionLog log;

  private:
    void add(int block, double part, const Place& end) {
        records::LoggedPosition row;
        const Axis axes[] = {Axis::X, Axis::Y, Axis::Z};
        for (std::size_t k = 0; k < 3; ++k)
            row.at[axes[k]] = std::round(1e4 * (at_[k] + part * (end[k] - at_[k]))) / 1e4;
        row.block = block;
        row.line = static_cast<int>(log.rows.size()) + 2;
        log.rows.push_back(row);
    }
    Place at_;
    double left_ = 1.0;  ///< of a period, before the next sample
};

/// A three-axis mill with G54 at zero.
inline setup::Setup mill_of(const std::string& more = "") {
    return setup_of(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[control]\ndialect = "
        "\"fanuc\"\n" +
        more);
}

inline bool has_note(const choices::ControlGap& gap, const std::string& words) {
    return std::any_of(gap.notes.begin(), gap.notes.end(), [&](const std::string& note) {
        return note.find(words) != std::string::npos;
    });
}

}  // namespace trunnion::log_bench
