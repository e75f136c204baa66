#include "diagnosis/same_work.h"

#include <Eigen/QR>

#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

constexpr double small_part = 0.03;  ///< of the squares: so little else is no other cause (assumed)

}  // namespace

Eigen::MatrixXd named_beside(const Outcome& f, std::size_t position,
                             const Eigen::MatrixXd& columns) {
    Eigen::MatrixXd all = columns;
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        if (k == position || f.design.group(f.model.members[k]).kind != GroupKind::textbook)
            continue;
        const Eigen::MatrixXd& own = f.design.columns(f.model.members[k]);
        all.conservativeResize(Eigen::NoChange, all.cols() + own.cols());
        all.rightCols(own.cols()) = own;
    }
    return f.design.projection().beside(all);
}

bool do_the_same(const Outcome& f, const Eigen::VectorXd& part, const Eigen::MatrixXd& columns,
                 double freedom) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(columns);
    const double left = (part - columns * fit.solve(part)).squaredNorm();
    const double nu = f.model.variances.nu;
    return left < small_part * part.squaredNorm() ||
           estimation::chi_squared_tail(left / (nu * nu), freedom) > rules::chance_of_difference;
}

}  // namespace trunnion::diagnosis
