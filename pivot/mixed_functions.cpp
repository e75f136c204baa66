#include "pivot/mixed_functions.h"

#include <algorithm>
#include <set>

namespace trunnion::pivot {
namespace {

constexpr double fits_um = 3.0;  ///< below this scatter of a centre no mix-up is searched
constexpr double times_better = 3.0;

std::vector<PivotMap> regrouped(std::vector<PivotMap> maps, const std::set<std::string>& moved) {
    for (PivotMap& map : maps)
        for (PivotArc& arc : map.arcs)
            if (moved.contains(arc.function))
                arc.group = arc.group == PivotGroup::g54 ? PivotGroup::p1970x : PivotGroup::g54;
    return maps;
}

std::vector<std::string> functions_of(const std::vector<PivotMap>& maps) {
    std::vector<std::string> names;
    for (const PivotFunction& f : pivot_functions())
        for (const PivotMap& map : maps)
            if (std::any_of(map.arcs.begin(), map.arcs.end(),
                            [&](const PivotArc& arc) { return arc.function == f.name; })) {
                names.push_back(f.name);
                break;
            }
    return names;
}

}  // namespace

std::vector<std::string> mixed_functions(const PivotEvidence& evidence,
                                         const std::vector<PivotMap>& maps,
                                         const PivotFit& as_named) {
    if (as_named.noise_um < fits_um) return {};
    const std::vector<std::string> names = functions_of(maps);
    double best_um = as_named.noise_um / times_better;
    std::vector<std::string> mixed;
    for (unsigned set = 1; set < 1U << names.size(); ++set) {
        std::set<std::string> moved;
        for (std::size_t k = 0; k < names.size(); ++k)
            if ((set >> k & 1U) != 0) moved.insert(names[k]);
        const double noise_um = fit_pivot_machine(evidence, regrouped(maps, moved)).noise_um;
        // Of equal sets the smaller one, which comes first, is kept.
        if (noise_um > 0.9 * best_um) continue;
        best_um = noise_um;
        mixed.assign(moved.begin(), moved.end());
    }
    return mixed;
}

}  // namespace trunnion::pivot
