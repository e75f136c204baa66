// The mismatched pivot of the 2021 paper: from the readings of its four NC programs alone, which
// store is wrong, by what vector, and what no reading of this kind can see.
#include <catch2/catch.hpp>
#include <sstream>

#include "emulator/run.h"
#include "identification/identify.h"
#include "interpreter/program_folders.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;

/// The machine of the paper's kind, told the truth.
setup::Setup paper_machine(double repeatability_um) {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(root + "/machines/bc_table.toml", notes);
    setup.probe->repeatability_um = repeatability_um;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) setup.stores.work.standard[0][axis] = 0.0;
    for (int n = 19700; n <= 19705; ++n) setup.stores.parameters.set(n, 0.0);
    setup.model.modelled = {};
    return setup;
}

emulator::RunLog run(const setup::Setup& machine, int program, std::uint64_t seed) {
    interpreter::ProgramFolders folders({root + "/programs", root + "/programs/pivot"});
    emulator::RunOptions options;
    options.seed = seed;
    options.effects = effects::active_models(machine);
    emulator::RunLog log = emulator::run_program(machine, folders, program, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return log;
}

records::ReadingTable four_programs(const setup::Setup& machine, std::uint64_t seed) {
    std::vector<records::ReadingTable> tables;
    for (int program = 8001; program <= 8004; ++program)
        tables.push_back(
            run(machine, program, seed + static_cast<std::uint64_t>(program)).readings);
    return records::join_readings(std::move(tables));
}

struct StoreErrors {
    Vector3 dg, dp, dd;
};

setup::Setup with_stores(setup::Setup setup, const StoreErrors& s) {
    const auto numbers = [](const Vector3& v) { return std::vector<double>(v.begin(), v.end()); };
    if (!s.dg.isZero()) setup.effects.push_back({"pivot.g54", {{"dg_mm", numbers(s.dg)}}});
    if (!s.dp.isZero() || !s.dd.isZero())
        setup.effects.push_back(
            {"pivot.p1970x", {{"dp_mm", numbers(s.dp)}, {"dd_mm", numbers(s.dd)}}});
    return setup;
}

const identification::FitParameter& found(const identification::Identification& result,
                                          const std::string& name, int component) {
    for (const identification::FitParameter& p : result.parameters)
        if (p.name == name && p.component == component) return p;
    FAIL(name);
    return result.parameters.front();
}

/// What the readings see of six numbers: dp_x, dp_z, dd_x and dp_y + dd_y.
void require_stores(const identification::Identification& result, const StoreErrors& truth,
                    double margin_mm, double sigmas) {
    const auto near = [&](const identification::FitParameter& p, double expected) {
        INFO(identification::full_name(p));
        CHECK(std::abs(p.value - expected) < margin_mm + sigmas * p.sigma);
    };
    for (int d = 0; d < 3; ++d) near(found(result, "dg_mm", d), truth.dg(d));
    near(found(result, "dp_mm", 0), truth.dp.x());
    near(found(result, "dp_mm", 2), truth.dp.z());
    near(found(result, "dd_mm", 0), truth.dd.x());
    const double sum = found(result, "dp_mm", 1).value + found(result, "dd_mm", 1).value;
    CHECK(std::abs(sum - truth.dp.y() - truth.dd.y()) <
          margin_mm + sigmas * found(result, "dp_mm", 0).sigma);
    CHECK(std::isnan(found(result, "dp_mm", 1).sigma));
    CHECK(std::isnan(found(result, "dd_mm", 1).sigma));
    CHECK(std::isnan(found(result, "dd_mm", 2).sigma));
    // Rank 4 of 6: the null space is dd_z alone, and dp_y against dd_y.
    REQUIRE(result.inseparable.size() == 2);
    for (const identification::Inseparable& group : result.inseparable) {
        if (group.names.size() == 1) {
            CHECK(group.names[0] == "pivot.p1970x.dd_mm[z]");
        } else {
            REQUIRE(group.names.size() == 2);
            CHECK(group.names[0] == "pivot.p1970x.dp_mm[y]");
            CHECK(group.names[1] == "pivot.p1970x.dd_mm[y]");
            CHECK(group.direction[0] == Approx(-group.direction[1]).margin(1e-3));
        }
    }
}

const StoreErrors cases[] = {
    {{0.15, -0.12, 0.16}, {0, 0, 0}, {0, 0, 0}},
    {{0, 0, 0}, {0.08, 0.06, -0.07}, {-0.15, 0.11, 0.06}},
    {{0.02, 0.01, -0.03}, {0.01, -0.02, 0.015}, {0.02, 0.005, 0}},
    {{0, 0, 0}, {0, 0.04, 0}, {0, -0.04, 0.05}}};  // wholly in the null space

}  // namespace

TEST_CASE("which store is wrong, and by what vector, from the four programs", "[identification]") {
    const setup::Setup exact = paper_machine(0.0), noisy = paper_machine(0.5);
    for (const StoreErrors& truth : cases) {
        INFO("dg " << truth.dg.transpose() << " dp " << truth.dp.transpose() << " dd "
                   << truth.dd.transpose());
        require_stores(identification::identify(exact, four_programs(with_stores(exact, truth), 1),
                                                {"pivot.g54", "pivot.p1970x"}),
                       truth, 1e-6, 0.0);
        require_stores(identification::identify(noisy, four_programs(with_stores(noisy, truth), 5),
                                                {"pivot.g54", "pivot.p1970x"}),
                       truth, 0.0, 4.0);
    }
}

TEST_CASE("an error in the null space changes no reading", "[identification]") {
    const setup::Setup setup = paper_machine(0.0);
    const records::ReadingTable right = four_programs(setup, 1),
                                wrong = four_programs(with_stores(setup, cases[3]), 1);
    REQUIRE(right.rows.size() == wrong.rows.size());
    for (std::size_t i = 0; i < right.rows.size(); ++i)
        if (right.rows[i].value_mm)
            REQUIRE(*right.rows[i].value_mm == Approx(*wrong.rows[i].value_mm).margin(1e-7));
}

TEST_CASE("with the axes' location free only the difference of the stores is seen",
          "[identification]") {
    const setup::Setup setup = paper_machine(0.5);
    const identification::Identification result =
        identification::identify(setup, four_programs(with_stores(setup, cases[0]), 3),
                                 {"location", "pivot.g54", "pivot.p1970x"});
    // Three more directions: both stores and the axes moved together.
    REQUIRE(result.inseparable.size() == 5);
    for (int d = 0; d < 3; ++d) {
        double difference = found(result, "dg_mm", d).value - found(result, "dp_mm", d).value;
        if (d == 1) difference -= found(result, "dd_mm", d).value;
        CHECK(difference == Approx(cases[0].dg(d)).margin(3e-4));
        CHECK(std::isnan(found(result, "dg_mm", d).sigma));
    }
    // Telling where the axes are tells which store is wrong.
    setup::Setup calibrated = setup;
    for (const char* name : {"EX0B", "EZ0B", "EX0C", "EY0C"})
        calibrated.model.calibration[name] = {0.0, 1e-3};
    const identification::Identification known =
        identification::identify(calibrated, four_programs(with_stores(setup, cases[0]), 3),
                                 {"location", "pivot.g54", "pivot.p1970x"});
    CHECK(known.inseparable.size() == 2);
    for (int d = 0; d < 3; ++d)
        CHECK(found(known, "dg_mm", d).value == Approx(cases[0].dg(d)).margin(4e-3));
}

TEST_CASE("an injected store error is what a control with that store does", "[identification]") {
    const setup::Setup setup = paper_machine(0.0);
    setup::Setup wrong = setup;
    const StoreErrors& s = cases[1];
    for (int d = 0; d < 3; ++d) {
        wrong.stores.work.standard[0][all_axes[static_cast<std::size_t>(d)]] = cases[0].dg(d);
        wrong.stores.parameters.set(19700 + d, s.dp(d));
        wrong.stores.parameters.set(19703 + d, s.dd(d));
    }
    const setup::Setup injected = with_stores(setup, {cases[0].dg, s.dp, s.dd});
    // Result lines end in " X<x> Y<y> Z<z>"; blanks may stand between a sign and its digits. Stores
    // differ on purpose, and so do the machine positions to which the control moves.
    const auto numbers = [](const std::string& text) {
        std::vector<double> list;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            const auto x = line.find(" X");
            if (x == std::string::npos || line.starts_with("STORE")) continue;
            if (line.starts_with("AT ") || line.starts_with("TOUCH ")) continue;
            std::string values = line.substr(x);
            std::erase(values, ' ');
            for (std::size_t at = 0; at != std::string::npos; at = values.find_first_of("YZ", at))
                list.push_back(std::stod(values.substr(++at)));
        }
        return list;
    };
    for (int program = 8001; program <= 8004; ++program) {
        INFO("O" << program);
        const auto by_store = numbers(run(wrong, program, 1).printed);
        const auto by_effect = numbers(run(injected, program, 1).printed);
        REQUIRE(by_store.size() > 150);
        REQUIRE(by_store.size() == by_effect.size());
        for (std::size_t i = 0; i < by_store.size(); ++i)
            CHECK(by_store[i] == Approx(by_effect[i]).margin(2e-5));
    }
}

}  // namespace trunnion
