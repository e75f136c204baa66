// No inventions on our own data: every program that measures, run with one effect at five sigma and
// diagnosed. That effect, or a rival listed with it, comes first, and nothing else is claimed; with
// the effect on both sides there is no gap.

#include <fmt/format.h>

#include <Eigen/QR>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "emulator/replay.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

constexpr double wanted_sigmas = 5.0;
constexpr double largest_size = 10.0;  ///< in usual sizes: a machine that is still one

/// A machine, one program, and what the readings of the program cannot tell from set-up and
/// location.
struct Bench {
    std::string name;
    setup::Setup setup;
    measured::Program program;
    records::ReadingTable clean;
    emulator::Replay replay;
    effects::Catalogue catalogue;
    Eigen::VectorXd per_sigma;  ///< 1 / sigma of each reading, 1 / mm
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> base;
    std::vector<double> without;  ///< predicted without any effect, mm

    Bench(const measured::Shipped& machine, const setup::Setup& of, measured::Program measuring)
        : name(fmt::format("{} {}", machine.file, measuring.name)),
          setup(of),
          program(std::move(measuring)),
          clean(measured::run_of(setup, program)),
          replay(setup, clean),
          catalogue(effects::make_catalogue(setup, effects::extent_of(setup, clean))),
          per_sigma(identification::row_noise(setup, clean, replay).sigma_mm.cwiseInverse()),
          without(replay.predict({})) {
        const kinematics::ForwardModel forward(setup.machine);
        std::vector<kinematics::Perturbation> gradient;
        for (std::size_t i = 0; i < replay.size(); ++i)
            gradient.push_back(replay.gradient(i, forward, {}));
        const Eigen::MatrixXd columns =
            per_sigma.asDiagonal() *
            identification::base_columns(setup, replay, catalogue, setup.model.modelled, gradient)
                .columns;
        base.compute(columns);
    }

    /// k sigma of what `models` add: rms over the readings, each divided by its sigma, after set-up
    /// and re-identified base are taken out.
    double sigmas_of(const emulator::EffectModels& models) const {
        const std::vector<double> with = replay.predict(models);
        const auto n = static_cast<Eigen::Index>(replay.size());
        const Eigen::VectorXd added =
            per_sigma.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(with.data(), n) -
                                   Eigen::Map<const Eigen::VectorXd>(without.data(), n));
        Eigen::VectorXd across = base.householderQ().transpose() * added;
        across.head(base.rank()).setZero();
        return across.norm() / std::sqrt(static_cast<double>(n));
    }
};

setup::Setup shipped_setup(const measured::Shipped& machine) {
    setup::Setup setup = measured::setup_of(measured::setup_text(machine));
    if (!setup.ballbar) return setup;
    setup.ballbar->sample_deg = 5.0;
    setup.ballbar->noise_um = setup.model.noise_um.at("ballbar");  // the noise that is stated
    return setup;
}

/// A ripple that no reading tells from a slower form of the same axis: the program takes the axis
/// to even places further apart than half its period, to fewer than eight, or not over two periods.
bool unresolved(const effects::Effect& effect, const records::ReadingTable& table) {
    if (!effect.name.ends_with(".cyclic")) return false;
    const auto axis = table.names.find(effect.name.substr(0, effect.name.find('.')));
    // In hundredths of a mm, or of a mrad: samples of the same place differ by rounding.
    std::set<long> places;
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none)
            places.insert(
                std::lround(row.commanded[axis.value()] * (is_rotary(*axis) ? 1e5 : 1e2)));
    long least = std::numeric_limits<long>::max();
    int distinct = 1;
    for (auto at = places.begin(); at != places.end() && std::next(at) != places.end(); ++at)
        if (*std::next(at) - *at > 1) {
            least = std::min(least, *std::next(at) - *at);
            ++distinct;
        }
    const double key = effect.zeros().back();
    const double period = is_rotary(*axis) ? 2e5 * pi / key : 1e2 * key;
    return distinct < 8 || static_cast<double>(*places.rbegin() - *places.begin()) < 2.0 * period ||
           2.0 * static_cast<double>(least) > 1.01 * period;
}

struct Injected {
    setup::EffectSetting setting;
    double size = 1.0;  ///< in usual sizes
};

/// The effect with its usual keys, its parameters at a size that five sigma see; nothing when even
/// ten times its usual size does not show that much: the program cannot see it.
std::optional<Injected> at_five_sigma(const Bench& bench, const effects::Effect& effect) {
    if (unresolved(effect, bench.clean)) return std::nullopt;
    std::vector<double> values = effect.zeros();
    for (std::size_t j = 0; j < values.size(); ++j)
        if (!effect.parameters[j].is_key() && effect.parameters[j].usual &&
            !effect.parameters[j].mean_line)  // the slope of that line is squareness
            values[j] = effect.parameters[j].typical;
    double size = 1.0;
    for (int pass = 0; pass < 3; ++pass) {  // effects are nearly linear in their size
        const double k = bench.sigmas_of({effects::make_model(effect, values)});
        if (pass == 0 && k < wanted_sigmas / largest_size) return std::nullopt;
        size *= wanted_sigmas / k;
        for (std::size_t j = 0; j < values.size(); ++j)
            if (!effect.parameters[j].is_key()) values[j] *= wanted_sigmas / k;
    }
    return Injected{effects::setting_of(effect, values), size};
}

std::string said_by(const diagnosis::Diagnosis& d) {
    std::string said = fmt::format("{} {:.2f}", to_string(d.verdict), d.explained);
    for (const diagnosis::Cause& cause : d.causes) {
        said +=
            fmt::format(", {} p {:.2f} share {:.2f}", cause.effect, cause.probability, cause.share);
        for (const std::string& rival : cause.rivals) said += " | " + rival;
    }
    return said;
}

bool named_first(const diagnosis::Diagnosis& d, const std::string& effect) {
    if (d.causes.empty()) return false;
    const auto& [first, rivals] = std::tie(d.causes.front().effect, d.causes.front().rivals);
    return first == effect || std::find(rivals.begin(), rivals.end(), effect) != rivals.end();
}

bool claims_another(const diagnosis::Diagnosis& d, const std::string& effect) {
    for (std::size_t k = 1; k < d.causes.size(); ++k)
        if (d.causes[k].probability > 0.5 && d.causes[k].effect != effect) return true;
    return false;
}

/// Of the noise; TRUNNION_SEED gives another one.
std::uint64_t first_seed() {
    const char* given = std::getenv("TRUNNION_SEED");
    return given ? std::stoull(given) : 7;
}

/// How many effects were tried, and what went wrong.
struct Tally {
    int tried = 0;
    std::vector<std::string> not_first, invented, gap_of_itself;
};

struct Judged {
    setup::Setup believed;
    records::ReadingTable readings;
    diagnosis::Diagnosis diagnosis;
};

Judged diagnosed(const Bench& bench, const setup::Setup& believed, const setup::Setup& real,
                 std::uint64_t seed) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    records::ReadingTable readings = measured::run_of(real, bench.program, seed);
    diagnosis::Diagnosis d = diagnosis::diagnose(believed, readings, options);
    return {believed, std::move(readings), std::move(d)};
}

/// Adds what went wrong to its list; TRUNNION_KEEP names a folder for readings and setup.
void keep(std::vector<std::string>& list, const Bench& bench, const std::string& what,
          const Judged& judged) {
    list.push_back(fmt::format("{}: {}: {}", bench.name, what, said_by(judged.diagnosis)));
    if (const char* folder = std::getenv("TRUNNION_KEEP")) {
        std::string name = fmt::format("{} {}", bench.name, what.substr(0, what.find(" of ")));
        std::replace(name.begin(), name.end(), ' ', '_');
        const std::string path = std::string(folder) + "/" + name;
        std::ofstream(path + ".csv") << records::format_readings(judged.readings);
        std::ofstream(path + ".toml") << setup::format_setup(judged.believed);
    }
}

void try_effect(const Bench& bench, const effects::Effect& effect, Tally& tally) {
    const auto injected = at_five_sigma(bench, effect);
    if (!injected) return;
    ++tally.tried;
    const std::string what = fmt::format("{} of {:.3g} usual sizes", effect.name, injected->size);
    setup::Setup real = bench.setup;
    real.effects.push_back(injected->setting);
    const Judged gap = diagnosed(bench, bench.setup, real, first_seed());
    if (!named_first(gap.diagnosis, effect.name))
        keep(tally.not_first, bench, what, gap);
    else if (claims_another(gap.diagnosis, effect.name))
        keep(tally.invented, bench, what, gap);
    const auto seed = first_seed() + static_cast<std::uint64_t>(tally.tried);
    const Judged none = diagnosed(bench, real, real, seed);
    if (none.diagnosis.verdict != diagnosis::Verdict::no_gap)
        keep(tally.gap_of_itself, bench, what + " on both sides", none);
}

void print(const char* what, const std::vector<std::string>& list) {
    for (const std::string& line : list) std::cout << what << ": " << line << '\n';
}

/// True when the environment variable is not set or is a part of the name.
bool wanted(const char* variable, const std::string& name) {
    const char* only = std::getenv(variable);
    return !only || name.find(only) != std::string::npos;
}

/// Every effect on every program of a machine; TRUNNION_INVENTIONS names the programs to be tried,
/// TRUNNION_EFFECT the effects.
Tally tally_of(const measured::Shipped& machine) {
    const setup::Setup setup = shipped_setup(machine);
    Tally tally;
    for (const measured::Program& program : measured::programs_of(machine, setup)) {
        if (!wanted("TRUNNION_INVENTIONS", program.name)) continue;
        const Bench bench(machine, setup, program);
        Tally own;
        for (const effects::Effect& effect : bench.catalogue)
            if (effect.name != "location" && wanted("TRUNNION_EFFECT", effect.name))
                try_effect(bench, effect, own);
        std::cout << bench.name << ": " << own.tried << " effects, not first "
                  << own.not_first.size() << ", others claimed " << own.invented.size()
                  << ", gaps of itself " << own.gap_of_itself.size() << '\n';
        print("NOT FIRST", own.not_first);
        print("INVENTED", own.invented);
        print("GAP", own.gap_of_itself);
        std::cout.flush();
        tally.tried += own.tried;
        for (auto list : {&Tally::not_first, &Tally::invented, &Tally::gap_of_itself})
            (tally.*list).insert((tally.*list).end(), (own.*list).begin(), (own.*list).end());
    }
    return tally;
}

}  // namespace

TEST_CASE("one effect at five sigma on every measuring program is named alone",
          "[.assure][inventions]") {
    const std::size_t machine = GENERATE(0, 1, 2, 3, 4);
    const measured::Shipped& shipped = measured::shipped_machines()[machine];
    if (!wanted("TRUNNION_MACHINE", shipped.file)) return;
    const Tally tally = tally_of(shipped);
    CHECK(tally.not_first.empty());
    CHECK(tally.invented.empty());
    CHECK(tally.gap_of_itself.empty());
}

// Both sides of approach: few poses, which are left and taken again. B.radial has twelve
// parameters, gravity and a tilt of C together imitate it with fewer.
TEST_CASE("few poses, each measured twice, name one effect with many parameters", "[inventions]") {
    const measured::Shipped& machine = measured::shipped_machines().front();
    const setup::Setup setup = shipped_setup(machine);
    for (const measured::Program& program : measured::programs_of(machine, setup)) {
        const bool both = program.name == "both_ways", still = program.name == "reference_sphere";
        if (!both && !still) continue;
        const Bench bench(machine, setup, program);
        Tally tally;
        for (const char* name : {"B.radial", "C.radial", "thermal.drift", "X.backlash"})
            try_effect(bench, *effects::find_effect(bench.catalogue, name), tally);
        CHECK(tally.tried >= (both ? 3 : 2));
        CHECK(tally.not_first.empty());
        CHECK(tally.invented.empty());
        CHECK(tally.gap_of_itself.empty());
    }
}

struct Once {
    std::size_t machine;
    const char *program, *effect;
};

// Each was invented or missed once. Noise that is estimated with a member makes the member look
// certain on few poses; a ripple on even places has several periods; a slip at a time that no grid
// holds loses against a driver; a slip before the last visit is the zero of the last test.
TEST_CASE("few poses, even places and a moment name one effect alone", "[inventions]") {
    for (const Once& once :
         {Once{0, "O8300", "B.cyclic"}, Once{0, "long_stylus", "C.backlash"},
          Once{1, "clamped", "A.positioning"}, Once{3, "warm", "A.tilt"},
          Once{3, "clamped", "artefact.moved"}, Once{4, "mill.nc", "artefact.moved"}}) {
        const measured::Shipped& machine = measured::shipped_machines()[once.machine];
        const setup::Setup setup = shipped_setup(machine);
        for (const measured::Program& program : measured::programs_of(machine, setup)) {
            if (program.name != once.program) continue;
            const Bench bench(machine, setup, program);
            Tally tally;
            try_effect(bench, *effects::find_effect(bench.catalogue, once.effect), tally);
            INFO(machine.file << " " << once.program << " " << once.effect);
            CHECK(tally.tried == 1);
            CHECK(tally.not_first.empty());
            CHECK(tally.invented.empty());
            CHECK(tally.gap_of_itself.empty());
        }
    }
}

TEST_CASE("a ripple on even places is a cause with all periods that they do not tell apart",
          "[inventions]") {
    const measured::Shipped& machine = measured::shipped_machines().front();
    const setup::Setup setup = shipped_setup(machine);
    const Bench bench(machine, setup, measured::programs_of(machine, setup)[5]);
    setup::Setup real = setup;
    real.effects.push_back(
        effects::parse_injection("B.cyclic: cos_rad=5e-5, sin_rad=5e-5", bench.catalogue));
    const diagnosis::Diagnosis d = diagnosed(bench, setup, real, 7).diagnosis;
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes.front().effect == "B.cyclic");
    CHECK(d.causes.front().parameters.back().value == 90.0);
    CHECK_THAT(d.causes.front().what, Catch::Contains("the same: 126, 306, 342"));
    CHECK_FALSE(d.between_places);
    CHECK(d.setup.effects.empty());  // it would be wrong elsewhere
}

TEST_CASE("five sigma of backlash on a shipped program is no slipped sphere", "[inventions]") {
    const measured::Shipped& machine = measured::shipped_machines().front();
    const setup::Setup setup = shipped_setup(machine);
    const Bench bench(machine, setup, measured::programs_of(machine, setup)[1]);
    Tally tally;
    try_effect(bench, *effects::find_effect(bench.catalogue, "B.backlash"), tally);
    CHECK(tally.tried == 1);
    CHECK(tally.not_first.empty());
    CHECK(tally.invented.empty());
    CHECK(tally.gap_of_itself.empty());
    // C comes from one side at every reading: its backlash shows as next to nothing.
    setup::Setup real = setup;
    real.effects.push_back(effects::parse_injection("C.backlash=60urad", bench.catalogue));
    for (const diagnosis::Cause& c : diagnosed(bench, setup, real, 7).diagnosis.causes)
        CHECK((c.effect == "C.backlash" || c.probability <= 0.5));
}

}  // namespace trunnion
