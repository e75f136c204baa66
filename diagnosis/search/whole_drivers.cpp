#include "diagnosis/search/whole_drivers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr double exact = 1.001;  ///< of the least noise

std::optional<std::size_t> whole_of(const Design& design, std::size_t driver) {
    const ColumnGroup& held = design.group(driver);
    if (held.kind != GroupKind::driver || held.is_whole) return std::nullopt;
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (design.group(k).is_whole && same_cause(design.group(k), held)) return k;
    return std::nullopt;
}

/// True for a model that is clearly more likely: by so much that it is no matter of the number of
/// groups into which one and the same form is divided. Of readings without noise the evidence is
/// arithmetic, or no number: there the score decides.
bool is_clearly_likelier(Design& design, const Model& one, const Model& other) {
    constexpr double arithmetic = 1e9;  // nats
    const double gained = evidence(design, one) - evidence(design, other);
    const bool is_evidence = std::abs(gained) < arithmetic;  // false for no number, too
    return (is_evidence ? gained : one.score - other.score) >= rules::least_evidence;
}

/// The model with one of its drivers whole, where that is clearly more likely.
std::optional<Model> with_one_whole(Design& design, const SearchSetting& setting,
                                    const Model& model) {
    // What explains the readings to the last digit needs no other driver.
    if (model.variances.nu <= exact * setting.noise.least) return std::nullopt;
    for (std::size_t k = 0; k < model.members.size() && !setting.stopped(); ++k) {
        const std::optional<std::size_t> whole = whole_of(design, model.members[k]);
        if (!whole || std::count(model.members.begin(), model.members.end(), *whole) > 0) continue;
        Model trial = model;
        trial.members[k] = *whole;
        trial = pruned(design, setting, tuned(design, setting, std::move(trial), 3));
        if (is_clearly_likelier(design, trial, model)) return trial;
    }
    return std::nullopt;
}

}  // namespace

void add_whole(Design& design, ColumnGroup driver) {
    driver.is_whole = true;
    design.hide(design.add(std::move(driver)));
}

Model with_whole_drivers(Design& design, const SearchSetting& setting, Model model) {
    constexpr int most = 4;  // after each the search may take another driver
    for (int k = 0; k < most; ++k) {
        std::optional<Model> better_one = with_one_whole(design, setting, model);
        if (!better_one) break;
        model = settled(design, setting, std::move(*better_one));
    }
    return model;
}

}  // namespace trunnion::diagnosis
