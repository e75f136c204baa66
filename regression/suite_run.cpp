// Runs the cases of a suite on several threads; results are in the suite's order.
#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "base/alarm.h"
#include "base/read_file.h"
#include "interpreter/program_folders.h"
#include "regression/golden.h"
#include "regression/suite.h"

namespace trunnion::regression {

namespace {

/// Empty when no golden has been written yet.
std::optional<std::string> read_golden(const std::string& path) {
    if (!std::filesystem::exists(path)) return std::nullopt;
    return read_file(path);
}

/// Setups by path, each loaded once before any thread starts.
class Setups {
  public:
    Setups(const Suite& suite, SetupLoader load) {
        for (const SuiteCase& c : suite.cases)
            for (const std::string* path : {&c.setup, &c.setup_b})
                if (!by_path_.contains(*path)) by_path_.emplace(*path, load(*path));
    }
    const setup::Setup& at(const std::string& path) const { return by_path_.at(path); }

  private:
    std::map<std::string, setup::Setup> by_path_;
};

Comparison not_compared(const SuiteCase& c, const std::string& why, CompareStatus status) {
    Comparison result;
    result.a = c.a.empty() ? c.golden : c.a;
    result.b = c.b;
    result.equal = false;
    result.status = status;
    result.verdict = why;
    return result;
}

Comparison compare_case(const SuiteCase& c, const Setups& setups) {
    if (c.b.empty()) return not_compared(c, "only in A: " + c.a, CompareStatus::differs);
    if (!c.golden.empty()) {
        const auto text = read_golden(c.golden);
        if (!text)
            return not_compared(c, "no golden yet: " + c.golden + " (--update --reason writes it)",
                                CompareStatus::differs);
        const Golden golden = parse_golden(*text, c.golden);
        return compare_with_golden(golden.path, c.golden, interpreter::read_main_program(c.b),
                                   setups.at(c.setup), c.options);
    }
    if (c.a.empty()) return not_compared(c, "only in B: " + c.b, CompareStatus::differs);
    return compare_programs(interpreter::read_main_program(c.a), setups.at(c.setup),
                            interpreter::read_main_program(c.b), setups.at(c.setup_b), c.options);
}

/// A bad file affects its own case only.
Comparison guarded(const SuiteCase& c, const Setups& setups) {
    try {
        return compare_case(c, setups);
    } catch (const InputError& e) {
        return not_compared(c, format_diagnostic(e.where, e.message, ""), CompareStatus::bad_input);
    }
}

void mark_expected(const Suite& suite, Comparison& c) {
    bool open = false;
    for (Difference& d : c.differences) {
        for (const ExpectedDifference& e : suite.expected)
            if (e.fingerprint == d.fingerprint && (e.case_name.empty() || e.case_name == c.name)) {
                d.expected = true;
                d.reason = e.reason;
            }
        open = open || !d.expected;
    }
    if (c.equal || open || c.differences.empty() || c.differences_left_out > 0) return;
    c.equal = true;
    c.verdict = fmt::format("equal but for {} expected difference{}", c.differences.size(),
                            c.differences.size() > 1 ? "s" : "");
}

template <typename Work>
void on_threads(std::size_t count, unsigned threads, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto loop = [&] {
        for (std::size_t k = next++; k < count; k = next++) try {
                work(k);
            } catch (...) {
                const std::lock_guard<std::mutex> lock(failing);
                failure = std::current_exception();
            }
    };
    std::vector<std::thread> pool;
    for (unsigned n = 1; n < std::min<std::size_t>(std::max(1U, threads), count); ++n)
        pool.emplace_back(loop);
    loop();
    for (std::thread& thread : pool) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

SuiteRun run_suite(const Suite& suite, Shard shard, SetupLoader load, unsigned threads,
                   const SuiteWatch& watch) {
    const Setups setups(suite, load);
    SuiteRun run;
    run.report.suite = suite.name;
    run.report.single = false;
    run.report.expected = suite.expected;
    for (auto k = static_cast<std::size_t>(shard.index - 1); k < suite.cases.size();
         k += static_cast<std::size_t>(shard.count))
        run.places.push_back(k);
    run.report.cases.resize(run.places.size());
    std::atomic<std::size_t> done{0};
    on_threads(run.places.size(), threads, [&](std::size_t k) {
        const SuiteCase& c = suite.cases[run.places[k]];
        Comparison& result = run.report.cases[k];
        const std::string stop = watch.stop ? watch.stop() : std::string();
        result = stop.empty() ? guarded(c, setups)
                              : not_compared(c, "not compared: " + stop, CompareStatus::limit);
        result.name = c.name;
        mark_expected(suite, result);
        if (watch.progress) watch.progress(++done, run.places.size());
    });
    return run;
}

std::map<std::string, std::string> updated_goldens(const Suite& suite, const std::string& reason,
                                                   SetupLoader load) {
    const Setups setups(suite, load);
    std::map<std::string, std::string> files;
    for (const SuiteCase& c : suite.cases) {
        if (c.golden.empty()) continue;
        std::vector<std::string> reasons{reason};
        if (const auto text = read_golden(c.golden)) {
            const Golden golden = parse_golden(*text, c.golden);
            const Comparison now =
                compare_with_golden(golden.path, c.golden, interpreter::read_main_program(c.b),
                                    setups.at(c.setup), c.options);
            if (now.equal) continue;
            reasons.insert(reasons.end(), golden.reasons.begin(), golden.reasons.end());
        }
        const RecordedRun run =
            record_run(setups.at(c.setup), interpreter::read_main_program(c.b),
                       {PathSpace::tip, c.options.tolerances, c.options.program_folders,
                        c.options.max_blocks, "", c.options.devices, c.options.go_on});
        if (run.result.status == controller::RunStatus::limit)
            throw InputError("did not run to its end: no golden is written", {c.b, 0, 0});
        if (run.result.alarm) {
            Alarm alarm = *run.result.alarm;
            throw alarm;
        }
        files[c.golden] = format_golden(run.path, reasons);
    }
    return files;
}

}  // namespace trunnion::regression
