#include "diagnosis/set_up_report.h"

#include <cmath>

#include "diagnosis/prepare/usual_zero.h"
#include "identification/index_errors.h"
#include "identification/set_up_words.h"
#include "identification/time_constants.h"

namespace trunnion::diagnosis {
namespace {

/// How far the zeros of single tests scatter, where that is noise and no place of the gap.
std::vector<identification::FitParameter> zero_scatter_of(const Outcome& f) {
    std::vector<identification::FitParameter> list;
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const ColumnGroup& group = f.design.group(f.model.members[k]);
        if (group.kind != GroupKind::offset || f.judgement.large[k]) continue;
        identification::FitParameter p;
        p.effect = "setup";
        p.of_set_up = true;
        p.name = "scatter of the " + group.name;
        p.unit = "mm";
        p.value = usual_zero_mm * f.model.variances.tau[k];
        p.sigma =
            p.value / std::sqrt(2.0 * std::max<double>(1.0, static_cast<double>(group.columns())));
        list.push_back(p);
    }
    return list;
}

}  // namespace

void describe_set_up(const Outcome& f, const Solution& solution, Diagnosis& d) {
    const identification::BaseModel& base = f.prepared.base;
    const Eigen::MatrixXd covariance = solution.covariance();
    for (std::size_t j = 0; j < base.parameters.size(); ++j) {
        identification::FitParameter p = base.parameters[j];
        if (!p.of_set_up) continue;
        const auto k = static_cast<Eigen::Index>(j);
        p.value = identification::number_of(d.setup, p.set_up);
        if (std::isfinite(p.sigma)) p.sigma = p.typical * std::sqrt(covariance(k, k));
        d.set_up.push_back(std::move(p));
    }
    d.set_up_words = identification::set_up_words(d.setup, d.set_up);
    for (auto& words :
         {identification::index_words(d.setup), identification::time_constant_words(d.setup)})
        d.set_up_words.insert(d.set_up_words.end(), words.begin(), words.end());
    for (identification::FitParameter& p : zero_scatter_of(f)) d.set_up.push_back(std::move(p));
}

}  // namespace trunnion::diagnosis
