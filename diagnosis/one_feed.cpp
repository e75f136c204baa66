#include "diagnosis/one_feed.h"

#include <Eigen/QR>
#include <algorithm>
#include <string>

#include "diagnosis/rules/rules.h"
#include "diagnosis/same_work.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

constexpr double least_squares = 12.0;  ///< of a scale's work, in squared noise (assumed)

bool is_contour(const ColumnGroup& group) {
    return group.kind == GroupKind::textbook && group.effect->kind == EffectKind::servo_contour &&
           !group.is_change();
}

/// Groups of the scales of the linear axes.
std::vector<std::size_t> scales_of(const Design& design) {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& group = design.group(k);
        if (group.kind == GroupKind::textbook && group.effect->kind == EffectKind::scale &&
            !group.is_change() && group.columns() == 1 && design.groups()[k].moves_readings())
            list.push_back(k);
    }
    return list;
}

Eigen::MatrixXd columns_of(const Design& design, const std::vector<std::size_t>& groups) {
    Eigen::MatrixXd all(design.data().size(), static_cast<Eigen::Index>(groups.size()));
    for (std::size_t k = 0; k < groups.size(); ++k)
        all.col(static_cast<Eigen::Index>(k)) = design.columns(groups[k]);
    return all;
}

/// Names the scales that the work of the claim takes.
void name_scales(const Outcome& f, const Eigen::VectorXd& part,
                 const std::vector<std::size_t>& scales, Claim& claim) {
    const Eigen::MatrixXd own = f.design.projection().beside(columns_of(f.design, scales));
    const Eigen::VectorXd sizes = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(own).solve(part);
    const double least = least_squares * f.model.variances.nu * f.model.variances.nu;
    for (std::size_t k = 0; k < scales.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        if ((sizes(column) * own.col(column)).squaredNorm() > least)
            add_rival(f.design.group(scales[k]).name, claim);
    }
}

}  // namespace

void doubt_contour_at_one_feed(const Outcome& f, std::vector<Claim>& claims) {
    const auto claimed = std::find_if(claims.begin(), claims.end(), [&](const Claim& claim) {
        return is_contour(f.design.group(f.model.members[claim.position]));
    });
    if (claimed == claims.end()) return;
    const std::vector<std::size_t> scales = scales_of(f.design);
    if (scales.empty()) return;
    const Eigen::VectorXd part = contributions(f.design, f.model, fit_of(f.design, f.model))
                                     .col(static_cast<Eigen::Index>(claimed->position));
    const auto freedom =
        static_cast<double>(f.design.group(f.model.members[claimed->position]).columns());
    if (!do_the_same(f, part, named_beside(f, claimed->position, columns_of(f.design, scales)),
                     freedom))
        return;
    claimed->probability = std::min(claimed->probability, rules::claimed);
    name_scales(f, part, scales, *claimed);
}

void tell_one_feed(std::vector<Cause>& causes) {
    for (Cause& cause : causes)
        if (cause.effect == effects::identity_of(EffectKind::servo_contour).name &&
            std::any_of(cause.rivals.begin(), cause.rivals.end(),
                        [](const std::string& rival) { return rival.ends_with(".scale"); }))
            cause.what +=
                ". Or the axes have these scales, which do the same on circles at one feed: "
                "circles "
                "at another feed would tell";
}

}  // namespace trunnion::diagnosis
