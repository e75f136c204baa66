#include "diagnosis/design.h"

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
      data_coordinates_(projection_.coordinates(data_)) {}

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

void Design::set_data(const Eigen::VectorXd& data) {
    data_ = data;
    data_coordinates_ = projection_.coordinates(data_);
    for (Block& b : blocks_)
        b.product = b.white.transpose() * data_ - b.coordinates.transpose() * data_coordinates_;
    for (Entry& e : groups_) {
        e.product = product_of(e.group.features);
        if (e.group.shape.size() > 0) e.product = e.group.shape.transpose() * e.product;
    }
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

/// Columns of features side by side; without a copy where they stand side by side already.
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

/// Neighbours share features (the lengths of a table): their products are worked out once.
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
    Entry entry{{}, p.gram, product_of(group.features), p.whole.sum(), false};
    if (group.shape.size() > 0) {
        entry.gram = group.shape.transpose() * p.gram * group.shape;
        entry.product = group.shape.transpose() * entry.product;
        entry.whole = p.whole.dot(group.shape.array().square().matrix().rowwise().sum());
    }
    entry.group = std::move(group);
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

std::size_t Design::add_beside(ColumnGroup group, Eigen::Index owned) {
    const auto list = first_features(owned);
    const Eigen::MatrixXd cross = gram_of(list, group.features);
    const Eigen::MatrixXd taken = owned_inverse(owned) * cross;
    Entry entry;
    entry.gram = gram_of(group.features, group.features) - cross.transpose() * taken;
    entry.product = product_of(group.features) - taken.transpose() * product_of(list);
    entry.whole = entry.gram.trace();
    const Eigen::Index own = group.columns();
    group.shape.resize(owned + own, own);
    group.shape << -taken, Eigen::MatrixXd::Identity(own, own);
    group.features.insert(group.features.begin(), list.begin(), list.end());
    entry.group = std::move(group);
    groups_.push_back(std::move(entry));
    return groups_.size() - 1;
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
    Eigen::MatrixXd m(data_.size(), static_cast<Eigen::Index>(group.features.size()));
    for (std::size_t j = 0; j < group.features.size(); ++j) {
        const Block& b = block_of(group.features[j]);
        m.col(static_cast<Eigen::Index>(j)) = b.white.col(group.features[j] - b.first);
    }
    if (group.shape.size() == 0) return m;
    return m * group.shape;
}

const Eigen::MatrixXd& Design::products(std::size_t member) {
    Eigen::MatrixXd& p = products_[member];
    const Eigen::Index have = p.rows();
    if (have == features_) return p;
    const Eigen::MatrixXd own = projection_.beside(columns(member));
    p.conservativeResize(features_, own.cols());
    for (const Block& b : blocks_)
        if (b.first >= have)
            p.middleRows(b.first, b.white.cols()).noalias() = b.white.transpose() * own;
    return p;
}

Eigen::MatrixXd Design::cross(const std::vector<std::size_t>& members, std::size_t other) {
    const ColumnGroup& group = groups_[other].group;
    Eigen::Index rows = 0;
    for (const std::size_t m : members) rows += groups_[m].group.columns();
    Eigen::MatrixXd cross(rows, group.columns());
    Eigen::Index at = 0;
    for (const std::size_t m : members) {
        const Eigen::MatrixXd part = products(m)(group.features, Eigen::all);
        const Eigen::Index count = part.cols();
        if (group.shape.size() > 0)
            cross.middleRows(at, count).noalias() = part.transpose() * group.shape;
        else
            cross.middleRows(at, count) = part.transpose();
        at += count;
    }
    return cross;
}

estimation::GroupEquations Design::equations(const std::vector<std::size_t>& members) {
    estimation::GroupEquations e;
    for (const std::size_t m : members) e.size.push_back(groups_[m].group.columns());
    const Eigen::Index all = e.first(members.size());
    e.gram.resize(all, all);
    e.product.resize(all);
    for (std::size_t k = 0; k < members.size(); ++k) {
        e.gram.middleCols(e.first(k), e.size[k]) = cross(members, members[k]);
        e.product.segment(e.first(k), e.size[k]) = groups_[members[k]].product;
    }
    e.gram = (0.5 * (e.gram + e.gram.transpose())).eval();
    e.square = data_.squaredNorm() - data_coordinates_.squaredNorm();
    e.rows = freedom();
    return e;
}

}  // namespace trunnion::diagnosis
