#include "diagnosis/background.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "diagnosis/measured_places.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/left_out.h"
#include "diagnosis/written_candidates.h"

namespace trunnion::diagnosis {
namespace {

constexpr double usual_part = 0.3;     ///< of the usual size: where the estimate of a size begins
constexpr double without_size = 0.02;  ///< ... and of what is none

/// An error that every axis, or every two of them, have.
bool is_error_of_axes(effects::EffectKind kind) {
    using enum effects::EffectKind;
    return kind == positioning || kind == radial || kind == axial || kind == tilt ||
           kind == scale || kind == straightness || kind == angular || kind == squareness;
}

/// True for what may stand in the background: no play, no single order, no change.
bool is_smooth_error(const Design::Entry& entry) {
    const ColumnGroup& group = entry.group;
    if (!entry.visible() || entry.only_form || group.is_change() || group.unnamed) return false;
    if (group.kind == GroupKind::textbook) return is_error_of_axes(group.effect->kind);
    return group.kind == GroupKind::table && !group.table.play && group.component.empty();
}

bool has_member(const Model& model, std::size_t group) {
    return std::count(model.members.begin(), model.members.end(), group) > 0;
}

/// The errors that a model lacks: of each the whole textbook form and the smoothest free form,
/// which stand before the others. What was found and is not written does not come back.
std::vector<std::size_t> lacking(const Outcome& f, const Model& model) {
    const Design& design = f.design;
    std::set<std::tuple<GroupKind, std::string>> seen;
    for (const std::size_t m : model.members) {
        const ColumnGroup& group = design.group(m);
        seen.emplace(group.kind, group.name);
        // Written as values at places, it leaves no room for a curve between them.
        if (is_ripple_of_places(f, m))
            seen.emplace(GroupKind::table,
                         effects::effect_name(group.name.substr(0, group.name.find('.')),
                                              effects::EffectKind::positioning));
    }
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const Design::Entry& entry = design.groups()[k];
        if (!is_smooth_error(entry) || has_member(f.model, k)) continue;
        if (seen.emplace(entry.group.kind, entry.group.name).second) list.push_back(k);
    }
    return list;
}

/// The model without those added members that have no size.
Model without_idle(const Model& part, Model whole) {
    for (std::size_t k = whole.members.size(); k-- > 0;)
        if (whole.variances.tau[k] < without_size && !has_member(part, whole.members[k]))
            whole = without(whole, k);
    return whole;
}

/// The model without the added free forms of axes whose left-out positions they do not predict.
Model predicting_places(const Outcome& f, const Model& part, Model whole) {
    std::vector<std::size_t> tables;
    std::set<Axis> fails;
    for (const std::size_t m : whole.members)
        if (f.design.group(m).kind == GroupKind::table && !has_member(part, m)) tables.push_back(m);
    for (const std::size_t m : tables) {
        const TableForm& table = f.design.group(m).table;
        const Axis axis = table.axis.axis;
        if (fails.contains(axis)) continue;
        std::vector<std::size_t> own;
        for (const std::size_t other : tables)
            if (f.design.group(other).table.axis.axis == axis) own.push_back(other);
        const Folds places = of_moved_rows(f.design, own, place_folds(f.prepared.replay, table));
        const Saving saving =
            saving_of(loss_on_paths(f, part, places), loss_on_paths(f, whole, places));
        if (saving.sum < 0.0) fails.insert(axis);
    }
    return only(f, whole, [&](GroupKind kind, std::size_t m) {
        return kind != GroupKind::table || has_member(part, m) ||
               !fails.contains(f.design.group(m).table.axis.axis);
    });
}

}  // namespace

Model with_background(const Outcome& f, const Model& model) {
    Model whole = model;
    for (const std::size_t k : lacking(f, model)) {
        whole.members.push_back(k);
        whole.variances.tau.push_back(usual_part);
    }
    whole = without_idle(model, without_enormous(f, std::move(whole)));
    return predicting_places(f, model, std::move(whole));
}

std::vector<std::string> names_beside(const Design& design, const Model& whole, const Model& part) {
    std::vector<std::string> names;
    for (const std::size_t m : whole.members) {
        const std::string& name = design.group(m).name;
        if (has_member(part, m) || std::count(names.begin(), names.end(), name) > 0) continue;
        names.push_back(name);
    }
    return names;
}

}  // namespace trunnion::diagnosis
