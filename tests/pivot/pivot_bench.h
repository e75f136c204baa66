// Machines, programs and prints for the tests of the four-function test.
#pragma once

#include <fmt/format.h>

#include "base/random.h"
#include "base/units.h"
#include "pivot/pivot_program.h"
#include "pivot/pivot_run.h"

namespace trunnion::pivot_bench {

inline const std::string root = TRUNNION_SOURCE_DIR;
inline const std::vector<std::string> folders{root + "/programs"};

inline setup::Setup load(const std::string& file, double repeatability_um = 0.0) {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(root + "/machines/" + file, notes);
    setup.probe->repeatability_um = repeatability_um;
    setup.machine.errors = {};
    return setup;
}

inline Vector3 random_vector(SeededNoise& noise, double size) {
    return size * Vector3(noise.normal(), noise.normal(), noise.normal());
}

/// Stores that hold the truth for a machine: its numbers, G54 at the centre.
inline setup::RotaryStores true_stores(const setup::Setup& setup) {
    return setup::right_stores(setup.machine,
                               *setup::rotary_stores(setup.machine.chain, setup.stores));
}

inline void enter(const setup::RotaryStores& stores, setup::Setup& setup) {
    for (const setup::StoreNumber& n : setup::store_numbers(stores))
        if (n.parameter != 0)
            setup.stores.parameters.set(n.parameter, n.value_mm);
        else
            setup.stores.work.standard[0].value[static_cast<std::size_t>(n.component)] = n.value_mm;
}

inline pivot::PivotDemonstration demonstrate(const setup::Setup& setup,
                                             unsigned long long seed = 1) {
    return pivot::demonstrate_pivot(setup, pivot::pivot_programs(pivot::plan_pivot_test(setup)),
                                    folders, seed);
}

struct Scatter {
    double noise_um = 0.0, zero_um = 0.0;
    std::uint64_t seed = 1;
};

/// What the programs would print: the model's errors with noise and scatter of the zeroings.
inline std::string prints_of(const pivot::PivotPlan& plan, const kinematics::Machine& machine,
                             const Vector3& tip_S_mm, const Scatter& scatter) {
    SeededNoise noise(scatter.seed);
    const pivot::PivotModel model(machine, plan.stores, plan.sphere_mm, tip_S_mm);
    const char a = letter_of(plan.first()), b = letter_of(plan.second());
    std::string text;
    for (const pivot::PivotFunction& f : plan.functions) {
        text += fmt::format("PIVOT {} AXES {} {} MAPS {} TO {}\n", f.name, a, b, plan.first_map(f),
                            plan.maps.size());
        text += fmt::format("STORE G54 X{:.7f} Y{:.7f} Z{:.7f}\n", plan.stores.g54.x(),
                            plan.stores.g54.y(), plan.stores.g54.z());
        for (const setup::StoreNumber& n : setup::store_numbers(plan.stores))
            if (n.parameter != 0)
                text += fmt::format("STORE N{} V{:.7f}\n", n.parameter, n.value_mm);
        for (std::size_t m = static_cast<std::size_t>(plan.first_map(f)); m <= plan.maps.size();
             ++m) {
            const pivot::PlannedMap& map = plan.maps[m - 1];
            const Vector3 zero = random_vector(noise, 1e-3 * scatter.zero_um);
            const Vector3 found = plan.sphere_mm + zero;
            text += fmt::format("{} ZERO{} X{:.7f} Y{:.7f} Z{:.7f}\n", f.name, m, found.x(),
                                found.y(), found.z());
            for (int k = 0; k < map.count; ++k) {
                const Vector3 e =
                    model.error_mm(f.group, map.first_deg(k), map.second_deg(k), zero) +
                    random_vector(noise, 1e-3 * scatter.noise_um);
                text +=
                    fmt::format("{} MAP{} {}{:.4f} {}{:.4f} X{:.7f} Y{:.7f} Z{:.7f}\n", f.name, m,
                                a, map.first_deg(k), b, map.second_deg(k), e.x(), e.y(), e.z());
            }
        }
        text += f.name + " END\n";
    }
    return text;
}

}  // namespace trunnion::pivot_bench
