#include "diagnosis/search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace trunnion {
namespace {

constexpr std::array<double, 4> prior_scales{0.3, 1.0, 3.0, 10.0};

bool shares_effect(const Design& design, const std::vector<std::size_t>& members, std::size_t k) {
    const auto& candidates = design.candidates();
    return std::any_of(members.begin(), members.end(),
                       [&](std::size_t m) { return candidates[m].effect == candidates[k].effect; });
}

}  // namespace

std::vector<Eigen::Index> columns_of(const Design& design,
                                     const std::vector<std::size_t>& members) {
    std::vector<Eigen::Index> columns;
    for (const std::size_t m : members) {
        const Candidate& c = design.candidates()[m];
        for (Eigen::Index j = 0; j < c.size(); ++j) columns.push_back(c.first + j);
    }
    return columns;
}

EffectSet evaluate(const Design& design, std::vector<std::size_t> members,
                   const SearchOptions& options) {
    EffectSet set;
    set.members = std::move(members);
    if (set.members.empty()) return set;
    const std::vector<Eigen::Index> columns = columns_of(design, set.members);
    const auto p = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd g(p, p);
    Eigen::VectorXd h(p);
    for (Eigen::Index i = 0; i < p; ++i) {
        const Eigen::Index ci = columns[static_cast<std::size_t>(i)];
        h(i) = design.product()(ci);
        for (Eigen::Index j = 0; j < p; ++j)
            g(i, j) = design.gram()(ci, columns[static_cast<std::size_t>(j)]);
    }
    std::array<double, prior_scales.size()> log_value{};
    double most = -1e300;
    for (std::size_t k = 0; k < prior_scales.size(); ++k) {
        const double precision = options.noise_variance / (prior_scales[k] * prior_scales[k]);
        Eigen::MatrixXd m = g;
        m.diagonal().array() += precision;
        const Eigen::LLT<Eigen::MatrixXd> llt(m);
        const Eigen::VectorXd x = llt.matrixL().solve(h);
        const double log_det = 2.0 * llt.matrixLLT().diagonal().array().log().sum() -
                               static_cast<double>(p) * std::log(precision);
        log_value[k] = 0.5 * x.squaredNorm() / options.noise_variance - 0.5 * log_det;
        if (log_value[k] <= most) continue;
        most = log_value[k];
        set.scale = prior_scales[k];
        set.explained = x.squaredNorm();
    }
    double sum = 0.0;
    for (const double v : log_value) sum += std::exp(v - most);
    set.log_evidence = most + std::log(sum / static_cast<double>(prior_scales.size()));
    for (const std::size_t m : set.members) set.log_evidence += design.candidates()[m].log_prior;
    return set;
}

std::vector<EffectSet> search_sets(const Design& design, const SearchOptions& options) {
    const auto better = [](const EffectSet& a, const EffectSet& b) {
        return a.log_evidence != b.log_evidence ? a.log_evidence > b.log_evidence
                                                : a.members < b.members;
    };
    std::vector<EffectSet> all{EffectSet{}}, beam{EffectSet{}};
    std::set<std::vector<std::size_t>> met;
    for (std::size_t size = 1; size <= options.largest; ++size) {
        std::vector<EffectSet> grown;
        for (const EffectSet& set : beam)
            for (std::size_t k = 0; k < design.candidates().size(); ++k) {
                if (!design.candidates()[k].visible || shares_effect(design, set.members, k))
                    continue;
                std::vector<std::size_t> members = set.members;
                members.insert(std::upper_bound(members.begin(), members.end(), k), k);
                if (!met.insert(members).second) continue;
                grown.push_back(evaluate(design, std::move(members), options));
            }
        std::sort(grown.begin(), grown.end(), better);
        all.insert(all.end(), grown.begin(), grown.end());
        if (grown.empty()) break;
        const double before = beam.front().log_evidence;
        // All single effects go on to pairs: a pair may beat what neither of its members does
        // alone.
        if (size > 1 && grown.size() > options.width) grown.resize(options.width);
        beam = std::move(grown);
        if (beam.front().log_evidence < before - 10.0) break;
    }
    std::sort(all.begin(), all.end(), better);
    return all;
}

}  // namespace trunnion
