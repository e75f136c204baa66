// Speed of the language alone, with a consumer that does nothing. TRUNNION_BENCH names the folder
// that workloads.py wrote (200,000 units; out/bench without it); items are blocks, iterations or
// calls.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "interpreter/interpreter.h"

namespace {

using namespace trunnion;

struct NoSystem : interpreter::SystemVariables {
    double get(int) override { return 0.0; }
    void set(int, double, const char*) override {}
    double parameter(int, int, int) override { return 0.0; }
};

std::string read_file(const std::string& name) {
    const char* folder = std::getenv("TRUNNION_BENCH");
    std::ifstream in(std::string(folder ? folder : "out/bench") + "/" + name);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

bool is_end(const interpreter::BlockWords& words) {
    return words.count > 0 && words.words[0].letter == 'M' && words.words[0].value == 30.0;
}

void run_program(benchmark::State& state, const char* name, std::int64_t items) {
    const std::string text = read_file(name);
    if (text.empty())
        return state.SkipWithError("no workload: python3 benchmarks/workloads.py out/bench");
    interpreter::ProgramsInMemory none;
    NoSystem system;
    const interpreter::InterpreterOptions options;
    std::uint64_t blocks = 0;
    for (auto _ : state) {
        interpreter::Interpreter nc(none, options, system, {});
        nc.open(interpreter::ProgramText{name, text, nullptr});
        while (const interpreter::BlockWords* words = nc.next()) {
            benchmark::DoNotOptimize(words->words[0].value);
            if (is_end(*words)) nc.end_program();
        }
        blocks = nc.blocks_executed();
    }
    state.counters["blocks"] = static_cast<double>(blocks);
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * items);
}

BENCHMARK_CAPTURE(run_program, line3, "line3.nc", 200000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_program, line5, "line5.nc", 200000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_program, arcs, "arcs.nc", 200000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_program, loop, "loop.nc", 200000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_program, calls, "calls.nc", 200000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
