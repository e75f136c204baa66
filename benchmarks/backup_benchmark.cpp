// Loading a control's backup: records to values in the stores, against reading the same bytes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "backup/control_files.h"

namespace trunnion {
namespace {

/// As a control with five axes writes its parameters: `records` lines of five values.
std::string parameters(int records) {
    std::string text = "%\n";
    for (int n = 0; n < records; ++n)
        text += fmt::format("N{:05}Q1A1P{}A2P{}A3P{}A4P{}A5P{} \n", 20000 + n, n, n + 1, n + 2, -n,
                            n % 7);
    return text + "%\n";
}

void backup_load(benchmark::State& state) {
    backup::ControlBackup backup;
    backup.files["CNC-PARA.TXT"] = parameters(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        offsets::Stores stores;
        backup::apply_backup(backup, stores);
        benchmark::DoNotOptimize(stores.parameters.entry.size());
    }
    state.counters["records"] = benchmark::Counter(static_cast<double>(state.range(0)),
                                                   benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(backup_load)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

/// What the same bytes cost at least: each one is looked at once.
void look_at_bytes(benchmark::State& state) {
    const std::string text = parameters(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        std::size_t lines = 0;
        for (const char c : text) lines += c == '\n';
        benchmark::DoNotOptimize(lines);
    }
}
BENCHMARK(look_at_bytes)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trunnion

BENCHMARK_MAIN();
