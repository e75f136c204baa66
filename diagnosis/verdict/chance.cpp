#include "diagnosis/verdict/chance.h"

#include <algorithm>
#include <set>
#include <string>

#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

constexpr double effects_tried = 60.0;  ///< on a five-axis machine (assumed)
constexpr double least_freedom = 5.0;   ///< of what is left

using Features = std::set<Eigen::Index>;

void add_own(const ColumnGroup& group, Features& features) {
    const auto own = static_cast<std::ptrdiff_t>(group.columns());
    features.insert(group.features.end() - own, group.features.end());
}

/// What free columns explain of the whitened readings, and how many of them count.
struct FreeFit {
    double explained = 0.0, columns = 0.0;
};
FreeFit free_fit(const Design& design, const Features& features) {
    if (features.empty()) return {};
    const estimation::GroupInformation all = design.of({features.begin(), features.end()});
    const estimation::LinearFit fit = estimation::solve_ranked(all.information, all.product);
    return {all.product.dot(fit.value),
            static_cast<double>(features.size()) - static_cast<double>(fit.null_space.size())};
}

/// Effects that these readings can show.
double effects_seen(const Design& design) {
    std::set<std::string> names;
    for (const auto& entry : design.groups())
        if (entry.group.kind == GroupKind::textbook && entry.visible())
            names.insert(entry.group.name);
    return static_cast<double>(names.size());
}

/// Chance of what the members explain beside free zeros, by what both leave, for as many effects as
/// there are. 1 where too little is left to tell the noise.
double chance_beside_zeros(const Design& design, const Model& model) {
    Features zeros, all;
    for (const auto& entry : design.groups())
        if (entry.group.kind == GroupKind::offset && entry.visible()) add_own(entry.group, zeros);
    all = zeros;
    for (const std::size_t m : model.members) add_own(design.group(m), all);
    const FreeFit without = free_fit(design, zeros), with = free_fit(design, all);
    const double width = with.columns - without.columns;
    const double freedom = design.freedom() - with.columns;
    if (width < 1.0 || freedom < least_freedom) return 1.0;
    const double whole = design.projection().beside(design.data()).squaredNorm();
    const double rest = std::max(1e-12 * whole, whole - with.explained) / freedom;
    if (rest <= 0.0) return 1.0;
    const double f = std::max(0.0, with.explained - without.explained) / width / rest;
    return std::min(1.0, effects_seen(design) * estimation::f_tail(f, width, freedom));
}

}  // namespace

double chance_of(const Design& design, const Model& model, const NoiseModel& noise,
                 const Sizes& sizes) {
    if (model.members.empty()) return 1.0;
    const Eigen::VectorXd y = design.projection().beside(design.data());
    double width = 0.0;
    for (const std::size_t m : model.members)
        width += static_cast<double>(design.group(m).columns());
    const double explained = (y.squaredNorm() - sizes.remainder.squaredNorm()) / sizes.floor;
    const double one = noise.doubt > 0.0 ? estimation::f_tail(explained / width, width,
                                                              2.0 / (noise.doubt * noise.doubt))
                                         : estimation::chi_squared_tail(explained, width);
    return std::min(1.0, effects_tried * one);
}

bool is_told_without_noise(const Design& design, const Model& model, const Judgement& j,
                           const Saving& saving) {
    if (j.repeated || (saving.t < rules::least_t && saving.blocks > rules::few_blocks))
        return false;
    return chance_beside_zeros(design, model) < rules::free_chance;
}

}  // namespace trunnion::diagnosis
