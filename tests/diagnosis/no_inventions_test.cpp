// No inventions on our own data: shipped programs run with one effect at five sigma and diagnosed.
// That effect, or a rival listed with it, comes first, and nothing else is claimed.

#include <fmt/format.h>

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;
constexpr double wanted_sigmas = 5.0;

struct Program {
    const char *machine, *folder;
    int number;
};

setup::Setup setup_of(const Program& program) {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(root + "/machines/" + program.machine, notes);
    if (setup.ballbar) setup.ballbar->sample_deg = 5.0;
    return setup;
}

records::ReadingTable run_of(const setup::Setup& setup, const Program& program,
                             std::uint64_t seed) {
    interpreter::ProgramFolders folders({root + "/programs/" + program.folder, root + "/programs"});
    emulator::RunOptions options;
    options.seed = seed;
    options.effects = effects::active_models(setup);
    emulator::RunLog log = emulator::run_program(setup, folders, program.number, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

/// k sigma of what `models` add: rms over the readings, each divided by its sigma, after set-up and
/// re-identified base are taken out.
double sigmas_of(const setup::Setup& setup, const records::ReadingTable& table,
                 const emulator::EffectModels& models) {
    const emulator::Replay replay(setup, table);
    const kinematics::ForwardModel forward(setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, forward, {}));
    const Eigen::VectorXd weight =
        identification::row_noise(setup, table, replay).sigma_mm.cwiseInverse();
    const Eigen::MatrixXd base =
        weight.asDiagonal() * identification::base_columns(setup, replay,
                                                           effects::make_catalogue(setup),
                                                           setup.model.modelled, gradient)
                                  .columns;
    const std::vector<double> with = replay.predict(models), without = replay.predict({});
    const auto n = static_cast<Eigen::Index>(replay.size());
    const Eigen::VectorXd added =
        weight.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(with.data(), n) -
                            Eigen::Map<const Eigen::VectorXd>(without.data(), n));
    const Eigen::VectorXd left = added - base * base.colPivHouseholderQr().solve(added);
    return left.norm() / std::sqrt(static_cast<double>(n));
}

/// The effect with its usual keys, its parameters at a size that five sigma see; nothing when the
/// readings cannot show it.
std::optional<setup::EffectSetting> at_five_sigma(const effects::Effect& effect,
                                                  const setup::Setup& setup,
                                                  const records::ReadingTable& table) {
    std::vector<double> values = effect.zeros();
    for (std::size_t j = 0; j < values.size(); ++j)
        if (!effect.parameters[j].is_key() && effect.parameters[j].usual)
            values[j] = effect.parameters[j].typical;
    for (int pass = 0; pass < 3; ++pass) {  // effects are nearly linear in their size
        const double k = sigmas_of(setup, table, {effects::make_model(effect, values)});
        if (k < 0.05) return std::nullopt;
        for (std::size_t j = 0; j < values.size(); ++j)
            if (!effect.parameters[j].is_key()) values[j] *= wanted_sigmas / k;
    }
    return effects::setting_of(effect, values);
}

void check_named(const diagnosis::Diagnosis& d, const std::string& effect) {
    REQUIRE_FALSE(d.causes.empty());
    const diagnosis::Cause& first = d.causes.front();
    const auto& rivals = first.rivals;
    CHECK((first.effect == effect ||
           std::find(rivals.begin(), rivals.end(), effect) != rivals.end()));
    for (std::size_t k = 1; k < d.causes.size(); ++k)
        CHECK((d.causes[k].probability <= 0.5 || d.causes[k].effect == effect));
}

void check_effect(const Program& program, const effects::Effect& effect, const setup::Setup& setup,
                  const records::ReadingTable& clean) {
    const auto setting = at_five_sigma(effect, setup, clean);
    if (!setting) return;
    setup::Setup real = setup;
    real.effects.push_back(*setting);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, run_of(real, program, 7), options);
    std::string said = to_string(d.verdict);
    for (const diagnosis::Cause& cause : d.causes)
        said += fmt::format(", {} {:.2f}", cause.effect, cause.probability);
    INFO(program.machine << " O" << program.number << " with " << effect.name << ": " << said);
    check_named(d, effect.name);
    const diagnosis::Diagnosis none = diagnosis::diagnose(real, run_of(real, program, 8), options);
    CHECK(none.verdict == diagnosis::Verdict::no_gap);
}

}  // namespace

TEST_CASE("one effect at five sigma on every shipped program is named alone",
          "[.assure][inventions]") {
    const Program program = GENERATE(
        Program{"bc_table.toml", "pivot", 8001}, Program{"bc_table.toml", "pivot", 8002},
        Program{"bc_table.toml", "pivot", 8003}, Program{"bc_table.toml", "pivot", 8004},
        Program{"bc_table.toml", "ballbar/bc", 8200}, Program{"ac_trunnion.toml", "ballbar", 8200});
    const setup::Setup setup = setup_of(program);
    const records::ReadingTable clean = run_of(setup, program, 1);
    for (const effects::Effect& effect : effects::make_catalogue(setup))
        if (effect.name != "location") check_effect(program, effect, setup, clean);
}

TEST_CASE("five sigma of backlash on a shipped program is no slipped sphere", "[inventions]") {
    const Program program{"bc_table.toml", "pivot", 8002};
    const setup::Setup setup = setup_of(program);
    const records::ReadingTable clean = run_of(setup, program, 1);
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    for (const char* name : {"C.backlash", "B.backlash"})
        check_effect(program, *effects::find_effect(catalogue, name), setup, clean);
}

}  // namespace trunnion
