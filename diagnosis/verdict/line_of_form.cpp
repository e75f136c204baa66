#include "diagnosis/verdict/line_of_form.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/rules/rules.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

/// True for the scale of one axis.
bool is_scale(const ColumnGroup& group) {
    return group.kind == GroupKind::textbook && group.effect->kind == EffectKind::scale &&
           !group.is_change() && group.columns() == 1;
}

/// Variance of the line (least squares over the knots, at their ends) of the process of unit
/// variance whose shapes beside the line are these; 0 if they are of no such process.
double line_variance(const std::vector<double>& knots, const Eigen::MatrixXd& shape) {
    const auto count = static_cast<Eigen::Index>(knots.size());
    const Eigen::MatrixXd line = estimation::polynomials_at(knots, 2);
    const Eigen::VectorXd middle =
        line.col(1).array() - line.col(1).mean();  // the constant takes its part of a line
    for (const double length : estimation::correlation_lengths(knots, true)) {
        const Eigen::MatrixXd same = estimation::smooth_shapes(knots, length, line, shape.cols());
        if (same.cols() != shape.cols() || !same.isApprox(shape, 1e-6)) continue;
        const Eigen::MatrixXd whole =
            estimation::smooth_shapes(knots, length, Eigen::MatrixXd::Zero(count, 1), count);
        return (middle.transpose() * whole).squaredNorm() /
               (middle.squaredNorm() * middle.squaredNorm());
    }
    return 0.0;
}

/// How many independent values tell the size of a member: its columns that stand out of the noise.
double freedom_of(Design& design, const Model& model, std::size_t position) {
    const double size = model.variances.tau[position] / model.variances.nu;
    const Eigen::MatrixXd signal = size * size * design.equations({model.members[position]}).gram;
    const Eigen::MatrixXd all = signal + Eigen::MatrixXd::Identity(signal.rows(), signal.cols());
    return all.llt().solve(signal).trace();
}

/// The coefficient of the scale that does what the line of a table does (1 at its end), by the
/// readings.
double scale_of_line(Design& design, const ColumnGroup& table, std::size_t scale) {
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& line = design.group(k);
        if (!line.is_line || line.name != table.name || line.features != table.features ||
            line.columns() != 2)
            continue;
        const Eigen::MatrixXd gram = design.equations({k, scale}).gram;
        return gram(2, 2) > 0.0 ? gram(1, 2) / gram(2, 2) : 0.0;
    }
    return 0.0;
}

/// Logarithm of Student's density of a value of this variance, without its constant.
double log_density(double value, double variance, double freedom) {
    return -0.5 * std::log(variance) -
           0.5 * (freedom + 1.0) * std::log1p(value * value / (variance * freedom));
}

/// Probability of a scale against the line of the form beside it. Sizes as in group_gain().
double probability_of_scale(double value, double variance, double freedom) {
    constexpr int sizes = 26;
    double ratio = 0.0;
    for (int k = 0; k < sizes; ++k) {
        const double size = std::pow(10.0, -2.0 + 5.0 * k / (sizes - 1));
        ratio += std::exp(log_density(value, variance + size * size, freedom) -
                          log_density(value, variance, freedom)) /
                 sizes;
    }
    return ratio / (1.0 + ratio);  // as likely as not, like in weight_of()
}

/// The same of a member of a model; none without a line that a form may have.
std::optional<double> probability_beside(Design& design, const Model& model, std::size_t position,
                                         std::size_t form) {
    const ColumnGroup& table = design.group(model.members[form]);
    const double one =
        model.variances.tau[form] * scale_of_line(design, table, model.members[position]);
    const double own = one * one * line_variance(table.table.knots, table.shape);
    const estimation::GroupInformation left = worth_of_members(design, model)[position].left;
    const double information = left.information(0, 0);
    if (!(own > 0.0) || !(information > 0.0)) return {};
    return probability_of_scale(left.product(0) / information, own + 1.0 / information,
                                std::max(1.0, freedom_of(design, model, form)));
}

}  // namespace

std::optional<std::size_t> form_of_line(const Design& design, const Model& model,
                                        std::size_t position) {
    const ColumnGroup& scale = design.group(model.members[position]);
    if (!is_scale(scale)) return {};
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]);
            group.kind == GroupKind::table && group.table.motion == EffectKind::positioning &&
            group.table.axis.axis == *scale.effect->axis && group.table.directions.size() == 1 &&
            group.table.knots.size() > 2)
            return k;
    return {};
}

void doubt_lines_of_forms(Design& design, const Model& model, std::vector<Claim>& claims) {
    for (Claim& claim : claims) {
        const auto form = form_of_line(design, model, claim.position);
        if (!form) continue;
        const auto probability = probability_beside(design, model, claim.position, *form);
        if (!probability || *probability >= rules::sure) continue;
        claim.probability = std::min(claim.probability, *probability);
        add_rival(design.group(model.members[*form]).name, claim);
        if (*probability >= rules::claimed) continue;
        for (Claim& other : claims)
            if (other.position == *form) add_rival(claim.name, other);
    }
}

}  // namespace trunnion::diagnosis
