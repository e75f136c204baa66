#include "choices/own_pairs.h"

#include <cmath>

#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr double moves_from = 1e-6;  ///< mm or deg: less is no move of an axis

}  // namespace

std::vector<const Pair*> own_pairs(const LogView& view, const ComparedRun& run) {
    const Space space(view.axes);
    std::vector<const Pair*> out(view.rows.size(), nullptr);
    for (const Pair& pair : run.pairs) {
        const Pair*& own = out[pair.row];
        const bool nearer =
            own != nullptr && space.square(pair.apart, {}) <= space.square(own->apart, {});
        if (own == nullptr || (pair.slides && !own->slides) ||
            (pair.slides == own->slides && nearer))
            own = &pair;
    }
    return out;
}

Eigen::MatrixXd shown_by(const LogView& view, const ComparedRun& run, const Pair& pair) {
    const auto n = static_cast<Eigen::Index>(view.axes.size());
    Eigen::MatrixXd out = Eigen::MatrixXd::Identity(n, n);
    if (!pair.slides) return out;
    Eigen::VectorXd way(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Axis axis = view.axes[static_cast<std::size_t>(k)];
        way[k] = run.path.nodes[pair.node].at[axis] - run.path.nodes[pair.node - 1].at[axis];
    }
    if (way.squaredNorm() > 0.0) out -= way * way.transpose() / way.squaredNorm();
    return out;
}

std::size_t first_move(const ControlPath& path, Axis axis) {
    std::size_t node = 0;
    while (node < path.nodes.size() &&
           std::abs(path.nodes[node].at[axis] - path.nodes.front().at[axis]) < moves_from)
        ++node;
    return node;
}

}  // namespace trunnion::choices
