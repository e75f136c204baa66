// trunnion diagnose on a gap of two effects, full catalogue, by number of readings.
#include <benchmark/benchmark.h>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

void diagnosis(benchmark::State& state) {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(campaign::with_effect(campaign::real_machine(setup),
                                                    "C.cyclic: cos_rad=3e-5, periods_per_turn=45"),
                              "thermal.drift: d_mm=[0.01, 0, 0.02], tau_s=900");
    records::ReadingTable table = campaign::empty_table(setup);
    const auto rows = static_cast<int>(state.range(0));
    campaign::add_sphere_map(table, setup, rows / 9, 5);  // a third of the readings
    campaign::add_ballbar(table, setup, rows * 2 / 3 / 24);
    table = campaign::measured(truth, table, 7);
    for (auto _ : state) {
        const diagnosis::Diagnosis result = diagnosis::diagnose(setup, table);
        if (result.causes.size() != 2) state.SkipWithError("the two effects were not claimed");
        state.counters["readings"] = static_cast<double>(result.readings);
    }
}
BENCHMARK(diagnosis)->Arg(1000)->Arg(3000)->Arg(20000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion

BENCHMARK_MAIN();
