#include "identification/start_pose.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

namespace trunnion::identification {
namespace {

/// A row of a point: value = along . (measured - commanded), mm.
struct Coordinate {
    Vector3 along, commanded_mm;
    double value_mm;
};

/// Commanded points and what was measured of them, one column each.
struct Points {
    Eigen::Matrix3Xd commanded_mm, measured_mm;
};

bool reads(const emulator::Replay& replay, std::size_t row, std::size_t session, int instrument) {
    const emulator::Contact& contact = replay.contact(row);
    return contact.device == records::Device::point && contact.instrument == instrument &&
           replay.session(row) == session;
}

/// The coordinates that one instrument read in one session, point after point.
std::vector<std::vector<Coordinate>> coordinates_of(const emulator::Replay& replay,
                                                    const records::ReadingTable& table,
                                                    std::size_t session, int instrument) {
    constexpr double same_direction = 0.5;  // cosine
    std::vector<std::vector<Coordinate>> points;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const auto& value_mm = table.rows[replay.table_row(i)].value_mm;
        if (!value_mm || !reads(replay, i, session, instrument)) continue;
        const emulator::Contact& contact = replay.contact(i);
        const Coordinate now{contact.direction_I, contact.commanded_I_mm, *value_mm};
        const auto again = [&](const Coordinate& c) {
            return c.commanded_mm != now.commanded_mm ||
                   std::abs(c.along.dot(now.along)) > same_direction;
        };
        if (points.empty() || std::any_of(points.back().begin(), points.back().end(), again))
            points.emplace_back();
        points.back().push_back(now);
    }
    return points;
}

Points points_of(const std::vector<std::vector<Coordinate>>& list) {
    const auto count = static_cast<Eigen::Index>(list.size());
    Points points{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
    for (Eigen::Index k = 0; k < count; ++k) {
        const std::vector<Coordinate>& point = list[static_cast<std::size_t>(k)];
        points.commanded_mm.col(k) = points.measured_mm.col(k) = point.front().commanded_mm;
        for (const Coordinate& c : point) points.measured_mm.col(k) += c.value_mm * c.along;
    }
    return points;
}

/// True for points that fix no rotation: few, or all near one line.
bool fix_no_turn(const Eigen::Matrix3Xd& points) {
    constexpr double wide = 0.01;  // across the line, of the length
    if (points.cols() < 3) return true;
    const Eigen::Matrix3Xd about = points.colwise() - points.rowwise().mean();
    const auto size = Eigen::JacobiSVD<Eigen::Matrix3d>(about * about.transpose()).singularValues();
    return size(1) <= wide * wide * size(0);
}

double misfit(const std::vector<std::vector<Coordinate>>& list, const SmallMotion& pose) {
    const Matrix3 turn = rotation_of(pose.tilt_rad);
    double sum = 0.0;
    for (const std::vector<Coordinate>& point : list)
        for (const Coordinate& c : point) {
            const Vector3 moved_mm = pose.shift_mm + turn * c.commanded_mm - c.commanded_mm;
            sum += std::pow(c.value_mm - c.along.dot(moved_mm), 2);
        }
    return sum;
}

/// The pose error at which the fit of one instrument in one session starts.
SmallMotion start_of(const std::vector<std::vector<Coordinate>>& list,
                     const SmallMotion& declared) {
    const Points points = points_of(list);
    if (fix_no_turn(points.commanded_mm)) return declared;
    const Eigen::Matrix4d onto = Eigen::umeyama(points.commanded_mm, points.measured_mm, false);
    const Eigen::AngleAxisd turn(Matrix3(onto.topLeftCorner<3, 3>()));
    const SmallMotion found{onto.topRightCorner<3, 1>(), turn.angle() * turn.axis()};
    const Eigen::AngleAxisd further(rotation_of(found.tilt_rad) *
                                    rotation_of(declared.tilt_rad).transpose());
    if (further.angle() < pose_is_near_rad || misfit(list, found) >= misfit(list, declared))
        return declared;
    return found;
}

/// Stores it where the fit of that session starts.
void begin_at(setup::Setup& setup, const std::string& session, std::size_t instrument,
              const SmallMotion& pose) {
    setup::Instrument& declared = setup.instruments[instrument];
    if (session.empty()) {
        declared.pose_error = pose;
        return;
    }
    auto at = std::find_if(setup.sessions.begin(), setup.sessions.end(),
                           [&](const setup::SessionValues& s) { return s.name == session; });
    if (at == setup.sessions.end()) at = setup.sessions.insert(at, {session, {}});
    for (int k = 0; k < 3; ++k) {
        at->values[declared.name + '.' + "xyz"[k] + "_mm"] = pose.shift_mm(k);
        at->values[declared.name + '.' + "abc"[k] + "_rad"] = pose.tilt_rad(k);
    }
}

}  // namespace

setup::Setup with_start_poses(setup::Setup setup, const records::ReadingTable& table) {
    const auto free = [](const setup::Instrument& i) { return i.free_pose; };
    const auto point = [](const records::Reading& r) { return r.device == records::Device::point; };
    if (std::none_of(setup.instruments.begin(), setup.instruments.end(), free) ||
        std::none_of(table.rows.begin(), table.rows.end(), point))
        return setup;
    const emulator::Replay replay(setup, table);
    for (std::size_t s = 0; s < replay.sessions().size(); ++s)
        for (std::size_t k = 0; k < setup.instruments.size(); ++k) {
            if (!setup.instruments[k].free_pose) continue;
            const SmallMotion declared = replay.setup_of(s).instruments[k].pose_error;
            const auto list = coordinates_of(replay, table, s, static_cast<int>(k));
            if (list.empty()) continue;
            const SmallMotion start = start_of(list, declared);
            if (start.tilt_rad != declared.tilt_rad)
                begin_at(setup, replay.sessions()[s], k, start);
        }
    return setup;
}

}  // namespace trunnion::identification
