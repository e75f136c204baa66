#include "diagnosis/design.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

constexpr double visible_part = 0.02, visible_square = 1e-4;

std::vector<Eigen::Index> first_features(Eigen::Index count) {
    std::vector<Eigen::Index> list(static_cast<std::size_t>(count));
    std::iota(list.begin(), list.end(), Eigen::Index{0});
    return list;
}

}  // namespace

bool Design::Entry::visible() const {
    const double seen = gram.trace();
    return !hidden && seen > visible_square && seen > visible_part * visible_part * whole;
}

Design::Design(Eigen::MatrixXd known, Eigen::VectorXd data, double rows)
    : known_(std::move(known)),
      data_(std::move(data)),
      rows_(rows),
      projection_(known_),
      data_coordinates_(projection_.coordinates(data_)),
      known_coordinates_(projection_.coordinates(known_)) {}

Eigen::Index Design::add_features(const Eigen::MatrixXd& white) {
    Block block;
    block.first = features_;
    block.white = Eigen::MatrixXd::Zero(data_.size(), white.cols());
    block.white.topRows(white.rows()) = white;
    block.coordinates = projection_.coordinates(block.white);
    block.product.noalias() = block.white.transpose() * data_;
    block.product.noalias() -= block.coordinates.transpose() * data_coordinates_;
    features_ += white.cols();
    blocks_.push_back(std::move(block));
    return blocks_.back().first;
}

const Design::Block& Design::block_of(Eigen::Index feature) const {
    const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), feature,
                                        [](Eigen::Index f, const Block& b) { return f < b.first; });
    return *std::prev(after);
}

Eigen::VectorXd Design::product_of(const std::vector<Eigen::Index>& features) const {
    Eigen::VectorXd product(static_cast<Eigen::Index>(features.size()));
    for (std::size_t k = 0; k < features.size(); ++k) {
        const Block& b = block_of(features[k]);
        product(static_cast<Eigen::Index>(k)) = b.product(features[k] - b.first);
    }
    return product;
}

/// Columns of features side by side; not copied if they are already adjacent.
Eigen::Map<const Eigen::MatrixXd> Design::gathered(const std::vector<Eigen::Index>& list,
                                                   Eigen::MatrixXd Block::*part,
                                                   Eigen::MatrixXd& storage) const {
    const auto count = static_cast<Eigen::Index>(list.size());
    const Block& first = block_of(list.front());
    const Eigen::Index rows = (first.*part).rows(), at = list.front() - first.first;
    bool together = at + count <= (first.*part).cols();
    for (Eigen::Index k = 0; k < count; ++k)
        together = together && list[static_cast<std::size_t>(k)] == list.front() + k;
    if (together) return {(first.*part).data() + rows * at, rows, count};
    storage.resize(rows, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Eigen::Index feature = list[static_cast<std::size_t>(k)];
        const Block& b = block_of(feature);
        storage.col(k) = (b.*part).col(feature - b.first);
    }
    return {storage.data(), rows, count};
}

Eigen::MatrixXd Design::gram_of(const std::vector<Eigen::Index>& a,
                                const std::vector<Eigen::Index>& b) const {
    if (a.empty() || b.empty())
        return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(a.size()),
                                     static_cast<Eigen::Index>(b.size()));
    Eigen::MatrixXd sa, sb;
    Eigen::MatrixXd gram =
        gathered(a, &Block::white, sa).transpose() * gathered(b, &Block::white, sb);
    gram.noalias() -=
        gathered(a, &Block::coordinates, sa).transpose() * gathered(b, &Block::coordinates, sb);
    return gram;
}

/// Consecutive groups share features (the correlation lengths of a table), so the last products are
/// cached.
const Design::Products& Design::of_features(const std::vector<Eigen::Index>& features) {
    if (last_.features == features) return last_;
    last_ = {features, gram_of(features, features), {}};
    last_.whole.resize(static_cast<Eigen::Index>(features.size()));
    for (std::size_t k = 0; k < features.size(); ++k) {
        const Block& b = block_of(features[k]);
        last_.whole(static_cast<Eigen::Index>(k)) =
            b.white.col(features[k] - b.first).squaredNorm();
    }
    return last_;
}

std::size_t Design::add(ColumnGroup group) {
    const Products& p = of_features(group.features);
    Entry entry;
    entry.gram = p.gram;
    entry.product = product_of(group.features);
    entry.whole = p.whole.sum();
    if (group.shape.size() > 0) {
        entry.gram = group.shape.transpose() * p.gram * group.shape;
        entry.product = group.shape.transpose() * entry.product;
        entry.whole = p.whole.dot(group.shape.array().square().matrix().rowwise().sum());
    }
    entry.group = std::move(group);
    return append(std::move(entry));
}

std::size_t Design::append(Entry entry) {
    entry.first = columns_;
    columns_ += entry.group.columns();
    entry.reduced.emplace(entry.gram);
    products_.conservativeResize(columns_);
    products_.tail(entry.product.size()) = entry.product;
    groups_.push_back(std::move(entry));
    return groups_.size() - 1;
}

const Eigen::MatrixXd& Design::owned_inverse(Eigen::Index owned) const {
    if (inverse_.rows() == owned) return inverse_;
    const auto list = first_features(owned);
    inverse_ =
        estimation::solve_ranked(gram_of(list, list), Eigen::VectorXd::Zero(owned)).covariance;
    return inverse_;
}

namespace {

/// Projection on the directions that others leave of a group's columns: what rounding leaves of a
/// column that others follow wholly is none. `left`, `alone`: grams beside the others and without.
Eigen::MatrixXd own_directions(const Eigen::MatrixXd& left, const Eigen::MatrixXd& alone) {
    constexpr double least_part = 1e-6;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(left);
    const double least = least_part * alone.trace() / static_cast<double>(alone.rows());
    const Eigen::VectorXd kept =
        (solver.eigenvalues().array() > least).select(Eigen::VectorXd::Ones(left.rows()), 0.0);
    return solver.eigenvectors() * kept.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

std::size_t Design::add_beside(ColumnGroup group, Eigen::Index owned) {
    const auto list = first_features(owned);
    const Eigen::MatrixXd cross = gram_of(list, group.features);
    const Eigen::MatrixXd taken = owned_inverse(owned) * cross;
    Entry entry;
    const Eigen::MatrixXd alone = gram_of(group.features, group.features);
    const Eigen::MatrixXd rest = own_directions(alone - cross.transpose() * taken, alone);
    entry.gram = rest.transpose() * (alone - cross.transpose() * taken) * rest;
    entry.product =
        rest.transpose() * (product_of(group.features) - taken.transpose() * product_of(list));
    entry.whole = alone.trace();
    group.shape.resize(owned + group.columns(), group.columns());
    group.shape << -taken * rest, rest;
    group.features.insert(group.features.begin(), list.begin(), list.end());
    entry.group = std::move(group);
    return append(std::move(entry));
}

double Design::outside(std::size_t k, const std::vector<Eigen::Index>& features) const {
    const ColumnGroup& group = groups_[k].group;
    Eigen::MatrixXd cross = gram_of(features, group.features);
    if (group.shape.size() > 0) cross = (cross * group.shape).eval();
    const estimation::LinearFit all =
        estimation::solve_ranked(gram_of(features, features), Eigen::VectorXd::Zero(cross.rows()));
    const double inside = (all.covariance * cross).cwiseProduct(cross).sum();
    return 1.0 - inside / std::max(1e-300, groups_[k].gram.trace());
}

Eigen::MatrixXd Design::columns(std::size_t k) const {
    const ColumnGroup& group = groups_[k].group;
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::white, storage);
    Eigen::MatrixXd own =
        group.shape.size() > 0 ? Eigen::MatrixXd(raw * group.shape) : Eigen::MatrixXd(raw);
    return group.kind == GroupKind::driver ? projection_.beside(own) : own;
}

Eigen::VectorXd Design::combined(std::size_t k, const Eigen::VectorXd& coefficients) const {
    const ColumnGroup& group = groups_[k].group;
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::white, storage);
    if (group.shape.size() == 0) return raw * coefficients;
    return raw * (group.shape * coefficients);
}

const Eigen::MatrixXd& Design::products(std::size_t member) {
    Seen& seen = seen_[member];
    if (seen.groups == groups_.size()) return seen.products;
    const Eigen::MatrixXd own = projection_.beside(columns(member));
    std::map<Eigen::Index, Eigen::MatrixXd> by_block;
    seen.products.conservativeResize(columns_, own.cols());
    for (; seen.groups < groups_.size(); ++seen.groups) {
        const Entry& entry = groups_[seen.groups];
        const auto& features = entry.group.features;
        Eigen::MatrixXd raw(static_cast<Eigen::Index>(features.size()), own.cols());
        for (std::size_t k = 0; k < features.size(); ++k) {
            const Block& b = block_of(features[k]);
            Eigen::MatrixXd& with = by_block[b.first];
            if (with.size() == 0) with.noalias() = b.white.transpose() * own;
            raw.row(static_cast<Eigen::Index>(k)) = with.row(features[k] - b.first);
        }
        auto rows = seen.products.middleRows(entry.first, entry.group.columns());
        if (entry.group.shape.size() > 0)
            rows.noalias() = entry.group.shape.transpose() * raw;
        else
            rows = raw;
    }
    return seen.products;
}

const Eigen::MatrixXd& Design::coordinates(std::size_t member) {
    Eigen::MatrixXd& own = seen_[member].coordinates;
    const ColumnGroup& group = groups_[member].group;
    if (own.cols() == group.columns()) return own;
    if (group.kind == GroupKind::driver)
        return own = Eigen::MatrixXd::Zero(projection_.rank(), group.columns());
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::coordinates, storage);
    own = group.shape.size() > 0 ? Eigen::MatrixXd(raw * group.shape) : Eigen::MatrixXd(raw);
    return own;
}

Eigen::MatrixXd Design::cross(const std::vector<std::size_t>& members,
                              const std::vector<std::size_t>& groups) {
    Eigen::Index rows = 0, columns = 0;
    for (const std::size_t m : members) rows += groups_[m].group.columns();
    for (const std::size_t g : groups) columns += groups_[g].group.columns();
    Eigen::MatrixXd cross(rows, columns);
    Eigen::Index row = 0;
    for (const std::size_t m : members) {
        const Eigen::MatrixXd& own = products(m);
        Eigen::Index column = 0;
        for (const std::size_t g : groups) {
            const Eigen::Index count = groups_[g].group.columns();
            cross.block(row, column, own.cols(), count) =
                own.middleRows(groups_[g].first, count).transpose();
            column += count;
        }
        row += own.cols();
    }
    return cross;
}

estimation::GroupEquations Design::equations(const std::vector<std::size_t>& members) {
    estimation::GroupEquations e;
    for (const std::size_t m : members) e.size.push_back(groups_[m].group.columns());
    e.product.resize(e.first(members.size()));
    for (std::size_t k = 0; k < members.size(); ++k)
        e.product.segment(e.first(k), e.size[k]) = groups_[members[k]].product;
    const Eigen::MatrixXd gram = cross(members, members);
    e.gram = 0.5 * (gram + gram.transpose());
    e.square = data_.squaredNorm() - data_coordinates_.squaredNorm();
    e.rows = freedom();
    return e;
}

Eigen::VectorXd Design::left(const std::vector<std::size_t>& members,
                             const Eigen::VectorXd& coefficients) {
    Eigen::VectorXd left = products_;
    Eigen::Index at = 0;
    for (const std::size_t m : members) {
        const Eigen::MatrixXd& own = products(m);
        left.noalias() -= own * coefficients.segment(at, own.cols());
        at += own.cols();
    }
    return left;
}

Design::Normal Design::normal(const std::vector<std::size_t>& members) {
    const estimation::GroupEquations beside = equations(members);
    const Eigen::Index known = known_.cols(), own = beside.product.size();
    Eigen::MatrixXd inside(projection_.rank(), known + own);
    inside.leftCols(known) = known_coordinates_;
    for (std::size_t k = 0; k < members.size(); ++k)
        inside.middleCols(known + beside.first(k), beside.size[k]) = coordinates(members[k]);
    Normal n{inside.transpose() * inside, inside.transpose() * data_coordinates_};
    n.gram.bottomRightCorner(own, own) += beside.gram;
    n.product.tail(own) += beside.product;
    return n;
}

}  // namespace trunnion::diagnosis
