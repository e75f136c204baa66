#include "report/undetermined_stores.h"

#include <cmath>

#include "setup/right_stores.h"

namespace trunnion::report {

std::set<std::string> undetermined_stores(
    const setup::Setup& setup, const std::vector<identification::FitParameter>& parameters) {
    constexpr double noticed_mm = 1e-6;  // by a typical change of the location: less is arithmetic
    std::set<std::string> names;
    const auto in_force = setup::rotary_stores(setup.machine.chain, setup.stores);
    if (!in_force) return names;
    const auto as_found = setup::store_numbers(setup::right_stores(setup.machine, *in_force));
    for (const identification::FitParameter& p : parameters) {
        if (!p.location || std::isfinite(p.sigma)) continue;
        kinematics::Machine other = setup.machine;
        other.errors.location(*p.location) += p.typical;
        const auto as_well = setup::store_numbers(setup::right_stores(other, *in_force));
        for (std::size_t k = 0; k < as_found.size(); ++k)
            if (std::abs(as_well[k].value_mm - as_found[k].value_mm) > noticed_mm)
                names.insert(as_found[k].name);
    }
    return names;
}

}  // namespace trunnion::report
