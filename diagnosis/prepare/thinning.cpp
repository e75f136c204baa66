#include "diagnosis/prepare/thinning.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "records/samples.h"

namespace trunnion::diagnosis {
namespace {

using records::Device;

/// One row in every 3 degrees of a turn is kept.
constexpr std::size_t least_of_pass = 120;

/// A device that reads all the time; the others are read once for each place by hand or program.
bool is_stream(Device device) {
    return device == Device::ballbar || device == Device::axis;
}

bool is_pass(Device device) {
    return is_stream(device) || device == Device::linear || device == Device::angle;
}

/// One row of how many is kept.
struct Steps {
    std::size_t streams = 1, places = 1;

    std::size_t of(Device device) const { return is_stream(device) ? streams : places; }
};

/// Places are rare and dear: up to half of `most`, or what streams leave, all of them stay.
Steps steps_for(const records::ReadingTable& table, std::size_t most) {
    std::size_t streams = 0, places = 0;
    for (const records::Reading& row : table.rows)
        if (row.device != Device::none) ++(is_stream(row.device) ? streams : places);
    const auto step = [](std::size_t rows, std::size_t room) {
        return rows == 0 ? 1 : (rows + room - 1) / std::max<std::size_t>(1, room);
    };
    Steps steps;
    steps.places = step(places, std::max(most / 2, most - std::min(most, streams)));
    steps.streams = step(streams, most - places / steps.places);
    return steps;
}

/// A reproducible pseudo-random index in 0..n-1.
std::size_t scattered(std::size_t stretch, std::size_t n) {
    return static_cast<std::size_t>(((stretch + 1) * std::uint64_t{0x9E3779B97F4A7C15}) >> 33) % n;
}

bool same_pose(const records::ReadingTable& table, const records::Reading& a,
               const records::Reading& b) {
    if (a.test != b.test || a.feature != b.feature) return false;
    return std::all_of(table.axes.begin(), table.axes.end(), [&](Axis axis) {
        return !table.names.is_rotary(axis) || a.commanded[axis] == b.commanded[axis];
    });
}

/// Tells the commanded motion of a row of a servo log: between fewer rows its differences are
/// others.
void tell_motion(const records::LoggedMotion& told, records::Reading& row) {
    if (!told.motion) return;
    if (!row.velocity_mm_s) row.velocity_mm_s = told.motion->x();
    if (!row.acceleration_mm_s2) row.acceleration_mm_s2 = told.motion->y();
    if (!row.smoothing) row.smoothing = told.smoothed;
}

class Thinner {
  public:
    /// `motion`: of the rows, if there are servo logs.
    Thinner(const records::ReadingTable& table, const Steps& steps,
            std::vector<records::LoggedMotion> motion)
        : table_(table), steps_(steps), motion_(std::move(motion)) {
        for (const records::Reading& row : table.rows)
            if (is_pass(row.device)) ++length_[row.test];
    }

    std::vector<records::Reading> rows(const TimeConstants& constants) {
        for (const records::Reading& row : table_.rows) {
            if (is_pass(row.device))
                add_of_pass(row);
            else if (row.device == Device::none)
                waiting_.push_back(row);
            else
                add_of_pose(row);
        }
        tell_samples(constants);
        return std::move(kept_);
    }

  private:
    void add_of_pass(const records::Reading& row) {
        const std::size_t count = seen_[row.test]++;
        const std::size_t step =
            std::clamp<std::size_t>(length_[row.test] / least_of_pass, 1, steps_.of(row.device));
        if (count > 0 && count % step != scattered(count / step, step)) {
            waiting_.clear();
            return;
        }
        keep(row);
    }

    void add_of_pose(const records::Reading& row) {
        if (!pose_ || !same_pose(table_, *pose_, row)) {
            ++poses_;
            if (poses_ % steps_.places != 0) waiting_.clear();
        }
        pose_ = &row;
        if (poses_ % steps_.places == 0) return keep(row);
        waiting_.push_back(row);
        waiting_.back().device = Device::none;
        waiting_.back().value_mm.reset();
    }

    void keep(const records::Reading& row) {
        kept_.insert(kept_.end(), waiting_.begin(), waiting_.end());
        waiting_.clear();
        kept_.push_back(row);
        if (!motion_.empty()) tell_motion(motion_[index_of(row)], kept_.back());
        if (!is_stream(row.device)) return;
        of_streams_.push_back(kept_.size() - 1);
        chosen_.push_back(index_of(row));
    }

    /// Rows of streams get the speeds and reversal points of the whole table: differences of rows
    /// that were chosen here and there are no speeds.
    void tell_samples(const TimeConstants& constants) {
        const std::vector<AxisSample> samples = records::samples_among(table_, chosen_, constants);
        for (std::size_t i = 0; i < samples.size(); ++i)
            kept_[of_streams_[i]].among_all = std::make_shared<const AxisSample>(samples[i]);
    }

    std::size_t index_of(const records::Reading& row) const {
        return static_cast<std::size_t>(&row - table_.rows.data());
    }

    const records::ReadingTable& table_;
    Steps steps_;
    std::vector<records::LoggedMotion> motion_;
    std::size_t poses_ = static_cast<std::size_t>(-1);
    const records::Reading* pose_ = nullptr;
    std::map<std::string, std::size_t> seen_, length_;  ///< rows of each pass: so far, in total
    std::vector<records::Reading> kept_, waiting_;
    std::vector<std::size_t> of_streams_, chosen_;  ///< rows of streams: among those kept, in all
};

bool has_log(const records::ReadingTable& table) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [](const records::Reading& row) { return row.device == Device::axis; });
}

}  // namespace

std::optional<records::ReadingTable> thinned(const records::ReadingTable& table, std::size_t most,
                                             const TimeConstants& constants) {
    std::size_t all = 0;
    for (const records::Reading& row : table.rows) {
        if (row.device == Device::none) continue;
        if (!row.value_mm) return std::nullopt;  // refused later in any case
        ++all;
    }
    if (all <= most) return std::nullopt;
    records::ReadingTable fewer;
    fewer.path = table.path;
    fewer.parts = table.parts;
    fewer.comment = table.comment;
    fewer.side_before = table.side_before;
    fewer.part_sides = table.part_sides;
    fewer.axes = table.axes;
    fewer.names = table.names;
    fewer.optional_columns = table.optional_columns;
    const Steps steps = steps_for(table, most);
    std::vector<records::LoggedMotion> motion;
    if (has_log(table)) motion = records::logged_motion(table, constants);
    fewer.rows = Thinner(table, steps, std::move(motion)).rows(constants);
    return fewer;
}

}  // namespace trunnion::diagnosis
