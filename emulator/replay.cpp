#include "emulator/replay.h"

#include <algorithm>
#include <cmath>

#include "base/alarm.h"

namespace trunnion {
namespace {

struct Place {
    const Setup& setup;
    const ReadingTable& table;
    [[noreturn]] void refuse(const Reading& row, const std::string& message) const {
        throw InputError(message + " (setup " + setup.path + ")", place_of(table, row));
    }
};

int artefact_index(const Place& place, const Reading& row) {
    const auto& artefacts = place.setup.artefacts;
    for (std::size_t k = 0; k < artefacts.size(); ++k)
        if (artefacts[k].name == row.feature) return static_cast<int>(k);
    place.refuse(row, "the setup has no artefact named '" + row.feature + "'");
}

int touches_of(const ReadingTable& table) {
    const auto it = table.comment.find("touches");
    return it == table.comment.end() ? 0 : std::atoi(it->second.c_str());
}

/// Second derivative of one axis at row k of its test, from up to five rows around it.
double acceleration_at(const ReadingTable& table, const std::vector<std::size_t>& rows,
                       std::size_t k, Axis axis) {
    const std::size_t n = rows.size();
    if (n < 5) return 0.0;
    const std::size_t first = k < 2 ? 0 : std::min(k - 2, n - 5);
    Eigen::Matrix<double, 5, 3> a;
    Eigen::Matrix<double, 5, 1> q;
    const double t0 = table.rows[rows[k]].time_s;
    for (std::size_t j = 0; j < 5; ++j) {
        const Reading& row = table.rows[rows[first + j]];
        const double t = row.time_s - t0;
        a.row(static_cast<Eigen::Index>(j)) << 1.0, t, 0.5 * t * t;
        q(static_cast<Eigen::Index>(j)) = row.commanded[axis] - table.rows[rows[k]].commanded[axis];
    }
    const Eigen::Matrix3d normal = a.transpose() * a;
    const Vector3 fit = normal.ldlt().solve(a.transpose() * q);
    return std::isfinite(fit(2)) ? fit(2) : 0.0;
}

Vector3 linear_position(const Reading& row) {
    return {row.commanded[Axis::X], row.commanded[Axis::Y], row.commanded[Axis::Z]};
}

/// Length of the path from row k - 1 to row k of a test: the arc through three rows, not the chord.
double arc_mm(const ReadingTable& table, const std::vector<std::size_t>& rows, std::size_t k) {
    const Vector3 a = linear_position(table.rows[rows[k - 1]]);
    const Vector3 b = linear_position(table.rows[rows[k]]);
    const double chord = (b - a).norm();
    if (rows.size() < 3) return chord;
    const Vector3 c = linear_position(table.rows[rows[k + 1 < rows.size() ? k + 1 : k - 2]]);
    const double area = (b - a).cross(c - a).norm();
    if (area < 1e-9) return chord;
    const double radius = chord * (c - a).norm() * (c - b).norm() / (2.0 * area);
    return chord < 1.4 * radius ? 2.0 * radius * std::asin(chord / (2.0 * radius)) : chord;
}

Vector3 shift_of(const ExtensionErrors& errors, const Contact& contact) {
    const auto it = errors.find(contact.extension_mm);
    return it == errors.end() ? Vector3(Vector3::Zero()) : it->second;
}

}  // namespace

Replay::Replay(const Setup& setup, const ReadingTable& table) : setup_(setup) {
    for (const AxisGeometry& axis : setup.machine.chain.axes())
        if (std::find(table.axes.begin(), table.axes.end(), axis.axis) == table.axes.end())
            throw InputError(std::string("no column for axis ") + letter_of(axis.axis) +
                                 " of the setup's machine: readings of another machine?",
                             {table.path, 0, 0});
    const Place where{setup, table};
    for (const Axis axis : table.axes) {
        if (setup.machine.chain.find(axis)) continue;
        for (const Reading& row : table.rows)
            if (row.commanded[axis] != 0.0)
                where.refuse(row, std::string("axis ") + letter_of(axis) +
                                      " moves, but the setup's machine has no such axis");
    }
    const std::vector<AxisSample> all = samples_of(table);
    const ForwardModel model(setup.machine);
    const int touches = touches_of(table);
    std::map<std::string, std::vector<std::size_t>> tests;
    std::vector<std::size_t> place(table.rows.size());
    std::vector<double> path_mm(table.rows.size(), 0.0);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        auto& rows = tests[table.rows[r].test];
        place[r] = rows.size();
        rows.push_back(r);
    }
    for (const auto& [test, rows] : tests)
        for (std::size_t k = 1; k < rows.size(); ++k)
            path_mm[rows[k]] = path_mm[rows[k - 1]] + arc_mm(table, rows, k);
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const Reading& row = table.rows[r];
        if (row.device == Device::none) continue;
        if (row.device > Device::ballbar)
            where.refuse(row,
                         "no prediction for device '" + std::string(name_of(row.device)) + "'");
        AxisSample sample = all[r];
        Contact contact;
        contact.device = row.device;
        contact.artefact = artefact_index(where, row);
        contact.direction_M = row.direction_M;
        contact.extension_mm = row.extension_mm;
        contact.path_mm = path_mm[r];
        if (row.device == Device::ballbar) {
            if (!setup.ballbar) where.refuse(row, "a ballbar row, but no [ballbar] in the setup");
            for (const Axis axis : table.axes)
                contact.acceleration[axis] =
                    acceleration_at(table, tests[row.test], place[r], axis);
        } else if (!setup.probe) {
            where.refuse(row, "a probe row, but no [probe] in the setup");
        }
        const auto& artefact = setup.artefacts[static_cast<std::size_t>(contact.artefact)];
        if (row.device != Device::ballbar && artefact.kind != Artefact::Kind::sphere)
            where.refuse(row, "a probe row on '" + artefact.name + "', which is no sphere");
        const MachinePose poses = model.poses(row.commanded, row.spindle_rad);
        if (row.device == Device::ballbar)
            contact.direction_M = (poses.pose_MW * artefact.center_W_mm -
                                   poses.pose_MS * setup.ballbar->cup_with(row.extension_mm))
                                      .normalized();
        if (row.device == Device::sphere) {
            contact.touches = touches;
            for (const Axis axis : all_axes)
                if (!is_rotary(axis)) sample.travel[index_of(axis)] = 0;
        }
        contact.direction_W = poses.pose_MW.rotation.transpose() * contact.direction_M;
        rows_.push_back(r);
        samples_.push_back(sample);
        contacts_.push_back(contact);
    }
}

double Replay::read(std::size_t i, const ForwardModel& model, const ReplayOffsets& offsets,
                    const Perturbation& extra) const {
    const Contact& contact = contacts_[i];
    const auto a = static_cast<std::size_t>(contact.artefact);
    const MachinePose poses = model.poses(samples_[i].position, extra, spindle_angle(samples_[i]));
    Vector3 center_W = setup_.artefacts[a].center_W_mm + extra.work_shift_mm;
    if (a < offsets.artefact_W.size()) center_W += offsets.artefact_W[a];
    const Vector3 center_M = poses.pose_MW * center_W;
    if (contact.device == Device::ballbar) {
        const Vector3 cup_S = setup_.ballbar->cup_with(contact.extension_mm) + offsets.cup_S +
                              shift_of(offsets.long_cup_S, contact) + extra.tip_shift_mm;
        return (center_M - poses.pose_MS * cup_S).norm() - setup_.ballbar->warm_length_mm() -
               offsets.length + extra.reading_mm;
    }
    const Vector3 tip_S = setup_.probe->tip_with(contact.extension_mm) +
                          shift_of(offsets.stylus_S, contact) + extra.tip_shift_mm;
    const Vector3 tip_M = poses.pose_MS * tip_S;
    const Vector3 away = tip_M - center_M;
    const double along = away.dot(contact.direction_M);
    if (contact.device == Device::sphere) return -along + extra.reading_mm;
    const double reach = 0.5 * (setup_.artefacts[a].diameter_mm + setup_.probe->ball_diameter_mm);
    const double inside = along * along - away.squaredNorm() + reach * reach;
    return -along - std::sqrt(std::max(0.0, inside)) + extra.reading_mm;
}

std::vector<double> Replay::predict(const Machine& machine, const ReplayOffsets& offsets,
                                    const EffectModels& models) const {
    const ForwardModel model(machine);
    std::vector<double> value_mm(size());
    for (std::size_t i = 0; i < size(); ++i) {
        Perturbation extra;
        for (const auto& effect : models) effect->perturb(samples_[i], contacts_[i], extra);
        value_mm[i] = read(i, model, offsets, extra);
    }
    return value_mm;
}

std::vector<double> Replay::predict(const EffectModels& models) const {
    return predict(setup_.machine, {}, models);
}

Perturbation Replay::gradient(std::size_t i, const ForwardModel& model,
                              const ReplayOffsets& offsets) const {
    constexpr double shift_mm = 1e-3, turn_rad = 1e-5;
    Perturbation at, result;
    const auto slope = [&](double& entry, double step) {
        entry = step;
        const double plus = read(i, model, offsets, at);
        entry = -step;
        const double minus = read(i, model, offsets, at);
        entry = 0.0;
        return (plus - minus) / (2.0 * step);
    };
    for (const auto* side : {&setup_.machine.chain.work, &setup_.machine.chain.tool})
        for (const AxisGeometry& axis : *side) {
            const std::size_t k = index_of(axis.axis);
            result.axis.value[k] = slope(at.axis.value[k], axis.rotary ? turn_rad : shift_mm);
            for (int j = 0; j < 3; ++j) {
                result.motion[k].shift_mm(j) = slope(at.motion[k].shift_mm(j), shift_mm);
                result.motion[k].tilt_rad(j) = slope(at.motion[k].tilt_rad(j), turn_rad);
            }
        }
    for (int j = 0; j < 3; ++j) {
        result.tip_shift_mm(j) = slope(at.tip_shift_mm(j), shift_mm);
        result.work_shift_mm(j) = slope(at.work_shift_mm(j), shift_mm);
    }
    result.reading_mm = 1.0;
    return result;
}

double dot(const Perturbation& gradient, const Perturbation& delta) {
    // Component by component: independent sums that a processor adds side by side.
    Vector3 sum = gradient.tip_shift_mm.cwiseProduct(delta.tip_shift_mm);
    Vector3 tilts = gradient.work_shift_mm.cwiseProduct(delta.work_shift_mm);
    double axes = gradient.reading_mm * delta.reading_mm;
    for (std::size_t k = 0; k < axis_count; ++k) {
        axes += gradient.axis.value[k] * delta.axis.value[k];
        sum += gradient.motion[k].shift_mm.cwiseProduct(delta.motion[k].shift_mm);
        tilts += gradient.motion[k].tilt_rad.cwiseProduct(delta.motion[k].tilt_rad);
    }
    return axes + (sum + tilts).sum();
}

ReadingTable predicted(const Setup& setup, const ReadingTable& table, const EffectModels& models) {
    const Replay replay(setup, table);
    const std::vector<double> value_mm = replay.predict(models);
    ReadingTable result = table;
    for (std::size_t i = 0; i < replay.size(); ++i)
        result.rows[replay.table_row(i)].value_mm = value_mm[i];
    return result;
}

}  // namespace trunnion
