#include "estimation/sparse_products.h"

#include "estimation/wide_vectors.h"

namespace trunnion::estimation {
namespace {

/// The entries of one sparse column.
struct SparseColumn {
    const double* values;
    const int* rows;
    Eigen::Index count;
};

/// Sums of the rows at `from`, which are `width` numbers long (a multiple of the lanes), each times
/// the entry of the sparse column in that row.
TRUNNION_WIDE_VECTORS void sum_rows(const SparseColumn& column, const double* from,
                                    Eigen::Index width, double* sums) {
    for (Eigen::Index at = 0; at < width; at += lanes) {
        Lanes sum{}, row{};
        for (Eigen::Index k = 0; k < column.count; ++k) {
            load(from + column.rows[k] * width + at, row);
            sum += column.values[k] * row;
        }
        store(sum, sums + at);
    }
}

}  // namespace

Eigen::MatrixXd sparse_products(const Eigen::Ref<const Eigen::MatrixXd>& b,
                                const Eigen::SparseMatrix<double>& a) {
    // Row by row: what an entry of A meets is then side by side.
    const Eigen::Index width = (b.cols() + lanes - 1) / lanes * lanes;
    Eigen::MatrixXd across = Eigen::MatrixXd::Zero(width, b.rows());
    across.topRows(b.cols()) = b.transpose();
    Eigen::MatrixXd sums(width, a.cols());
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
        const auto first = a.outerIndexPtr()[j];
        sum_rows(
            {a.valuePtr() + first, a.innerIndexPtr() + first, a.outerIndexPtr()[j + 1] - first},
            across.data(), width, sums.col(j).data());
    }
    return sums.topRows(b.cols());
}

}  // namespace trunnion::estimation
