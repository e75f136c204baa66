#include "diagnosis/verdict/shares.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr double with_others = 0.25;  ///< of its square: less goes against the others (assumed)

bool is_here(const ColumnGroup& group) {
    return is_cause(group.kind) && !group.is_change();
}

/// True where a cause of size does hardly anything along the sum of all.
bool cancel(const Design& design, const Model& model, const Sizes& sizes) {
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (is_here(design.group(model.members[k])) &&
            sizes.square[k] > rules::least_share * sizes.whole &&
            sizes.along[k] < with_others * sizes.square[k])
            return true;
    return false;
}

/// What causes do together, and how much of it some of them explain.
class Together {
  public:
    Together(Design& design, const Model& model)
        : fit_(fit_of(design, model)), gram_(design.equations(model.members).gram) {
        Eigen::VectorXd mean = fit_.mean;
        precision_.resize(mean.size());
        for (std::size_t k = 0; k < model.members.size(); ++k) {
            const double ratio = model.variances.nu / std::max(1e-9, model.variances.tau[k]);
            precision_.segment(fit_.first[k], fit_.size[k]).setConstant(ratio * ratio);
            if (!is_here(design.group(model.members[k])))
                mean.segment(fit_.first[k], fit_.size[k]).setZero();
        }
        product_ = gram_ * mean;
    }

    /// Squares that the members explain of the sum.
    double explained(const std::vector<std::size_t>& members) const {
        std::vector<Eigen::Index> at;
        for (const std::size_t k : members)
            for (Eigen::Index j = 0; j < fit_.size[k]; ++j) at.push_back(fit_.first[k] + j);
        if (at.empty()) return 0.0;
        const Eigen::MatrixXd gram = gram_(at, at);
        const Eigen::VectorXd product = product_(at), precision = precision_(at);
        const Eigen::VectorXd x =
            (gram + Eigen::MatrixXd(precision.asDiagonal())).llt().solve(product);
        return 2.0 * x.dot(product) - x.dot(gram * x);
    }

  private:
    Fit fit_;
    Eigen::MatrixXd gram_;
    Eigen::VectorXd product_, precision_;
};

/// The mean of what each cause explains as the first and as the last one.
std::vector<double> first_and_last(Design& design, const Model& model) {
    const Together together(design, model);
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (is_here(design.group(model.members[k]))) all.push_back(k);
    std::vector<double> squares(model.members.size(), 0.0);
    const double whole = together.explained(all);
    for (const std::size_t k : all) {
        std::vector<std::size_t> rest = all;
        rest.erase(std::find(rest.begin(), rest.end(), k));
        squares[k] =
            std::max(0.0, 0.5 * (together.explained({k}) + whole - together.explained(rest)));
    }
    return squares;
}

}  // namespace

std::vector<double> shares_of(Design& design, const Model& model, const Sizes& sizes) {
    std::vector<double> squares = sizes.along;
    if (cancel(design, model, sizes)) {
        const std::vector<double> own = first_and_last(design, model);
        double sum = 0.0, together = 0.0;
        for (std::size_t k = 0; k < own.size(); ++k) {
            if (!is_here(design.group(model.members[k]))) continue;
            sum += own[k];
            together += sizes.along[k];
        }
        for (std::size_t k = 0; k < own.size(); ++k)
            if (is_here(design.group(model.members[k])) && sum > 0.0)
                squares[k] = own[k] / sum * std::max(0.0, together);
    }
    for (double& square : squares)
        square = std::clamp(square / std::max(1e-12, sizes.whole), 0.0, 1.0);
    return squares;
}

}  // namespace trunnion::diagnosis
