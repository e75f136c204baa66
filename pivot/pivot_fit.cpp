#include "pivot/pivot_fit.h"

#include <fmt/format.h>

#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::pivot {

namespace {

constexpr double reading_mm = 1e-3;  ///< weight of a reading until its scatter is known

double typical(const LineUnknown& unknown) {
    return unknown.tilt ? 1e-4 : 0.1;
}

/// Two directions perpendicular to an axis, along machine axes where possible.
std::array<Vector3, 2> across(const Vector3& line) {
    Eigen::Index along = 0;
    line.cwiseAbs().maxCoeff(&along);
    const Vector3 first = Vector3::Unit((along + 1) % 3);
    const Vector3 a = (first - first.dot(line) * line).normalized();
    return {a, line.cross(a)};
}

/// The zero position of a table axis is equivalent to the sphere position, that of a head to a
/// shift of the stylus ball; neither is a separate unknown.
std::vector<LineUnknown> line_unknowns(const offsets::PivotParameters& pivot) {
    std::vector<LineUnknown> unknowns;
    for (const bool second : {false, true}) {
        const offsets::PivotAxis& axis = second ? pivot.second : pivot.first;
        const char letter = letter_of(axis.axis);
        for (const bool tilt : {false, true})
            for (const Vector3& direction : across(axis.line))
                unknowns.push_back(
                    {axis.axis, tilt, direction,
                     fmt::format("{} of the {} axis across it", tilt ? "tilt" : "place", letter)});
    }
    if (pivot.unit == offsets::MechanicalUnit::table_table) return unknowns;
    for (int i = 0; i < 3; ++i)
        unknowns.push_back({std::nullopt, false, Vector3::Unit(i),
                            fmt::format("{} of the stylus ball under the head", "XYZ"[i])});
    return unknowns;
}

kinematics::Machine all_moved(kinematics::Machine machine, const std::vector<LineUnknown>& unknowns,
                              const Eigen::VectorXd& value) {
    for (std::size_t k = 0; k < unknowns.size(); ++k)
        machine = moved(std::move(machine), unknowns[k], value(static_cast<Eigen::Index>(k)));
    return machine;
}

/// All points with the number of the preceding zeroing.
struct Row {
    PivotGroup group;
    PivotPoint point;
    Eigen::Index zeroing;
};

std::vector<Row> rows_of(const std::vector<PivotMap>& maps) {
    std::vector<Row> rows;
    Eigen::Index zeroing = 0;
    for (const PivotMap& map : maps)
        for (const PivotArc& arc : map.arcs) {
            for (const PivotPoint& p : arc.points) rows.push_back({arc.group, p, zeroing});
            ++zeroing;
        }
    return rows;
}

class MapFit {
  public:
    MapFit(const PivotEvidence& evidence, const std::vector<PivotMap>& maps)
        : evidence_(evidence), unknowns_(line_unknowns(evidence.in_force.pivot)) {
        rows_ = rows_of(maps);
        zeroings_ = rows_.empty() ? 0 : rows_.back().zeroing + 1;
        machine_unknowns_ = static_cast<Eigen::Index>(unknowns_.size());
        value_ = Eigen::VectorXd::Zero(machine_unknowns_ + 3 * zeroings_);
    }
    PivotFit run();

  private:
    PivotModel model(const Eigen::VectorXd& value) const {
        return {all_moved(evidence_.known, unknowns_, value.head(machine_unknowns_)),
                evidence_.in_force, evidence_.sphere_mm, evidence_.tip_S_mm};
    }
    Vector3 error(const PivotModel& model, const Row& row, const Eigen::VectorXd& value) const {
        return model.error_mm(row.group, row.point.first_deg, row.point.second_deg,
                              value.segment<3>(machine_unknowns_ + 3 * row.zeroing));
    }
    Eigen::VectorXd residual() const;
    Eigen::VectorXd scale() const;
    Eigen::MatrixXd jacobian() const;
    void spread(PivotFit& fit, const estimation::LinearFit& linear,
                const Eigen::VectorXd& left) const;

    const PivotEvidence& evidence_;
    std::vector<LineUnknown> unknowns_;
    std::vector<Row> rows_;
    Eigen::Index zeroings_ = 0, machine_unknowns_ = 0;
    Eigen::VectorXd value_;
};

Eigen::VectorXd MapFit::scale() const {
    Eigen::VectorXd scale = Eigen::VectorXd::Constant(value_.size(), 0.01);
    for (Eigen::Index k = 0; k < machine_unknowns_; ++k)
        scale(k) = typical(unknowns_[static_cast<std::size_t>(k)]);
    return scale;
}

Eigen::VectorXd MapFit::residual() const {
    const PivotModel now = model(value_);
    Eigen::VectorXd out(3 * static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i)
        out.segment<3>(3 * static_cast<Eigen::Index>(i)) =
            (rows_[i].point.error_mm - error(now, rows_[i], value_)) / reading_mm;
    return out;
}

/// Columns for one typical change each; rows divided by `reading_mm`.
Eigen::MatrixXd MapFit::jacobian() const {
    const Eigen::VectorXd scale = this->scale();
    const auto count = static_cast<Eigen::Index>(rows_.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * count, value_.size());
    for (Eigen::Index k = 0; k < machine_unknowns_; ++k) {
        Eigen::VectorXd up = value_, down = value_;
        up(k) += scale(k);
        down(k) -= scale(k);
        const PivotModel high = model(up), low = model(down);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Row& row = rows_[static_cast<std::size_t>(i)];
            jacobian.block<3, 1>(3 * i, k) =
                0.5 * (error(high, row, up) - error(low, row, down)) / reading_mm;
        }
    }
    const PivotModel now = model(value_);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Row& row = rows_[static_cast<std::size_t>(i)];
        const Vector3 here = error(now, row, value_);
        for (int d = 0; d < 3; ++d) {
            const Eigen::Index k = machine_unknowns_ + 3 * row.zeroing + d;
            Eigen::VectorXd there = value_;
            there(k) += scale(k);
            jacobian.block<3, 1>(3 * i, k) = (error(now, row, there) - here) / reading_mm;
        }
    }
    return jacobian;
}

void MapFit::spread(PivotFit& fit, const estimation::LinearFit& linear,
                    const Eigen::VectorXd& left) const {
    const Eigen::VectorXd scale = this->scale();
    const auto unseen = static_cast<Eigen::Index>(linear.null_space.size());
    const double freedom =
        std::max<double>(1.0, static_cast<double>(left.size() - value_.size() + unseen));
    const double variance = left.squaredNorm() / freedom;
    fit.noise_um = um_from_mm(reading_mm * std::sqrt(variance));
    const Eigen::VectorXd change = scale.head(machine_unknowns_);
    fit.covariance = variance * change.asDiagonal() *
                     linear.covariance.topLeftCorner(machine_unknowns_, machine_unknowns_) *
                     change.asDiagonal();
    fit.zeroings = static_cast<int>(zeroings_);
    if (zeroings_ < 2) return;
    double square = 0.0, doubt = 0.0;
    for (Eigen::Index k = machine_unknowns_; k < value_.size(); ++k) {
        square += value_(k) * value_(k);
        doubt += variance * linear.covariance(k, k) * scale(k) * scale(k);
    }
    const auto count = static_cast<double>(value_.size() - machine_unknowns_);
    fit.zero_scatter_um = um_from_mm(std::sqrt(std::max(0.0, (square - doubt) / count)));
}

PivotFit MapFit::run() {
    estimation::LinearFit linear;
    const Eigen::VectorXd scale = this->scale();
    for (int pass = 0; pass < 4; ++pass) {
        const Eigen::MatrixXd a = jacobian();
        linear = estimation::solve_ranked(a.transpose() * a, a.transpose() * residual());
        value_ += linear.value.cwiseProduct(scale);
        if (linear.value.norm() < 1e-12) break;
    }
    PivotFit fit;
    fit.machine = all_moved(evidence_.known, unknowns_, value_.head(machine_unknowns_));
    for (const Eigen::VectorXd& direction : linear.null_space)
        for (Eigen::Index k = 0; k < machine_unknowns_; ++k)
            if (std::abs(direction(k)) > 0.99) fit.unseen.push_back(static_cast<std::size_t>(k));
    fit.unknowns = unknowns_;
    spread(fit, linear, residual());
    return fit;
}

}  // namespace

kinematics::Machine moved(kinematics::Machine machine, const LineUnknown& unknown, double value) {
    auto& location = unknown.axis ? machine.errors.axis[index_of(*unknown.axis)].location
                                  : machine.errors.spindle.location;
    for (int i = 0; i < 3; ++i)
        location[static_cast<std::size_t>(i + (unknown.tilt ? 3 : 0))] +=
            value * unknown.direction[i];
    return machine;
}

PivotFit fit_pivot_machine(const PivotEvidence& evidence, const std::vector<PivotMap>& maps) {
    std::size_t points = 0;
    for (const PivotMap& map : maps)
        for (const PivotArc& arc : map.arcs) points += arc.points.size();
    if (points < 6) throw InputError("too few indexed positions to judge a store");
    return MapFit(evidence, maps).run();
}

}  // namespace trunnion::pivot
