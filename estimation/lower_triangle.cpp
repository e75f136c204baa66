#include "estimation/lower_triangle.h"

#include <cmath>
#include <cstring>

#include "estimation/wide_vectors.h"

namespace trunnion::estimation {
namespace {

using Index = Eigen::Index;
constexpr Index height = lanes, width = 4;  ///< of a panel

/// Where the factors of a sum of products are: of the first, eight rows of one column; of the
/// second, four numbers at `across` from each other. Both go on by a step for each product.
struct Operands {
    const double *rows, *numbers;
    Index rows_step, numbers_step, across;
};

/// sums(8 x 4) = sum over `count` products.
inline __attribute__((always_inline)) void sum_products(Operands from, Index count,
                                                        Lanes (&sums)[width]) {
    Lanes a{}, b{}, c{}, d{}, rows{};
    for (Index k = 0; k < count; ++k) {
        load(from.rows, rows);
        a += rows * from.numbers[0];
        b += rows * from.numbers[from.across];
        c += rows * from.numbers[2 * from.across];
        d += rows * from.numbers[3 * from.across];
        from.rows += from.rows_step;
        from.numbers += from.numbers_step;
    }
    sums[0] = a, sums[1] = b, sums[2] = c, sums[3] = d;
}

/// Columns first .. first + 4 of the factor, from what the earlier columns leave of them.
inline __attribute__((always_inline)) void factor_panel(double* m, Index n, Index first) {
    const Index top = first / height * height;
    for (Index q = first; q < first + width; ++q) {
        Lanes own, other;
        for (Index k = first; k < q; ++k) {
            const double times = m[q + k * n];
            for (Index i = top; i < n; i += height) {
                load(m + i + q * n, own);
                load(m + i + k * n, other);
                own -= times * other;
                store(own, m + i + q * n);
            }
        }
        const double scale = 1.0 / std::sqrt(m[q + q * n]);
        for (Index i = top; i < n; i += height) {
            load(m + i + q * n, own);
            own *= scale;
            store(own, m + i + q * n);
        }
    }
}

TRUNNION_WIDE_VECTORS void factor(double* m, Index n) {
    for (Index j = 0; j < n; j += width) {
        for (Index i = j / height * height; i < n; i += height) {
            Lanes sums[width], own;
            sum_products({m + i, m + j, n, n, 1}, j, sums);
            for (Index q = 0; q < width; ++q) {
                load(m + i + (j + q) * n, own);
                own -= sums[q];
                store(own, m + i + (j + q) * n);
            }
        }
        factor_panel(m, n, j);
    }
}

/// Inverse of the 8 x 8 triangle on the diagonal at row `first`, column by column.
void invert_corner(const double* l, Index n, Index first, double (&inverse)[height * height]) {
    for (Index c = 0; c < height; ++c)
        for (Index r = 0; r < height; ++r) {
            double sum = r == c ? 1.0 : 0.0;
            for (Index k = c; k < r; ++k)
                sum -= l[first + r + (first + k) * n] * inverse[k + c * height];
            inverse[r + c * height] = r < c ? 0.0 : sum / l[first + r + (first + r) * n];
        }
}

/// Eight rows of the inverse at a time: those of the corner, times what the rows above leave.
TRUNNION_WIDE_VECTORS void invert(const double* l, double* x, Index n) {
    double corner[height * height];
    for (Index i = 0; i < n; i += height) {
        invert_corner(l, n, i, corner);
        for (Index j = 0; j < i; j += width) {
            Lanes sums[width], own;
            sum_products({l + i + j * n, x + j + j * n, n, 1, n}, i - j, sums);
            for (Index q = 0; q < width; ++q) {
                Lanes result{};
                for (Index k = 0; k < height; ++k) {
                    load(corner + k * height, own);
                    result -= own * sums[q][k];
                }
                store(result, x + i + (j + q) * n);
            }
        }
        for (Index c = 0; c < height; ++c)
            std::memcpy(x + i + (i + c) * n, corner + c * height, height * sizeof(double));
    }
}

}  // namespace

void factor_in_place(Eigen::MatrixXd& matrix) {
    factor(matrix.data(), matrix.rows());
}

Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& lower) {
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(lower.rows(), lower.cols());
    invert(lower.data(), inverse.data(), lower.rows());
    return inverse;
}

}  // namespace trunnion::estimation
