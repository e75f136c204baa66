#include "emulator/replay.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <tuple>

#include "base/alarm.h"
#include "emulator/declared.h"
#include "records/samples.h"

namespace trunnion::emulator {
namespace {

[[noreturn]] void refuse(const setup::Setup& setup, const records::ReadingTable& table,
                         const records::Reading& row, const std::string& message) {
    throw InputError(message + " (setup " + setup.path + ")", records::place_of(table, row));
}

void check_axes(const setup::Setup& setup, const records::ReadingTable& table) {
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (std::find(table.axes.begin(), table.axes.end(), axis.axis) == table.axes.end())
            throw InputError("no column for axis " + axis.name +
                                 " of the setup's machine: readings of another machine?",
                             {table.path, 0, 0});
    for (const Axis axis : table.axes) {
        if (setup.machine.chain.find(axis)) continue;
        for (const records::Reading& row : table.rows)
            if (row.commanded[axis] != 0.0)
                refuse(setup, table, row,
                       "axis " + table.names[axis] +
                           " moves, but the setup's machine has no such axis");
    }
}

int touches_of(const records::ReadingTable& table) {
    const auto it = table.comment.find("touches");
    return it == table.comment.end() ? 0 : std::atoi(it->second.c_str());
}

const ReplayOffsets& of_session(const ReplayOffsets& offsets, std::size_t session) {
    return session == 0 || session > offsets.later_sessions.size()
               ? offsets
               : offsets.later_sessions[session - 1];
}

bool turns(const kinematics::Chain& chain, Axis axis) {
    const kinematics::AxisGeometry* geometry = chain.find(axis);
    return geometry && geometry->rotary;
}

}  // namespace

DeviceRow device_row(const Observer& observer, const records::Reading& row,
                     const AxisSample& sample, int touches) {
    DeviceRow ready{sample, contact_of(observer.setup(), observer.nominal(sample), row)};
    const kinematics::Chain& chain = observer.setup().machine.chain;
    for (const Axis axis : all_axes)
        if (row.device == records::Device::sphere && !turns(chain, axis)) {
            ready.sample.travel[index_of(axis)] = 0;
            ready.sample.side_unknown[index_of(axis)] = false;
        } else if (ready.sample.side_unknown[index_of(axis)]) {
            ready.sample.travel[index_of(axis)] = 1;
        }
    if (row.device == records::Device::sphere) ready.contact.touches = touches;
    return ready;
}

Replay::Replay(const setup::Setup& setup, const records::ReadingTable& table) : setup_(setup) {
    check_axes(setup, table);
    samples_ = records::samples_of(table, setup.time_constant_s);  // of all rows at first
    list_sessions(table);
    const int touches = touches_of(table);
    contacts_.reserve(session_.size());
    std::deque<Observer> observers;
    for (std::size_t k = 0; k < sessions_.size(); ++k)
        observers.emplace_back(setup_of(k), EffectModels());
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        const records::Reading& row = table.rows[r];
        if (row.device == records::Device::none) continue;
        const Observer& nominal = observers[session_[rows_.size()]];
        try {
            DeviceRow ready = device_row(nominal, row, samples_[r], touches);
            if (row.device == records::Device::touch)
                nominal.go_to_contact(ready.sample, ready.contact);
            samples_[rows_.size()] = ready.sample;
            rows_.push_back(r);
            contacts_.push_back(ready.contact);
            commanded_.push_back(row.commanded);
        } catch (const InputError& error) {
            refuse(setup, table, row, error.message);
        }
    }
    samples_.resize(rows_.size());
    list_unknown_sides(table);
    list_zeros(table);
}

const setup::Setup& Replay::setup_of(std::size_t session) const {
    const auto at = own_.find(session);
    return at == own_.end() ? setup_ : at->second;
}

void Replay::list_sessions(const records::ReadingTable& table) {
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none) continue;
        const auto it = std::find(sessions_.begin(), sessions_.end(), row.session);
        session_.push_back(static_cast<std::size_t>(it - sessions_.begin()));
        if (it == sessions_.end()) sessions_.push_back(row.session);
    }
    for (std::size_t k = 0; k < sessions_.size(); ++k)
        if (setup_.find_session(sessions_[k])) own_.emplace(k, setup_.in_session(sessions_[k]));
}

void Replay::list_zeros(const records::ReadingTable& table) {
    std::map<std::tuple<int, std::string, std::string, records::Device>, std::size_t> known;
    for (std::size_t i = 0; i < size(); ++i) {
        const records::Reading& row = table.rows[rows_[i]];
        if (row.device != records::Device::linear && row.device != records::Device::angle) continue;
        const auto [at, added] =
            known.try_emplace({row.part, row.session, row.test, row.device}, zeros_.size());
        if (added) zeros_.push_back({row.test, row.session, row.angular, {}});
        zeros_[at->second].rows.push_back(i);
        contacts_[i].zero = static_cast<int>(at->second);
    }
}

void Replay::list_unknown_sides(const records::ReadingTable& table) {
    std::map<std::tuple<int, std::string, Axis>, std::size_t> known;
    for (std::size_t i = 0; i < size(); ++i)
        for (const Axis axis : table.axes) {
            if (!samples_[i].side_unknown[index_of(axis)]) continue;
            const records::Reading& row = table.rows[rows_[i]];
            const auto [at, added] =
                known.try_emplace({row.part, row.session, axis}, unknown_.size());
            if (added) unknown_.push_back({axis, {}, 1});
            unknown_[at->second].rows.push_back(i);
        }
}

void Replay::assume_side(std::size_t k, signed char side) {
    for (const std::size_t i : unknown_[k].rows)
        samples_[i].travel[index_of(unknown_[k].axis)] = side;
    unknown_[k].taken = side;
}

double Replay::read(std::size_t i, const kinematics::ForwardModel& model,
                    const ReplayOffsets& offsets, const kinematics::Perturbation& extra) const {
    const PhysicalState state{model.poses(samples_[i].position, extra, spindle_angle(samples_[i])),
                              extra};
    return reading_mm(
        {setup_of(session_[i]), of_session(offsets, session_[i]), contacts_[i], state});
}

std::vector<double> Replay::predict(const kinematics::Machine& machine,
                                    const ReplayOffsets& offsets,
                                    const EffectModels& models) const {
    std::deque<Observer> observers;  // a deque, because an observer cannot be moved
    for (std::size_t k = 0; k < std::max<std::size_t>(1, sessions_.size()); ++k)
        observers.emplace_back(setup_of(k), machine, models, of_session(offsets, k));
    std::vector<double> value_mm(size());
    for (std::size_t i = 0; i < size(); ++i) {
        AxisSample sample = samples_[i];
        Contact contact = contacts_[i];
        sample.position = commanded_[i];
        contact.along_mm = 0.0;
        value_mm[i] = observers[session_[i]].read(sample, contact);
    }
    for (std::size_t k = 0; k < zeros_.size(); ++k) {
        const double added = k < offsets.zeros.size() ? offsets.zeros[k] : 0.0;
        const double zero = value_mm[zeros_[k].rows.front()] - added;
        for (const std::size_t i : zeros_[k].rows) value_mm[i] -= zero;
    }
    return value_mm;
}

std::vector<double> Replay::predict(const EffectModels& models) const {
    return predict(setup_.machine, {}, models);
}

kinematics::Perturbation Replay::gradient(std::size_t i, const kinematics::ForwardModel& model,
                                          const ReplayOffsets& offsets) const {
    constexpr double shift_mm = 1e-3, turn_rad = 1e-5;
    kinematics::Perturbation at, result;
    const auto slope = [&](double& entry, double step) {
        entry = step;
        const double plus = read(i, model, offsets, at);
        entry = -step;
        const double minus = read(i, model, offsets, at);
        entry = 0.0;
        return (plus - minus) / (2.0 * step);
    };
    for (const auto* side : {&setup_.machine.chain.work, &setup_.machine.chain.tool})
        for (const kinematics::AxisGeometry& axis : *side) {
            const std::size_t k = index_of(axis.axis);
            result.axis.value[k] = slope(at.axis.value[k], axis.rotary ? turn_rad : shift_mm);
            for (int j = 0; j < 3; ++j) {
                result.motion[k].shift_mm(j) = slope(at.motion[k].shift_mm(j), shift_mm);
                result.motion[k].tilt_rad(j) = slope(at.motion[k].tilt_rad(j), turn_rad);
            }
        }
    // No axis moves by a shift of the tool or the artefact.
    PhysicalState state{model.poses(samples_[i].position, at, spindle_angle(samples_[i])), at};
    const InstrumentView view{setup_of(session_[i]), of_session(offsets, session_[i]), contacts_[i],
                              state};
    const auto shift_slope = [&](double& entry) {
        entry = shift_mm;
        const double plus = reading_mm(view);
        entry = -shift_mm;
        const double minus = reading_mm(view);
        entry = 0.0;
        return (plus - minus) / (2.0 * shift_mm);
    };
    for (int j = 0; j < 3; ++j) {
        result.tip_shift_mm(j) = shift_slope(state.extra.tip_shift_mm(j));
        result.work_shift_mm(j) = shift_slope(state.extra.work_shift_mm(j));
    }
    result.reading_mm = 1.0;
    return result;
}

namespace {

/// True where every entry is +0.
bool is_still(const SmallMotion& motion) {
    using Pair [[gnu::vector_size(2 * sizeof(std::uint64_t))]] = std::uint64_t;
    Pair parts[3];
    static_assert(sizeof parts == sizeof motion);
    std::memcpy(parts, &motion, sizeof parts);
    const Pair any = parts[0] | parts[1] | parts[2];
    return (any[0] | any[1]) == 0;
}

}  // namespace

double dot(const kinematics::Perturbation& gradient, const kinematics::Perturbation& delta) {
    // Component by component: independent sums that vectorise. Most effects move one axis: what
    // stands still adds nothing, and its derivatives need not come from memory.
    Vector3 sum = gradient.tip_shift_mm.cwiseProduct(delta.tip_shift_mm);
    Vector3 tilts = gradient.work_shift_mm.cwiseProduct(delta.work_shift_mm);
    double axes = gradient.reading_mm * delta.reading_mm;
    for (std::size_t k = 0; k < axis_count; ++k) {
        if (delta.axis.value[k] != 0.0) axes += gradient.axis.value[k] * delta.axis.value[k];
        if (is_still(delta.motion[k])) continue;
        sum += gradient.motion[k].shift_mm.cwiseProduct(delta.motion[k].shift_mm);
        tilts += gradient.motion[k].tilt_rad.cwiseProduct(delta.motion[k].tilt_rad);
    }
    return axes + (sum + tilts).sum();
}

records::ReadingTable predicted(const setup::Setup& setup, const records::ReadingTable& table,
                                const EffectModels& models) {
    const Replay replay(setup, table);
    const std::vector<double> value_mm = replay.predict(models);
    records::ReadingTable result = table;
    for (std::size_t i = 0; i < replay.size(); ++i)
        result.rows[replay.table_row(i)].value_mm = value_mm[i];
    declare_anew(setup, result);
    return result;
}

}  // namespace trunnion::emulator
