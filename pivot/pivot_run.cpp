#include "pivot/pivot_run.h"

#include <memory>

#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion::pivot {

namespace {

std::string print_of(const setup::Setup& setup, const std::map<std::string, std::string>& programs,
                     const std::vector<std::string>& folders, int number,
                     const emulator::RunOptions& options) {
    interpreter::ProgramFolders source(folders);
    for (const auto& [name, text] : programs) {
        const auto owner = std::make_shared<std::string>(text);
        source.add_file({name, *owner, owner});
    }
    const emulator::RunLog log = emulator::run_program(setup, source, number, options);
    if (log.result.alarm) throw *log.result.alarm;
    return log.printed;
}

kinematics::Machine nominal_of(const setup::Setup& setup) {
    kinematics::Machine machine = setup.machine;
    machine.errors = {};
    return machine;
}

}  // namespace

std::vector<PivotMap> modelled_maps(const PivotPlan& plan, const kinematics::Machine& machine,
                                    const Vector3& tip_S_mm) {
    const PivotModel model(machine, plan.stores, plan.sphere_mm, tip_S_mm);
    std::vector<PivotMap> maps;
    for (std::size_t m = 0; m < plan.maps.size(); ++m) {
        PivotMap map;
        map.number = static_cast<int>(m) + 1;
        for (const PivotFunction& f : plan.functions) {
            if (f.group == PivotGroup::g54 && !plan.maps[m].turns_table_only) continue;
            map.arcs.push_back({f.name, f.group, {}, {}, {}, {}});
            for (int k = 0; k < plan.maps[m].count; ++k) {
                const double first = plan.maps[m].first_deg(k), second = plan.maps[m].second_deg(k);
                map.arcs.back().points.push_back(
                    {first, second, model.error_mm(f.group, first, second)});
            }
        }
        name_map(map, plan.first(), plan.second());
        maps.push_back(std::move(map));
    }
    return maps;
}

PivotDemonstration demonstrate_pivot(const setup::Setup& setup,
                                     const std::map<std::string, std::string>& programs,
                                     const std::vector<std::string>& folders,
                                     unsigned long long seed) {
    PivotDemonstration demo;
    demo.plan = plan_pivot_test(setup);
    emulator::RunOptions options;
    options.effects = effects::active_models(setup);
    for (std::size_t k = 0; k < demo.plan.functions.size(); ++k) {
        options.seed = 4 * seed + k;  // each program has its own repeatability
        demo.printed += print_of(setup, programs, folders, demo.plan.functions[k].program, options);
    }
    const PivotPrints prints =
        parse_pivot_prints({{"print", demo.printed}}, demo.plan.first(), demo.plan.second());
    demo.maps = prints.maps;
    const PivotEvidence evidence{nominal_of(setup),
                                 demo.plan.stores,
                                 prints.sphere_mm(),
                                 setup.probe->tip_S_mm,
                                 setup::least_increment_mm(setup.stores.parameters),
                                 3.0,
                                 setup::is_hurco(demo.plan.language)};
    demo.verdict = judge_pivot(evidence, demo.maps);
    demo.true_right = setup::right_stores(setup.machine, demo.plan.stores);
    add_expected({setup.machine, demo.plan.stores, evidence.sphere_mm, evidence.tip_S_mm},
                 demo.plan.stores.pivot, demo.maps);
    return demo;
}

}  // namespace trunnion::pivot
