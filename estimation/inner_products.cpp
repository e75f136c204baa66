#include "estimation/inner_products.h"

#include <algorithm>

#include "estimation/wide_vectors.h"

namespace trunnion::estimation {
namespace {

using Index = Eigen::Index;
constexpr Index tall = 4, broad = 2;  ///< columns of A and of B at a time
constexpr Index in_cache = 512;       ///< rows at a time

/// Columns at a distance of `stride`.
struct Columns {
    const double* first;
    Index stride;
    const double* at(Index k) const { return first + k * stride; }
};

inline __attribute__((always_inline)) double sum_of(const Lanes& v) {
    return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Adds the products of one column with another over `count` rows.
inline __attribute__((always_inline)) void add_one(const double* a, const double* b, Index count,
                                                   double& out) {
    Lanes sum{}, x{}, y{};
    Index k = 0;
    for (; k + lanes <= count; k += lanes) {
        load(a + k, x);
        load(b + k, y);
        sum += x * y;
    }
    double rest = 0.0;
    for (; k < count; ++k) rest += a[k] * b[k];
    out += sum_of(sum) + rest;
}

/// The same for four columns with two; `Part` is as many of the lanes as eight sums of them, four
/// factors more beside, have place in the registers.
template <class Part>
inline __attribute__((always_inline)) void add_eight(Columns a, Columns b, Index count, double* out,
                                                     Index out_stride) {
    const double *a0 = a.at(0), *a1 = a.at(1), *a2 = a.at(2), *a3 = a.at(3);
    const double *b0 = b.at(0), *b1 = b.at(1);
    const Index whole = count / lanes * lanes;
    Lanes sums[tall * broad];
    constexpr Index part = sizeof(Part) / sizeof(double);
    for (Index from = 0; from < lanes; from += part) {
        Part s00{}, s10{}, s20{}, s30{}, s01{}, s11{}, s21{}, s31{}, x{}, y0{}, y1{};
        for (Index k = from; k < whole; k += lanes) {
            load(b0 + k, y0);
            load(b1 + k, y1);
            load(a0 + k, x);
            s00 += x * y0;
            s01 += x * y1;
            load(a1 + k, x);
            s10 += x * y0;
            s11 += x * y1;
            load(a2 + k, x);
            s20 += x * y0;
            s21 += x * y1;
            load(a3 + k, x);
            s30 += x * y0;
            s31 += x * y1;
        }
        const Part parts[tall * broad] = {s00, s10, s20, s30, s01, s11, s21, s31};
        for (Index n = 0; n < tall * broad; ++n)
            std::memcpy(reinterpret_cast<double*>(&sums[n]) + from, &parts[n], sizeof(Part));
    }
    double rest[tall * broad] = {};
    for (Index k = whole; k < count; ++k)
        for (Index i = 0; i < tall; ++i) {
            rest[i] += a.at(i)[k] * b0[k];
            rest[tall + i] += a.at(i)[k] * b1[k];
        }
    for (Index j = 0; j < broad; ++j)
        for (Index i = 0; i < tall; ++i)
            out[i + j * out_stride] += sum_of(sums[i + j * tall]) + rest[i + j * tall];
}

/// What is known of the factors.
enum class Known { nothing, upper, same };  ///< A is upper triangular; B is A

struct Shape {
    Index rows, a_columns, b_columns;
    Known known;
};

struct Range {
    Index first, count;
};

/// out(i, j) += sum over some rows.
template <class Part>
inline __attribute__((always_inline)) void add_rows(Columns a, Columns b, const Shape& shape,
                                                    Range rows, double* out) {
    const auto rows_of = [&](Index last_column) {
        return shape.known == Known::upper
                   ? std::clamp<Index>(last_column + 1 - rows.first, 0, rows.count)
                   : rows.count;
    };
    for (Index j = 0; j < shape.b_columns; j += broad) {
        const Index end =
            shape.known == Known::same ? std::min(shape.a_columns, j + broad) : shape.a_columns;
        for (Index i = 0; i < end; i += tall) {
            const Index high = std::min(tall, shape.a_columns - i),
                        wide = std::min(broad, shape.b_columns - j);
            const Columns own{a.at(i) + rows.first, a.stride},
                other{b.at(j) + rows.first, b.stride};
            double* to = out + i + j * shape.a_columns;
            const Index used = rows_of(i + high - 1);
            if (high == tall && wide == broad) {
                add_eight<Part>(own, other, used, to, shape.a_columns);
                continue;
            }
            for (Index q = 0; q < wide; ++q)
                for (Index p = 0; p < high; ++p)
                    add_one(own.at(p), other.at(q), used, to[p + q * shape.a_columns]);
        }
    }
}

TRUNNION_WIDE_VECTORS void multiply(Columns a, Columns b, const Shape& shape, double* out) {
    const bool all_at_once = has_widest_vectors();
    for (Index k = 0; k < shape.rows; k += in_cache) {
        const Range rows{k, std::min(in_cache, shape.rows - k)};
        if (all_at_once)
            add_rows<Lanes>(a, b, shape, rows, out);
        else
            add_rows<HalfLanes>(a, b, shape, rows, out);
    }
}

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b, Known known) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.cols(), b.cols());
    multiply({a.data(), a.outerStride()}, {b.data(), b.outerStride()},
             {a.rows(), a.cols(), b.cols(), known}, out.data());
    return out;
}

}  // namespace

Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b) {
    return product(a, b, Known::nothing);
}

Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a) {
    Eigen::MatrixXd out = product(a, a, Known::same);
    out.triangularView<Eigen::StrictlyLower>() = out.transpose();
    return out;
}

Eigen::MatrixXd upper_inner_products(const Eigen::Ref<const Eigen::MatrixXd>& upper,
                                     const Eigen::Ref<const Eigen::MatrixXd>& b) {
    return product(upper, b, Known::upper);
}

}  // namespace trunnion::estimation
