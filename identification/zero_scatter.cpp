#include "identification/zero_scatter.h"

#include <Eigen/Cholesky>
#include <map>
#include <string>
#include <tuple>

#include "base/units.h"

namespace trunnion::identification {

namespace {

bool is_probed(const emulator::Contact& contact) {
    return contact.device == records::Device::sphere || contact.device == records::Device::touch;
}

}  // namespace

ZeroScatter::ZeroScatter(const setup::Setup& setup, const records::ReadingTable& table,
                         const emulator::Replay& replay,
                         const std::vector<kinematics::Perturbation>& gradient) {
    const auto sigma_um = setup.model.noise_um.find("zero");
    if (sigma_um == setup.model.noise_um.end()) return;
    std::map<std::tuple<int, std::string, std::string>, std::size_t> known;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        if (!is_probed(replay.contact(i))) continue;
        const records::Reading& row = table.rows[replay.table_row(i)];
        const auto [at, added] =
            known.try_emplace({row.part, row.session, row.test}, tests_.size());
        if (added) tests_.emplace_back();
        tests_[at->second].rows.push_back(static_cast<Eigen::Index>(i));
    }
    for (Test& test : tests_) {
        test.reading_mm.resize(static_cast<Eigen::Index>(test.rows.size()), 3);
        for (std::size_t k = 0; k < test.rows.size(); ++k)
            test.reading_mm.row(static_cast<Eigen::Index>(k)) =
                mm_from_um(sigma_um->second) *
                gradient[static_cast<std::size_t>(test.rows[k])].work_shift_mm.transpose();
    }
}

Eigen::MatrixXd ZeroScatter::product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right,
                                     const Eigen::VectorXd& weight) const {
    Eigen::MatrixXd out = left.transpose() * right;
    for (const Test& test : tests_) {  // Woodbury: V^-1 = I - Z (I + Z'Z)^-1 Z'
        const Eigen::MatrixXd z = weight(test.rows).asDiagonal() * test.reading_mm;
        const Eigen::Matrix3d inner = Eigen::Matrix3d::Identity() + z.transpose() * z;
        const Eigen::MatrixXd l = z.transpose() * left(test.rows, Eigen::all);
        const Eigen::MatrixXd r = z.transpose() * right(test.rows, Eigen::all);
        out -= l.transpose() * inner.llt().solve(r);
    }
    return out;
}

}  // namespace trunnion::identification
