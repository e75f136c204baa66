#include "identification/key_gain.h"

namespace trunnion::identification {
namespace {

/// Columns are derivatives for one typical change: a direction that moves all readings together by
/// less than this number of sigma is unobservable (the threshold of solve_ranked).
constexpr double unseen_sigma = 0.05;

Eigen::MatrixXd joined(const Eigen::MatrixXd& base, const Eigen::MatrixXd& beside) {
    if (beside.cols() == 0) return base;
    Eigen::MatrixXd all(base.rows(), base.cols() + beside.cols());
    all << base, beside;
    return all;
}

}  // namespace

KeyGain::KeyGain(const emulator::Replay& replay, const BaseModel& base,
                 const Eigen::VectorXd& left_mm, const Eigen::MatrixXd& beside_mm)
    : replay_(replay),
      base_(base),
      weight_(base.sigma_mm.cwiseInverse()),
      left_(left_mm.cwiseProduct(weight_)),
      known_(weight_.asDiagonal() * joined(base.columns, beside_mm)) {}

double KeyGain::operator()(const std::vector<KeyedEffect>& effects) const {
    std::vector<Eigen::VectorXd> list;
    for (const KeyedEffect& e : effects)
        for (std::size_t j = 0; j < e.values.size(); ++j)
            if (!e.effect->parameters[j].is_key())
                list.push_back(effect_column(replay_, base_.gradient, {*e.effect, e.values, j})
                                   .cwiseProduct(weight_));
    Eigen::MatrixXd columns(left_.size(), static_cast<Eigen::Index>(list.size()));
    for (std::size_t c = 0; c < list.size(); ++c)
        columns.col(static_cast<Eigen::Index>(c)) = list[c];
    return estimation::explained_beside(known_, columns, left_, unseen_sigma);
}

}  // namespace trunnion::identification
