#include "diagnosis/fresh_readings.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "kinematics/forward.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t most_poses = 48, most_passes = 16, most_samples = 60;
constexpr double later = 1.3;  ///< time of the last fresh reading, in lengths of the session
constexpr double faster = 1.5;
constexpr double most_tilt_rad = 1.0;  ///< maximum tilt of the bar

/// The rows of one pose or pass in the table, with the preceding rows without device.
struct Visit {
    records::Device device = records::Device::none;
    std::vector<std::size_t> rows;
};

std::vector<Visit> visits_of(const records::ReadingTable& table, const emulator::Replay& replay,
                             const std::vector<NoiseBlock>& blocks) {
    std::vector<int> block_of(table.rows.size(), -1);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (const Eigen::Index i : blocks[b].rows)
            block_of[replay.table_row(static_cast<std::size_t>(i))] = static_cast<int>(b);
    std::vector<Visit> visits;
    std::vector<std::size_t> leading;
    int last = -1;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        leading.push_back(r);
        if (block_of[r] < 0) continue;
        if (block_of[r] != last || visits.empty()) visits.push_back({table.rows[r].device, {}});
        last = block_of[r];
        auto& rows = visits.back().rows;
        rows.insert(rows.end(), leading.begin(), leading.end());
        leading.clear();
    }
    return visits;
}

/// `most` of them in equal steps.
std::vector<Visit> some_of(const std::vector<Visit>& all, bool bar, std::size_t most) {
    std::vector<Visit> those, chosen;
    for (const Visit& v : all)
        if ((v.device == records::Device::ballbar) == bar) those.push_back(v);
    const std::size_t count = std::min(most, those.size());
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(those[k * those.size() / count]);
    return chosen;
}

/// Builds the table of fresh rows visit by visit.
class FreshTable {
  public:
    FreshTable(const setup::Setup& setup, const records::ReadingTable& table, std::uint64_t seed)
        : setup_(setup), table_(table), forward_(setup.machine), random_(seed) {
        fresh_.path = table.path;
        fresh_.parts = table.parts;
        fresh_.comment = table.comment;
        fresh_.axes = table.axes;
        fresh_.names = table.names;
        fresh_.optional_columns = table.optional_columns;
        start_s_ = table.rows.front().time_s;
        session_s_ = table.rows.back().time_s - start_s_;
    }

    /// Each rotary angle moves by its own fraction towards that of `other`.
    void add_pose(const Visit& visit, const Visit& other) {
        const AxisPositions here = table_.rows[visit.rows.back()].commanded;
        const AxisPositions there = table_.rows[other.rows.back()].commanded;
        AxisPositions turn;
        for (const Axis axis : table_.axes)
            if (table_.names.is_rotary(axis))
                turn[axis] = random_.uniform() * (there[axis] - here[axis]);
        const double begun_s = table_.rows[visit.rows.front()].time_s, now_s = any_time();
        for (const std::size_t r : visit.rows) {
            records::Reading row = table_.rows[r];
            row.time_s += now_s - begun_s;
            turn_about_feature(row, turn);
            fresh_.rows.push_back(std::move(row));
        }
    }

    /// The same path, sampled between the old samples, at another speed; with a moving rotary axis
    /// the bar is inclined.
    void add_pass(const Visit& visit) {
        const double speed = std::pow(faster, 2.0 * random_.uniform() - 1.0);
        const double part = random_.uniform();
        const std::size_t step = 1 + visit.rows.size() / most_samples;
        const Matrix3 tilt = turns(visit) ? any_tilt() : Matrix3(Matrix3::Identity());
        const double begun_s = table_.rows[visit.rows.front()].time_s, now_s = any_time();
        for (std::size_t k = 0; k + 1 < visit.rows.size(); k += step) {
            const records::Reading &a = table_.rows[visit.rows[k]],
                                   &b = table_.rows[visit.rows[k + 1]];
            records::Reading row = a;
            row.among_all.reset();  // another motion
            row.time_s = now_s + (a.time_s + part * (b.time_s - a.time_s) - begun_s) / speed;
            row.feed_mm_min *= speed;
            for (const Axis axis : table_.axes)
                row.commanded[axis] += part * (b.commanded[axis] - a.commanded[axis]);
            tilt_bar(row, tilt);
            fresh_.rows.push_back(std::move(row));
        }
    }

    records::ReadingTable done() { return std::move(fresh_); }

  private:
    double any_time() { return start_s_ + later * session_s_ * random_.uniform(); }

    bool turns(const Visit& visit) const {
        const AxisPositions first = table_.rows[visit.rows.front()].commanded;
        const AxisPositions last = table_.rows[visit.rows.back()].commanded;
        return std::any_of(table_.axes.begin(), table_.axes.end(), [&](Axis axis) {
            return table_.names.is_rotary(axis) && first[axis] != last[axis];
        });
    }

    Matrix3 any_tilt() {
        const Vector3 axis(random_.normal(), random_.normal(), random_.normal());
        return rotation_about(axis.normalized(), most_tilt_rad * (2.0 * random_.uniform() - 1.0));
    }

    /// The device's ball; without a probe (targets of a tracker, joints of an arm) the origin of S.
    Vector3 ball_S(const records::Reading& row) const {
        if (row.device == records::Device::ballbar) return setup_.ballbar->cup_S_mm;
        return setup_.probe ? setup_.probe->tip_S_mm : Vector3(Vector3::Zero());
    }

    /// Vector from the feature to the device's ball, in M.
    Vector3 apart(const records::Reading& row) const {
        const kinematics::MachinePose poses = forward_.poses(row.commanded);
        return poses.pose_MS * ball_S(row) - poses.pose_MW * center_W(row.feature);
    }

    Vector3 center_W(const std::string& feature) const {
        for (const setup::Artefact& a : setup_.artefacts)
            if (a.name == feature) return a.center_W_mm;
        return Vector3::Zero();
    }

    /// Moves the linear axes such that the device's ball moves by `way_M`.
    void shift(records::Reading& row, const Vector3& way_M) const {
        for (const bool of_work : {true, false}) {
            const auto& side = of_work ? setup_.machine.chain.work : setup_.machine.chain.tool;
            for (const kinematics::AxisGeometry& axis : side)
                if (const std::size_t k = index_of(axis.axis); k < 3 && is_letter(axis))
                    row.commanded[axis.axis] +=
                        (of_work ? -1.0 : 1.0) * way_M(static_cast<Eigen::Index>(k));
        }
    }

    void turn_about_feature(records::Reading& row, const AxisPositions& turn) const {
        const Vector3 before = apart(row);
        for (const Axis axis : table_.axes) row.commanded[axis] += turn[axis];
        shift(row, before - apart(row));
    }

    /// The bar rotated by `tilt`, as seen from the table.
    void tilt_bar(records::Reading& row, const Matrix3& tilt) const {
        const Matrix3 table = forward_.poses(row.commanded).pose_MW.rotation;
        const Vector3 bar = apart(row);
        shift(row, table * tilt * table.transpose() * bar - bar);
    }

    const setup::Setup& setup_;
    const records::ReadingTable& table_;
    kinematics::ForwardModel forward_;
    SeededNoise random_;
    records::ReadingTable fresh_;
    double start_s_ = 0.0, session_s_ = 0.0;
};

}  // namespace

FreshReadings::FreshReadings(const Prepared& prepared, std::uint64_t seed) {
    const identification::BaseModel& base = prepared.base;
    const std::vector<Visit> all = visits_of(prepared.table, prepared.replay, prepared.blocks);
    FreshTable fresh(base.setup, prepared.table, seed);
    const std::vector<Visit> poses = some_of(all, false, most_poses);
    SeededNoise random(seed + 1);
    for (const Visit& pose : poses)
        fresh.add_pose(
            pose,
            poses[static_cast<std::size_t>(random.uniform() * static_cast<double>(poses.size()))]);
    for (const Visit& pass : some_of(all, true, most_passes)) fresh.add_pass(pass);
    const records::ReadingTable rows = fresh.done();
    replay_.emplace(base.setup, rows);
    blocks_ = noise_blocks(*replay_, rows);
    const kinematics::ForwardModel forward(base.setup.machine);
    for (std::size_t i = 0; i < replay_->size(); ++i)
        gradient_.push_back(replay_->gradient(i, forward, {}));
    const identification::BaseColumns found = identification::base_columns(
        base.setup, *replay_, prepared.catalogue, base.setup.model.modelled, gradient_);
    base_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(replay_->size()), base.columns.cols());
    for (std::size_t j = 0; j < base.parameters.size(); ++j)
        for (std::size_t k = 0; k < found.parameters.size(); ++k)
            if (identification::full_name(found.parameters[k]) ==
                identification::full_name(base.parameters[j]))
                base_.col(static_cast<Eigen::Index>(j)) =
                    found.columns.col(static_cast<Eigen::Index>(k));
    base_ = Eigen::MatrixXd(base_ * base.steps);
}

}  // namespace trunnion::diagnosis
