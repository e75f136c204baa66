// Random programs on random machines against laws, seed by seed. In the tests a second or two;
// ./dev soak SECONDS [SEED] goes on. A failure names its seed: TRUNNION_SOAK_SEED=N repeats it.
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <sstream>

#include "base/numbers.h"
#include "base/random.h"
#include "emulator/run.h"
#include "interpreter/print.h"
#include "tests/soak/random_program.h"

using namespace trunnion;

namespace {

emulator::RunLog run_once(const setup::Setup& setup, const std::string& program, const char* name) {
    emulator::RunOptions options;
    options.trace = options.truth = true;
    options.budget.blocks = 3000;
    interpreter::ProgramsInMemory none;
    return emulator::run_program(setup, none, interpreter::ProgramText{name, program, nullptr},
                                 options);
}

using Row = std::vector<std::string>;

/// Cells of a trace without a quoted name.
std::vector<Row> rows_of(const std::string& csv) {
    std::vector<Row> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        Row& row = rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    }
    return rows;
}

std::size_t column(const Row& header, const std::string& name) {
    const auto at = std::find(header.begin(), header.end(), name);
    REQUIRE(at != header.end());
    return static_cast<std::size_t>(at - header.begin());
}

/// Law 1: told the truth, the believed tip is the true one. The largest distance along one axis.
double largest_gap_mm(const std::vector<Row>& rows) {
    double largest = 0.0;
    for (const char axis : {'x', 'y', 'z'}) {
        const std::size_t believed = column(rows[0], fmt::format("tip_{}_mm", axis));
        const std::size_t truth = column(rows[0], fmt::format("true_{}_mm", axis));
        for (std::size_t k = 1; k < rows.size(); ++k)
            largest = std::max(largest, std::abs(*parse_number(rows[k][believed]) -
                                                 *parse_number(rows[k][truth])));
    }
    return largest;
}

/// Law 3 at work: the printed program commands the same moves.
std::string without_lines(const std::vector<Row>& rows) {
    std::string text;
    for (const Row& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k)
            if (k != 1 && k != 2) text += row[k] + ',';
    return text;
}

void check_laws(std::uint64_t seed) {
    SeededNoise noise(seed);
    const std::string machine = random_machine(noise);
    const std::string program = random_program(noise);
    INFO("TRUNNION_SOAK_SEED=" << seed << "\n" << machine << "\n" << program);
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(machine, "soak.toml", notes);
    const emulator::RunLog log = run_once(setup, program, "soak");
    const emulator::RunLog again = run_once(setup, program, "soak");
    REQUIRE(log.trace_csv == again.trace_csv);
    REQUIRE(log.printed == again.printed);
    const auto rows = rows_of(log.trace_csv);
    CHECK(largest_gap_mm(rows) < 1e-8);
    const interpreter::ParsedProgram parsed =
        interpreter::parse_program({"soak", program, nullptr}, setup.dialect);
    REQUIRE(parsed.faults.empty());
    const emulator::RunLog printed = run_once(setup, interpreter::print_program(parsed), "soak");
    CHECK(without_lines(rows_of(printed.trace_csv)) == without_lines(rows));
    CHECK(printed.result.alarm.has_value() == log.result.alarm.has_value());
    if (log.result.alarm) CHECK(log.result.alarm->where.line > 0);
}

double number_of(const char* name, double otherwise) {
    const char* const text = std::getenv(name);
    return text ? parse_number(text).value_or(otherwise) : otherwise;
}

}  // namespace

TEST_CASE("random programs on random machines hold the laws") {
    const double seconds = number_of("TRUNNION_SOAK_SECONDS", 2.0);
    auto seed = static_cast<std::uint64_t>(number_of("TRUNNION_SOAK_SEED", 1.0));
    const std::uint64_t first = seed;
    const auto start = std::chrono::steady_clock::now();
    const auto passed_s = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    do check_laws(seed++);
    while (passed_s() < seconds);
    WARN(seed - first << " programs from seed " << first << " in " << passed_s() << " s");
}
