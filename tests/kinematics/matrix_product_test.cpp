// The forward model against a plain product of 4x4 matrices, written here a second time in long
// double: no code of kinematics but the chain and the error values it is given.
#include <catch2/catch.hpp>
#include <random>

#include "kinematics/jacobian.h"

using namespace trunnion;

namespace {

using Real = long double;
using Matrix4 = Eigen::Matrix<Real, 4, 4>;
using Triple = std::array<double, 3>;

Matrix4 shift(Real x, Real y, Real z) {
    Matrix4 m = Matrix4::Identity();
    m(0, 3) = x, m(1, 3) = y, m(2, 3) = z;
    return m;
}

/// Elementary rotations of the paper's eq. 7: k = 0, 1, 2 about X, Y, Z.
Matrix4 elementary(int k, Real angle) {
    Matrix4 m = Matrix4::Identity();
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    m(i, i) = m(j, j) = std::cos(angle);
    m(i, j) = -std::sin(angle), m(j, i) = std::sin(angle);
    return m;
}

/// About the line of the vector (x, y, z): the vector is laid on Z, turned, and put back.
Matrix4 about(Real x, Real y, Real z, Real angle) {
    const Matrix4 lay =
        elementary(1, -std::atan2(std::hypot(x, y), z)) * elementary(2, -std::atan2(y, x));
    return lay.transpose() * elementary(2, angle) * lay;
}

Matrix4 turn(Real x, Real y, Real z) {
    return about(x, y, z, std::sqrt(x * x + y * y + z * z));
}

/// One axis of the chain, as the contract writes it (Frames; HTM 2022, eq. 20).
Matrix4 axis_matrix(const kinematics::AxisGeometry& axis, const kinematics::AxisErrors& errors,
                    double position) {
    const auto& e = errors.location;
    std::array<Real, 6> m{};
    for (std::size_t k = 0; k < 6; ++k)
        m[k] = errors.motion[k].constant + Real(errors.motion[k].slope) * position;
    const Matrix4 location_tilt = turn(e[3], e[4], e[5]), motion_tilt = turn(m[3], m[4], m[5]);
    const auto& u = axis.direction;
    if (!axis.rotary) {
        const Eigen::Matrix<Real, 4, 1> way =
            location_tilt * Eigen::Matrix<Real, 4, 1>(u.x() * Real(position),
                                                      u.y() * Real(position),
                                                      u.z() * Real(position), 0);
        return shift(e[0], e[1], e[2]) * shift(way(0), way(1), way(2)) * shift(m[0], m[1], m[2]) *
               motion_tilt;
    }
    const auto& p = axis.point_mm;
    return shift(p.x() + Real(e[0]), p.y() + Real(e[1]), p.z() + Real(e[2])) * location_tilt *
           shift(m[0], m[1], m[2]) * motion_tilt * about(u.x(), u.y(), u.z(), position) *
           shift(-p.x(), -p.y(), -p.z());
}

Matrix4 side_matrix(const std::vector<kinematics::AxisGeometry>& side,
                    const kinematics::GeometricErrors& errors, const AxisPositions& q) {
    Matrix4 m = Matrix4::Identity();
    for (const kinematics::AxisGeometry& axis : side)
        m = m * axis_matrix(axis, errors.axis[index_of(axis.axis)], q[axis.axis]);
    return m;
}

/// The tip in the table's frame: inverse of the rigid W matrix times the S matrix times the tip.
Vector3 plain_tip_W(const kinematics::Machine& machine, const AxisPositions& q,
                    const Vector3& tip) {
    const Matrix4 w = side_matrix(machine.chain.work, machine.errors, q);
    const Eigen::Matrix<Real, 4, 1> tip_M = side_matrix(machine.chain.tool, machine.errors, q) *
                                            Eigen::Matrix<Real, 4, 1>(tip.x(), tip.y(), tip.z(), 1);
    const Eigen::Matrix<Real, 3, 1> in_W =
        w.topLeftCorner<3, 3>().transpose() * (tip_M - w.col(3)).head<3>();
    return in_W.cast<double>();
}

class Draw {
  public:
    explicit Draw(unsigned seed) : engine_(seed) {}
    double operator()(double size) {
        return size * std::uniform_real_distribution<double>(-1, 1)(engine_);
    }
    Vector3 vector(double size) {
        const double x = (*this)(size), y = (*this)(size), z = (*this)(size);
        return {x, y, z};
    }
    std::string shuffled(std::string text) {
        std::shuffle(text.begin(), text.end(), engine_);
        return text;
    }

  private:
    std::mt19937 engine_;
};

/// X Y Z and two rotary axes in any order, the bed anywhere among them.
kinematics::Chain random_chain(Draw& draw) {
    static constexpr const char* rotaries[] = {"AB", "AC", "BC"};
    std::string text = "w";
    for (const char letter :
         draw.shuffled(std::string("XYZb") + rotaries[static_cast<int>(1.5 + draw(1.49))]))
        text += std::string(" ") + letter;
    kinematics::Chain chain = kinematics::parse_chain(text + " t");
    for (auto* side : {&chain.work, &chain.tool})
        for (kinematics::AxisGeometry& axis : *side) {
            axis.direction = (axis.direction + draw.vector(0.3)).normalized();
            if (axis.rotary) axis.point_mm = draw.vector(60);
        }
    return chain;
}

/// 30 error motions, 8 location errors of the rotary axes (6 of each here), 3 squarenesses.
void draw_errors(kinematics::Machine& machine, Draw& draw) {
    for (const kinematics::AxisGeometry& axis : machine.chain.axes()) {
        kinematics::AxisErrors& errors = machine.errors.axis[index_of(axis.axis)];
        for (std::size_t k = 0; k < 6; ++k) {
            errors.motion[k].constant = draw(k < 3 ? 0.02 : 1e-4);
            errors.motion[k].slope = draw(k < 3 ? 1e-4 : 1e-6);
            if (axis.rotary || k > 2) errors.location[k] = draw(k < 3 ? 0.05 : 2e-4);
        }
    }
}

AxisPositions draw_positions(const kinematics::Chain& chain, Draw& draw) {
    AxisPositions q;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        q[axis.axis] = draw(axis.rotary ? 3.1 : 250);
    return q;
}

}  // namespace

TEST_CASE("1,000 random machines with all errors are the product of their 4x4 matrices") {
    Draw draw(2026);
    double worst_mm = 0.0;
    for (int i = 0; i < 1000; ++i) {
        kinematics::Machine machine;
        machine.chain = random_chain(draw);
        draw_errors(machine, draw);
        const AxisPositions q = draw_positions(machine.chain, draw);
        const Vector3 tip = draw.vector(120);
        const Vector3 plain = plain_tip_W(machine, q, tip);
        worst_mm = std::max(worst_mm, (machine.tip_W(q, tip) - plain).norm());
        worst_mm =
            std::max(worst_mm, (kinematics::tip_jacobian(machine, q, tip).tip_W_mm - plain).norm());
    }
    CHECK(worst_mm < 1e-12);
}

TEST_CASE("a slide's angular error carries the slides on it: EBY with X at 300 sinks the tip") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b Y X Z t");
    machine.errors.motion({'B', false, Axis::Y}).constant = 1e-4;
    AxisPositions q;
    q[Axis::X] = 300;
    const Vector3 error = machine.tip_W(q, Vector3::Zero()) - Vector3(300, 0, 0);
    CHECK(error.z() == Approx(-0.03).epsilon(1e-8));
    CHECK(std::abs(error.x()) < 2e-6);
    machine.chain = kinematics::parse_chain("w b X Y Z t");  // here Y carries no X
    CHECK(machine.tip_W(q, Vector3::Zero()).z() == 0.0);
}

TEST_CASE("on the work side too: the table that X carries follows the angular error of Y") {
    kinematics::Machine machine;
    machine.chain =
        kinematics::parse_chain("w X Y b Z t");  // Y on the bed carries X, X the workpiece
    machine.errors.motion({'B', false, Axis::Y}).constant = 1e-4;
    AxisPositions q;
    q[Axis::X] = 300;
    const Vector3 table_M = machine.poses(q).pose_MW.translation_mm;  // table axes run against M
    CHECK(table_M.z() == Approx(0.03).epsilon(1e-8));
}
