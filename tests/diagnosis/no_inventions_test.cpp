// No inventions on our own data: shipped programs run with one effect at five sigma and diagnosed.
// That effect, or a rival listed with it, comes first, and nothing else is claimed.

#include <fmt/format.h>

#include <Eigen/QR>
#include <catch2/catch.hpp>
#include <set>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;
constexpr double wanted_sigmas = 5.0;
constexpr double largest_size = 10.0;  ///< in usual sizes: a machine that is still one

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
    INFO("O" << program.number << ": " << (log.result.alarm ? log.result.alarm->text : ""));
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

/// A ripple of an axis that the program takes to even places, further apart than half its period:
/// no reading tells it from a slower form of the same axis.
bool aliased(const effects::Effect& effect, const records::ReadingTable& table) {
    if (!effect.name.ends_with(".cyclic")) return false;
    const auto axis = table.names.find(effect.name.substr(0, effect.name.find('.')));
    std::set<long> places;  // in thousandths of a mm, or of a mrad
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none)
            places.insert(
                std::lround(row.commanded[axis.value()] * (is_rotary(*axis) ? 1e6 : 1e3)));
    long least = std::numeric_limits<long>::max();
    for (auto at = places.begin(); at != places.end() && std::next(at) != places.end(); ++at)
        least = std::min(least, *std::next(at) - *at);
    const double key = effect.zeros().back();
    const double period = is_rotary(*axis) ? 2e6 * pi / key : 1e3 * key;
    return 2.0 * static_cast<double>(least) > 1.01 * period;
}

struct Injected {
    setup::EffectSetting setting;
    double size = 1.0;  ///< in usual sizes
};

/// The effect with its usual keys, its parameters at a size that five sigma see; nothing when even
/// ten times its usual size does not show that much: the program cannot see it.
std::optional<Injected> at_five_sigma(const effects::Effect& effect, const setup::Setup& setup,
                                      const records::ReadingTable& table) {
    if (aliased(effect, table)) return std::nullopt;
    std::vector<double> values = effect.zeros();
    for (std::size_t j = 0; j < values.size(); ++j)
        if (!effect.parameters[j].is_key() && effect.parameters[j].usual)
            values[j] = effect.parameters[j].typical;
    double size = 1.0;
    for (int pass = 0; pass < 3; ++pass) {  // effects are nearly linear in their size
        const double k = sigmas_of(setup, table, {effects::make_model(effect, values)});
        if (pass == 0 && k < wanted_sigmas / largest_size) return std::nullopt;
        size *= wanted_sigmas / k;
        for (std::size_t j = 0; j < values.size(); ++j)
            if (!effect.parameters[j].is_key()) values[j] *= wanted_sigmas / k;
    }
    return Injected{effects::setting_of(effect, values), size};
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

/// False: the program cannot see the effect.
bool check_effect(const Program& program, const effects::Effect& effect, const setup::Setup& setup,
                  const records::ReadingTable& clean) {
    const auto injected = at_five_sigma(effect, setup, clean);
    if (!injected) return false;
    INFO(program.machine << " O" << program.number << " with " << effect.name << " of "
                         << injected->size << " usual sizes");
    setup::Setup real = setup;
    real.effects.push_back(injected->setting);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, run_of(real, program, 7), options);
    std::string said = to_string(d.verdict);
    for (const diagnosis::Cause& cause : d.causes)
        said += fmt::format(", {} {:.2f}", cause.effect, cause.probability);
    INFO(said << "; " << d.explained << " explained");
    check_named(d, effect.name);
    const diagnosis::Diagnosis none = diagnosis::diagnose(real, run_of(real, program, 8), options);
    CHECK(none.verdict == diagnosis::Verdict::no_gap);
    return true;
}

}  // namespace

TEST_CASE("one effect at five sigma on every shipped program is named alone",
          "[.assure][inventions]") {
    const Program program = GENERATE(
        Program{"bc_table.toml", "pivot", 8001}, Program{"bc_table.toml", "pivot", 8002},
        Program{"bc_table.toml", "pivot", 8003}, Program{"bc_table.toml", "pivot", 8004},
        Program{"bc_table.toml", "ballbar/bc", 8200}, Program{"bc_table.toml", "ballbar/bc", 8300},
        Program{"ac_trunnion.toml", "ballbar", 8200}, Program{"ac_trunnion.toml", "ballbar", 8300});
    const setup::Setup setup = setup_of(program);
    const records::ReadingTable clean = run_of(setup, program, 1);
    std::string unseen;
    for (const effects::Effect& effect : effects::make_catalogue(setup))
        if (effect.name != "location" && !check_effect(program, effect, setup, clean))
            unseen += " " + effect.name;
    WARN(program.machine << " O" << program.number << " cannot see:" << unseen);
}

TEST_CASE("five sigma of backlash on a shipped program is no slipped sphere", "[inventions]") {
    const Program program{"bc_table.toml", "pivot", 8002};
    const setup::Setup setup = setup_of(program);
    const records::ReadingTable clean = run_of(setup, program, 1);
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    CHECK(check_effect(program, *effects::find_effect(catalogue, "B.backlash"), setup, clean));
    // C comes from one side at every reading: its backlash shows as next to nothing.
    setup::Setup real = setup;
    real.effects.push_back(effects::parse_injection("C.backlash=60urad", catalogue));
    for (const diagnosis::Cause& c : diagnosis::diagnose(setup, run_of(real, program, 7)).causes)
        CHECK((c.effect == "C.backlash" || c.probability <= 0.5));
}

}  // namespace trunnion
