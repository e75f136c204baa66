#include "diagnosis/groups/rests.h"

#include "diagnosis/search/solution.h"

namespace trunnion::diagnosis {

/// Columns of the set-up and of the causes among the members.
Eigen::MatrixXd Rests::fitted_mm(const Model& model) {
    const Eigen::MatrixXd& base = prepared_.base.columns;
    std::vector<const Eigen::MatrixXd*> parts{&base};
    Eigen::Index count = base.cols();
    for (const std::size_t m : model.members) {
        const ColumnGroup& group = design_.group(m);
        if (!is_cause(group.kind)) continue;
        Eigen::MatrixXd& own = columns_mm_[m];
        if (own.size() == 0) own = columns_on(prepared_.replay, prepared_.base.gradient, group);
        parts.push_back(&own);
        count += own.cols();
    }
    Eigen::MatrixXd all(base.rows(), count);
    Eigen::Index at = 0;
    for (const Eigen::MatrixXd* part : parts) {
        all.middleCols(at, part->cols()) = *part;
        at += part->cols();
    }
    return all;
}

Rests::Rest Rests::of(const Model& model) {
    Eigen::VectorXd mm = left_mm(prepared_, design_, model, solved(design_, model));
    KeySearch::Remainder remainder = keys_.remainder(mm, fitted_mm(model));
    return {std::move(mm), std::move(remainder)};
}

}  // namespace trunnion::diagnosis
