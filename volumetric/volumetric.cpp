#include "volumetric/volumetric.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"
#include "emulator/tool_tip.h"
#include "kinematics/jacobian.h"

namespace trunnion::volumetric {
namespace {

constexpr double default_reach_mm = 200.0;

std::vector<double> evenly(double low, double step, int count) {
    std::vector<double> steps;
    for (int i = 0; i < count; ++i) steps.push_back(low + step * i);
    return steps;
}

std::vector<double> steps_of(const kinematics::AxisGeometry& axis,
                             const VolumetricOptions& options) {
    const int count = axis.rotary ? options.rotary_grid : options.grid;
    const double reach = axis.rotary ? pi : default_reach_mm;
    const double low = axis.min.value_or(-reach), high = axis.max.value_or(reach);
    if (count == 1) return {std::clamp(0.0, low, high)};
    if (axis.rotary && high - low > 2.0 * pi - 1e-9) {
        const double step = 2.0 * pi / count;
        const int below_zero = (count - 1) / 2;
        return evenly(-step * below_zero, step, count);
    }
    return evenly(low, (high - low) / (count - 1), count);
}

std::vector<AxisPositions> grid_of(const kinematics::Chain& chain,
                                   const VolumetricOptions& options) {
    std::vector<AxisPositions> all{AxisPositions{}};
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        std::vector<AxisPositions> next;
        for (const AxisPositions& base : all)
            for (const double step : steps_of(axis, options)) {
                next.push_back(base);
                next.back()[axis.axis] = step;
            }
        all = std::move(next);
    }
    return all;
}

/// True when the grid exceeds a table of the axis's errors; beyond its ends a table keeps its last
/// value.
bool beyond_tables(const kinematics::AxisGeometry& axis, const kinematics::GeometricErrors& errors,
                   const VolumetricOptions& options) {
    const std::vector<double> steps = steps_of(axis, options);
    const auto& curves = errors.axis[index_of(axis.axis)].motion;
    return std::any_of(curves.begin(), curves.end(), [&](const kinematics::ErrorCurve& curve) {
        return !curve.at.empty() &&
               (steps.front() < curve.at.front() || steps.back() > curve.at.back());
    });
}

/// One named error of an axis or (no axis) of the spindle.
struct NamedError {
    std::string name;
    std::optional<Axis> axis;
    bool location = false;
    std::size_t k = 0;
};

std::vector<NamedError> errors_present(const kinematics::Machine& machine) {
    std::vector<NamedError> list;
    const AxisNames names = machine.chain.names();
    for (const kinematics::AxisGeometry& axis : machine.chain.axes())
        for (std::size_t k = 0; k < 6; ++k) {
            const kinematics::AxisErrors& own = machine.errors.axis[index_of(axis.axis)];
            const auto add = [&](bool location) {
                list.push_back(
                    {to_string(kinematics::ErrorName{"XYZABC"[k], location, axis.axis}, names),
                     axis.axis, location, k});
            };
            if (own.location[k] != 0.0) add(true);
            if (!own.motion[k].is_zero()) add(false);
        }
    for (std::size_t k = 0; k < 5; ++k) {
        const kinematics::AxisErrors& own = machine.errors.spindle;
        const auto add = [&](bool location) {
            list.push_back(
                {to_string(kinematics::SpindleErrorName{k, location}), std::nullopt, location, k});
        };
        if (own.location[k] != 0.0) add(true);
        if (!own.motion[k].is_zero()) add(false);
    }
    return list;
}

AxisSample standing_at(const AxisPositions& q) {
    AxisSample sample;
    sample.position = q;
    sample.travel.fill(1);  // approached in the + direction
    return sample;
}

/// Evaluates one point and the contribution of each cause.
class Mapper {
  public:
    Mapper(const setup::Setup& setup, const emulator::EffectModels& effects, double length_mm)
        : setup_(setup),
          nominal_(setup.machine),
          named_(errors_present(setup.machine)),
          whole_(setup, effects),
          tip_S_mm_(0, 0, -length_mm) {
        tool_.tip = tool_.stylus = true;
        nominal_.errors = {};
        for (const auto& effect : effects)
            alone_.push_back(std::make_unique<emulator::Observer>(setup, nominal_,
                                                                  emulator::EffectModels{effect}));
    }

    std::vector<std::string> names(const std::vector<std::string>& effect_names) const {
        std::vector<std::string> list;
        for (const NamedError& error : named_) list.push_back(error.name);
        list.insert(list.end(), effect_names.begin(), effect_names.end());
        return list;
    }

    VolumetricPoint point(const AxisPositions& q, std::vector<Vector3>& parts) const {
        const kinematics::TipJacobian jacobian = kinematics::tip_jacobian(nominal_, q, tip_S_mm_);
        const AxisSample sample = standing_at(q);
        VolumetricPoint point;
        point.at = q;
        point.tip_W_mm = jacobian.tip_W_mm;
        point.error_W_mm =
            emulator::physical_tip_W(whole_.at(sample, tool_), tip_S_mm_) - point.tip_W_mm;
        parts.clear();
        for (const NamedError& error : named_) parts.push_back(part(error, q, jacobian));
        for (const auto& machine : alone_)
            parts.push_back(emulator::physical_tip_W(machine->at(sample, tool_), tip_S_mm_) -
                            point.tip_W_mm);
        return point;
    }

  private:
    Vector3 part(const NamedError& error, const AxisPositions& q,
                 const kinematics::TipJacobian& jacobian) const {
        const kinematics::GeometricErrors& errors = setup_.machine.errors;
        const kinematics::AxisErrors& own =
            error.axis ? errors.axis[index_of(*error.axis)] : errors.spindle;
        const double value = error.location
                                 ? own.location[error.k]
                                 : own.motion[error.k](error.axis ? q[*error.axis] : 0.0);
        const kinematics::SixColumns& columns =
            error.axis
                ? (error.location ? jacobian.location : jacobian.motion)[index_of(*error.axis)]
            : error.location ? jacobian.spindle_location
                             : jacobian.spindle_motion;
        return value * columns.col(static_cast<Eigen::Index>(error.k));
    }

    const setup::Setup& setup_;
    kinematics::Machine nominal_;
    std::vector<NamedError> named_;
    emulator::Observer whole_;
    std::vector<std::unique_ptr<emulator::Observer>> alone_;
    Vector3 tip_S_mm_;
    emulator::Contact tool_;  ///< tool on which effects act
};

/// Sorts the causes by rms and renumbers the references of the points.
void rank_causes(VolumetricMap& map) {
    std::vector<std::size_t> order(map.causes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return map.causes[a].rms_mm > map.causes[b].rms_mm;
    });
    std::vector<VolumetricCause> sorted;
    std::vector<std::size_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        sorted.push_back(map.causes[order[i]]);
    }
    map.causes = std::move(sorted);
    if (!place.empty())
        for (VolumetricPoint& point : map.points) point.worst = place[point.worst];
}

void finish(VolumetricMap& map) {
    const double n = static_cast<double>(map.points.size());
    double sum = 0.0, all = 0.0;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        sum += map.points[i].error_W_mm.squaredNorm();
        if (map.points[i].error_W_mm.norm() > map.points[map.worst].error_W_mm.norm())
            map.worst = i;
    }
    map.rms_mm = std::sqrt(sum / n);
    for (const VolumetricCause& cause : map.causes) all += cause.rms_mm;  // still sums of squares
    for (VolumetricCause& cause : map.causes) {
        cause.share = all > 0.0 ? cause.rms_mm / all : 0.0;
        cause.rms_mm = std::sqrt(cause.rms_mm / n);
    }
    rank_causes(map);
}

}  // namespace

VolumetricMap volumetric_map(const setup::Setup& setup,
                             const std::vector<std::string>& effect_names,
                             const emulator::EffectModels& effects,
                             const VolumetricOptions& options) {
    const Mapper mapper(setup, effects, options.length_mm);
    VolumetricMap map;
    map.machine = setup.name;
    map.length_mm = options.length_mm;
    map.names = setup.machine.chain.names();
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        map.axes.push_back(axis.axis);
    for (const std::string& name : mapper.names(effect_names)) map.causes.push_back({name});
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
        if (!axis.min || !axis.max) map.assumed.push_back(axis.axis);
        if (beyond_tables(axis, setup.machine.errors, options)) map.clamped.push_back(axis.axis);
    }
    std::vector<Vector3> parts;
    const std::vector<AxisPositions> grid = grid_of(setup.machine.chain, options);
    for (const AxisPositions& q : grid) {
        VolumetricPoint point = mapper.point(q, parts);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            VolumetricCause& cause = map.causes[i];
            cause.largest_mm = std::max(cause.largest_mm, Finite(parts[i].norm()));
            cause.rms_mm = cause.rms_mm + parts[i].squaredNorm();
            if (parts[i].norm() > parts[point.worst].norm()) point.worst = i;
        }
        map.points.push_back(point);
        if (options.go_on && !options.go_on(map.points.size(), grid.size())) break;
    }
    finish(map);
    return map;
}

}  // namespace trunnion::volumetric
