// Where: a zero that moves to and fro in time, such as a slip that comes and goes, or the zero of
// an interferometer that differs from cycle to cycle.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "diagnosis/groups/beside_places.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/whole_drivers.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t most_time_knots = 48;
constexpr Eigen::Index most_time_columns = 32;
constexpr double part_of_time = 1.0 / 20.0;  ///< that a state lasts, of the whole test (assumed)

/// True for readings of a laser, an autocollimator or a reference encoder: their zero is one value
/// along the axis. What a probe reads may move in every direction (driver_list.cpp).
bool have_one_direction(const emulator::Replay& replay) {
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (!reads_targets(replay.contact(i).device)) return false;
    return true;
}

/// Smooth courses of time without their mean: rows x columns.
Eigen::MatrixXd courses_of_time(const Prepared& p) {
    std::vector<double> times;
    for (std::size_t i = 0; i < p.replay.size(); ++i) times.push_back(p.replay.sample(i).time_s);
    const std::vector<double> knots = estimation::knots_of(times, most_time_knots);
    if (knots.size() < most_time_knots / 2) return {};
    const Eigen::MatrixXd shapes =
        estimation::smooth_shapes(knots, part_of_time * (knots.back() - knots.front()),
                                  estimation::polynomials_at(knots, 1), most_time_columns);
    Eigen::MatrixXd courses(static_cast<Eigen::Index>(times.size()), shapes.cols());
    for (std::size_t i = 0; i < times.size(); ++i) {
        const auto [k, w] = estimation::place_between(knots, times[i]);
        courses.row(static_cast<Eigen::Index>(i)) =
            (1.0 - w) * shapes.row(k) + w * shapes.row(k + 1);
    }
    return courses;
}

bool moves(const Prepared& p, Axis axis) {
    const double first = p.replay.sample(0).position[axis];
    for (std::size_t i = 1; i < p.replay.size(); ++i)
        if (p.replay.sample(i).position[axis] != first) return true;
    return false;
}

/// What a typical error of an axis moves the readings by, mm; of a rotary axis the angle.
Eigen::VectorXd response_to(const Prepared& p, Axis axis) {
    Eigen::VectorXd response(static_cast<Eigen::Index>(p.replay.size()));
    const double usual = p.table.names.is_rotary(axis) ? usual_driver_rad : usual_driver_mm;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        response(static_cast<Eigen::Index>(i)) = usual * p.base.gradient[i].axis[axis];
    return response;
}

}  // namespace

void add_wandering_groups(Design& design, const Prepared& prepared, const Whitener& whitener,
                          Eigen::Index owned) {
    const bool told = records::has_times(prepared.table);
    if (!have_one_direction(prepared.replay) ||
        is_one_sweep(prepared.replay, prepared.table.axes) ||
        (!told && is_one_cycle(prepared.replay, prepared.table.axes)))
        return;
    const Eigen::MatrixXd courses = courses_of_time(prepared);
    if (courses.cols() == 0) return;
    for (const Axis axis : prepared.table.axes) {
        if (!moves(prepared, axis)) continue;
        Eigen::MatrixXd columns = response_to(prepared, axis).asDiagonal() * courses;
        if (columns.squaredNorm() == 0.0) continue;
        whitener.apply(columns);
        ColumnGroup group;
        group.kind = GroupKind::driver;
        group.name = "time";
        group.component = "along " + prepared.table.names[axis];
        group.text =
            told ? "comes and goes with time" : "comes and goes in the order of the readings";
        group.of_time = true;
        group.is_anything = true;
        group.log_prior =
            rules::table_prior - std::log(static_cast<double>(prepared.table.axes.size()));
        const auto with_columns = [&](bool by_side) {
            const Eigen::MatrixXd own = beside_places(prepared, whitener, columns, by_side);
            const Eigen::Index first = design.add_features(own);
            ColumnGroup of = group;
            for (Eigen::Index k = 0; k < own.cols(); ++k) of.features.push_back(first + k);
            return of;
        };
        add_whole(design, with_columns(false));
        design.add_beside(with_columns(true), owned);
    }
}

}  // namespace trunnion::diagnosis
