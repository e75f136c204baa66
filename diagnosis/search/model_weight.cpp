#include "diagnosis/search/model_weight.h"

#include <algorithm>
#include <cmath>

namespace trunnion::diagnosis {
namespace {

/// True for the textbook form of what the table gives in free form.
bool is_part_of(const ColumnGroup& textbook, const TableForm& table) {
    if (textbook.kind != GroupKind::textbook || textbook.effect->axis != table.axis.axis)
        return false;
    const effects::EffectKind kind = textbook.effect->kind;
    return kind == table.motion ||
           (kind == effects::EffectKind::scale && table.motion == effects::EffectKind::positioning);
}

}  // namespace

bool is_its_slope(const ColumnGroup& squareness, const ColumnGroup& straightness) {
    if (squareness.kind != GroupKind::textbook || squareness.is_change() ||
        squareness.effect->kind != effects::EffectKind::squareness)
        return false;
    const std::string& plane = squareness.effect->name;
    if (straightness.kind == GroupKind::table)
        return straightness.table.motion == effects::EffectKind::straightness &&
               plane.substr(0, 2).find(straightness.table.axis.name) != std::string::npos;
    return straightness.kind == GroupKind::textbook && !straightness.is_change() &&
           straightness.effect->kind == effects::EffectKind::straightness &&
           plane.substr(0, 2).find(straightness.name.substr(0, 1)) != std::string::npos;
}

double weight_of(Design& design, const Model& model) {
    double sum = evidence(design, model);
    for (const std::size_t k : model.members) {
        const ColumnGroup& group = design.group(k);
        const auto own = [&](std::size_t m) {
            return (design.group(m).kind == GroupKind::table &&
                    is_part_of(group, design.group(m).table)) ||
                   is_its_slope(group, design.group(m));
        };
        if (std::any_of(model.members.begin(), model.members.end(), own))
            sum += std::log(0.5) - group.log_prior;
    }
    return sum;
}

}  // namespace trunnion::diagnosis
