#include "diagnosis/search/design.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

#include "estimation/inner_products.h"
#include "estimation/ranked_least_squares.h"
#include "estimation/sparse_products.h"

namespace trunnion::diagnosis {
namespace {

constexpr double visible_part = 0.02, visible_square = 1e-4;
/// Of an effect with keys: most of a drift is a shift, which zeros of tests and centres take up;
/// its course is left.
constexpr double visible_part_keyed = 0.002;
constexpr double mostly_zero = 0.75;  ///< fraction of zeros from which products leave them out

bool is_shaped(const ColumnGroup& group) {
    return group.shape.size() > 0;
}

std::vector<Eigen::Index> first_features(Eigen::Index count) {
    std::vector<Eigen::Index> list(static_cast<std::size_t>(count));
    std::iota(list.begin(), list.end(), Eigen::Index{0});
    return list;
}

}  // namespace

bool Design::Entry::moves_readings() const {
    const double seen = gram.trace();
    const double part = group.kind == GroupKind::periodic ? visible_part_keyed : visible_part;
    return seen > visible_square && seen > part * part * whole;
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
    if (const auto zeros = (white.array() == 0.0).count();
        static_cast<double>(zeros) > mostly_zero * static_cast<double>(white.size()))
        block.sparse = block.white.sparseView();
    block.coordinates = block.sparse.size() > 0
                            ? Eigen::MatrixXd(projection_.basis().transpose() * block.sparse)
                            : projection_.coordinates(block.white);
    features_ += white.cols();
    products_.conservativeResize(features_);
    products_.tail(white.cols()) = block.white.transpose() * data_;
    products_.tail(white.cols()).noalias() -= block.coordinates.transpose() * data_coordinates_;
    squares_.conservativeResize(features_);
    squares_.tail(white.cols()) = block.white.colwise().squaredNorm().transpose();
    blocks_.push_back(std::move(block));
    return blocks_.back().first;
}

std::size_t Design::block_index(Eigen::Index feature) const {
    const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), feature,
                                        [](Eigen::Index f, const Block& b) { return f < b.first; });
    return static_cast<std::size_t>(std::prev(after) - blocks_.begin());
}

std::vector<Design::Run> Design::runs_of(const std::vector<Eigen::Index>& features) const {
    std::vector<Run> runs;
    for (std::size_t k = 0; k < features.size(); ++k) {
        const std::size_t block = block_index(features[k]);
        const Eigen::Index inside = features[k] - blocks_[block].first;
        if (!runs.empty() && runs.back().block == block &&
            inside == runs.back().first + runs.back().count)
            ++runs.back().count;
        else
            runs.push_back({block, static_cast<Eigen::Index>(k), inside, 1});
    }
    return runs;
}

Eigen::MatrixXd Design::products_of(const Block& a, const Block& b) {
    if (a.sparse.size() > 0 && b.sparse.size() > 0)
        return Eigen::MatrixXd(a.sparse.transpose() * b.sparse);
    if (a.sparse.size() > 0) return estimation::sparse_products(b.white, a.sparse).transpose();
    if (b.sparse.size() > 0) return estimation::sparse_products(a.white, b.sparse);
    return &a == &b ? estimation::inner_products(a.white)
                    : estimation::inner_products(a.white, b.white);
}

/// Products of the features of two blocks, set-up projected out.
const Eigen::MatrixXd& Design::between(std::size_t first, std::size_t second) const {
    Eigen::MatrixXd& gram = between_[{first, second}];
    if (gram.size() > 0) return gram;
    const Block &a = blocks_[first], &b = blocks_[second];
    gram = products_of(a, b);
    gram.noalias() -= a.coordinates.transpose() * b.coordinates;
    return gram;
}

Eigen::VectorXd Design::product_of(const std::vector<Eigen::Index>& features) const {
    return products_(features);
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

Eigen::MatrixXd Design::gram_of(const std::vector<Run>& a, const std::vector<Run>& b) const {
    const auto length = [](const std::vector<Run>& runs) {
        return runs.empty() ? 0 : runs.back().at + runs.back().count;
    };
    Eigen::MatrixXd gram(length(a), length(b));
    for (const Run& r : a)
        for (const Run& c : b) {
            auto part = gram.block(r.at, c.at, r.count, c.count);
            if (r.block <= c.block)
                part = between(r.block, c.block).block(r.first, c.first, r.count, c.count);
            else
                part =
                    between(c.block, r.block).block(c.first, r.first, c.count, r.count).transpose();
        }
    return gram;
}

std::size_t Design::add(ColumnGroup group) {
    Entry entry;
    entry.runs = runs_of(group.features);
    entry.gram = gram_of(entry.runs, entry.runs);
    entry.product = product_of(group.features);
    const Eigen::VectorXd whole = squares_(group.features);
    entry.whole = whole.sum();
    if (is_shaped(group)) {
        entry.gram = Eigen::MatrixXd(group.shape.transpose() * entry.gram * group.shape);
        entry.product = Eigen::VectorXd(group.shape.transpose() * entry.product);
        entry.whole = whole.dot(group.shape.array().square().matrix().rowwise().sum());
    }
    entry.group = std::move(group);
    return append(std::move(entry));
}

std::size_t Design::append(Entry entry) {
    entry.reduced.emplace(entry.gram);
    groups_.push_back(std::move(entry));
    return groups_.size() - 1;
}

const Eigen::MatrixXd& Design::owned_inverse(Eigen::Index owned) const {
    if (inverse_.rows() == owned) return inverse_;
    const std::vector<Run> runs = runs_of(first_features(owned));
    inverse_ =
        estimation::solve_ranked(gram_of(runs, runs), Eigen::VectorXd::Zero(owned)).covariance;
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
    const std::vector<Run> runs = runs_of(group.features);
    const Eigen::MatrixXd cross = gram_of(runs_of(list), runs);
    const Eigen::MatrixXd taken = owned_inverse(owned) * cross;
    Entry entry;
    const Eigen::MatrixXd alone = gram_of(runs, runs);
    const Eigen::MatrixXd rest = own_directions(alone - cross.transpose() * taken, alone);
    entry.gram = rest.transpose() * (alone - cross.transpose() * taken) * rest;
    entry.product =
        rest.transpose() * (product_of(group.features) - taken.transpose() * product_of(list));
    entry.whole = alone.trace();
    group.shape.resize(owned + group.columns(), group.columns());
    group.shape << -taken * rest, rest;
    group.features.insert(group.features.begin(), list.begin(), list.end());
    entry.runs = runs_of(group.features);
    entry.group = std::move(group);
    return append(std::move(entry));
}

const Eigen::MatrixXd& Design::columns(std::size_t k) const {
    Eigen::MatrixXd& own = columns_[k];
    if (own.size() == 0) own = worked_out(k);
    return own;
}

Eigen::MatrixXd Design::worked_out(std::size_t k) const {
    const ColumnGroup& group = groups_[k].group;
    if (const std::vector<Run>& runs = groups_[k].runs; runs.size() == 1 && is_shaped(group))
        if (const auto& sparse = blocks_[runs.front().block].sparse;
            runs.front().count == sparse.cols())
            return sparse * group.shape;
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::white, storage);
    Eigen::MatrixXd own =
        is_shaped(group) ? Eigen::MatrixXd(raw * group.shape) : Eigen::MatrixXd(raw);
    return group.kind == GroupKind::driver ? projection_.beside(own) : own;
}

Eigen::VectorXd Design::combined(std::size_t k, const Eigen::VectorXd& coefficients) const {
    const ColumnGroup& group = groups_[k].group;
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::white, storage);
    if (!is_shaped(group)) return raw * coefficients;
    return raw * (group.shape * coefficients);
}

/// Products of the columns of two groups, the first not after the second.
const Eigen::MatrixXd& Design::products(std::size_t first, std::size_t second) {
    Eigen::MatrixXd& own = products_of_[{first, second}];
    if (own.size() > 0) return own;
    const Entry &a = groups_[first], &b = groups_[second];
    own = gram_of(a.runs, b.runs);
    // By moves: Eigen frees a matrix before it has the memory for another size, and a failure then
    // leaves the freed one behind.
    if (is_shaped(b.group)) own = Eigen::MatrixXd(own * b.group.shape);
    if (is_shaped(a.group)) own = Eigen::MatrixXd(a.group.shape.transpose() * own);
    return own;
}

const Eigen::MatrixXd& Design::coordinates(std::size_t member) {
    Eigen::MatrixXd& own = coordinates_[member];
    const ColumnGroup& group = groups_[member].group;
    if (own.cols() == group.columns()) return own;
    if (group.kind == GroupKind::driver)
        return own = Eigen::MatrixXd::Zero(projection_.rank(), group.columns());
    Eigen::MatrixXd storage;
    const auto raw = gathered(group.features, &Block::coordinates, storage);
    own = is_shaped(group) ? Eigen::MatrixXd(raw * group.shape) : Eigen::MatrixXd(raw);
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
        const Eigen::Index height = groups_[m].group.columns();
        Eigen::Index column = 0;
        for (const std::size_t g : groups) {
            const Eigen::Index width = groups_[g].group.columns();
            auto part = cross.block(row, column, height, width);
            if (m <= g)
                part = products(m, g);
            else
                part = products(g, m).transpose();
            column += width;
        }
        row += height;
    }
    return cross;
}

estimation::GroupEquations Design::equations(const std::vector<std::size_t>& members) {
    estimation::GroupEquations e;
    for (const std::size_t m : members) e.size.push_back(groups_[m].group.columns());
    e.product.resize(e.first(members.size()));
    for (std::size_t k = 0; k < members.size(); ++k)
        e.product.segment(e.first(k), e.size[k]) = groups_[members[k]].product;
    e.gram.resize(e.product.size(), e.product.size());
    for (std::size_t b = 0; b < members.size(); ++b)
        for (std::size_t a = 0; a <= b; ++a) {
            auto part = e.gram.block(e.first(a), e.first(b), e.size[a], e.size[b]);
            if (a == b) {
                const Eigen::MatrixXd& own = products(members[a], members[a]);
                part = 0.5 * (own + own.transpose());
                continue;
            }
            if (members[a] <= members[b])
                part = products(members[a], members[b]);
            else
                part = products(members[b], members[a]).transpose();
            e.gram.block(e.first(b), e.first(a), e.size[b], e.size[a]) = part.transpose();
        }
    e.square = data_.squaredNorm() - data_coordinates_.squaredNorm();
    e.rows = freedom();
    return e;
}

std::shared_ptr<HeldMembers> Design::held(const std::vector<std::size_t>& members,
                                          const estimation::Variances& variances) {
    constexpr std::size_t kept = 4;
    const auto at = std::find_if(held_.begin(), held_.end(), [&](const auto& held) {
        return held->members == members && held->variances == variances;
    });
    if (at != held_.end()) {
        std::rotate(held_.begin(), at, std::next(at));
        return held_.front();
    }
    estimation::GroupEquations own = equations(members);
    estimation::GivenMembers given(own, variances);
    held_.push_front(std::make_shared<HeldMembers>(
        HeldMembers{members, variances, std::move(own), std::move(given), {}, {}}));
    if (held_.size() > kept) held_.pop_back();
    return held_.front();
}

/// Marks the blocks that hold features of these groups.
std::vector<bool> Design::blocks_with(const std::vector<std::size_t>& groups) const {
    std::vector<bool> marked(blocks_.size(), false);
    for (const std::size_t k : groups)
        for (const Run& run : groups_[k].runs) marked[run.block] = true;
    return marked;
}

Eigen::VectorXd Design::left(const std::vector<std::size_t>& members,
                             const Eigen::VectorXd& coefficients,
                             const std::vector<std::size_t>& groups) {
    Eigen::VectorXd fitted = Eigen::VectorXd::Zero(features_), left = products_;
    Eigen::Index at = 0;
    for (const std::size_t m : members) {
        const ColumnGroup& group = groups_[m].group;
        const auto own = coefficients.segment(at, group.columns());
        if (is_shaped(group))
            fitted(group.features) += group.shape * own;
        else
            fitted(group.features) += own;
        at += group.columns();
    }
    const std::vector<bool> moved = blocks_with(members), asked = blocks_with(groups);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
        if (!moved[k]) continue;
        const auto own = fitted.segment(blocks_[k].first, blocks_[k].white.cols());
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (!asked[b]) continue;
            auto part = left.segment(blocks_[b].first, blocks_[b].white.cols());
            if (b <= k)
                part.noalias() -= between(b, k) * own;
            else
                part.noalias() -= between(k, b).transpose() * own;
        }
    }
    return left;
}

Eigen::VectorXd Design::of_group(std::size_t k, const Eigen::VectorXd& left) const {
    const ColumnGroup& group = groups_[k].group;
    const Eigen::VectorXd own = left(group.features);
    if (!is_shaped(group)) return own;
    return group.shape.transpose() * own;
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
