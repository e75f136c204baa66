// The law of every number that is printed to be typed into a control: once it is in the stores, all
// positioning functions keep the physical tip on its point of the table.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "ballbar/test/ballbar_procedure.h"
#include "base/random.h"
#include "base/units.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "positioning/rotary_transform.h"
#include "setup/right_stores.h"

namespace trunnion {
namespace {

const std::string machines = std::string(TRUNNION_SOURCE_DIR) + "/machines/";

setup::Setup load(const std::string& name) {
    std::vector<std::string> notes;
    return setup::load_setup(machines + name, notes);
}

std::vector<std::string> machine_files() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(machines))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().filename().string());
    std::sort(files.begin(), files.end());
    return files;
}

Vector3 random_vector(SeededNoise& noise, double size) {
    return size * Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5);
}

/// Axis lines elsewhere than the stores say, no tilt; only its C table under a head keeps X and Y
/// travel free.
void displace(setup::Setup& setup, SeededNoise& noise) {
    setup.machine.errors = {};
    setup.effects.clear();
    for (auto* side : {&setup.machine.chain.work, &setup.machine.chain.tool})
        for (kinematics::AxisGeometry& axis : *side) {
            axis.min = axis.max = std::nullopt;
            if (!axis.rotary) continue;
            const Vector3 shift = random_vector(noise, 0.5);
            for (const int i : {0, 1, 2})
                setup.machine.errors.axis[index_of(axis.axis)]
                    .location[static_cast<std::size_t>(i)] = shift[i];
        }
    for (int number = 19666; number <= 19744; ++number) setup.stores.parameters.entry.erase(number);
    REQUIRE(setup::derive_pivot_parameters(setup.machine, setup.stores.parameters).empty());
}

void enter(const setup::RotaryStores& stores, setup::Setup& setup) {
    for (const setup::StoreNumber& number : setup::store_numbers(stores))
        if (number.parameter != 0)
            setup.stores.parameters.set(number.parameter, number.value_mm);
        else
            setup.stores.work.standard[0].value[static_cast<std::size_t>(number.component)] =
                number.value_mm;
}

std::string xyz(const Vector3& v) {
    return fmt::format(" X{:.12f} Y{:.12f} Z{:.12f}", v.x(), v.y(), v.z());
}

/// The machine's rotary axes as the control knows them, and a point that the tip is to keep.
struct Functions {
    setup::Setup setup;
    setup::RotaryStores stores;
    Vector3 point_M;  ///< of the tip, rotaries at zero, as the control reads it
    double length_mm = 150.0;

    std::string turn(double first_deg, double second_deg) const {
        return fmt::format(" {}{:.9f} {}{:.9f}", letter_of(stores.pivot.first.axis), first_deg,
                           letter_of(stores.pivot.second.axis), second_deg);
    }
    AxisPositions angles(double first_deg, double second_deg) const {
        AxisPositions q;
        q[stores.pivot.first.axis] = rad_from_deg(first_deg);
        q[stores.pivot.second.axis] = rad_from_deg(second_deg);
        return q;
    }
    /// A postprocessor's table: turned about G54.
    Matrix3 table(double first_deg, double second_deg) const {
        return positioning::RotaryTransform(stores.pivot)
            .pose_MW(angles(first_deg, second_deg))
            .rotation;
    }
    std::string dpp(double first, double second) const {
        return "G54 G43 H1 G0" + xyz(table(first, second) * (point_M - stores.g54)) +
               turn(first, second);
    }
    std::string rtdfo(double first, double second) const {
        return "G54\nG54.2 P1\nG43 H1 G0 X0 Y0 Z0" + turn(first, second);
    }
    std::string rtcp(double first, double second) const {
        return "G55 G0" + turn(0, 0) + "\nG43.4 H1 X0 Y0 Z0\nX0 Y0 Z0" + turn(first, second);
    }
    std::string tw(double first, double second) const {
        const Vector3 n =
            positioning::RotaryTransform(stores.pivot).tool_direction_W(angles(first, second));
        const double i = deg_from_rad(std::atan2(n.x(), -n.y())),
                     j = deg_from_rad(std::atan2(std::hypot(n.x(), n.y()), n.z()));
        return "G55 G0" + turn(first, second) +
               fmt::format("\nG68.2 X0 Y0 Z0 I{:.12f} J{:.12f} K0\nG53.1\nG43 H1 G0 X0 Y0 Z0", i,
                           j);
    }
};

/// Last true tip of a run in W.
Vector3 true_tip(const Functions& f, const std::string& text) {
    const auto owner =
        std::make_shared<std::string>("G90 G21 G17 G94 G40 G49 G80\nT1 M6\n" + text + "\nM30\n");
    interpreter::ProgramFolders programs({});
    const interpreter::ProgramText program{"law.nc", *owner, owner};
    programs.add_file(program);
    emulator::RunOptions options;
    options.trace = options.truth = true;
    const emulator::RunLog log = emulator::run_program(f.setup, programs, program, options);
    if (log.result.alarm) FAIL(log.result.alarm->number << log.result.alarm->text << text);
    std::istringstream lines(log.trace_csv);
    std::string head, last;
    std::getline(lines, head);
    for (std::string line; std::getline(lines, line);) last = line;
    const auto cells = [](const std::string& line) {
        std::vector<std::string> out;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
        return out;
    };
    const auto names = cells(head), values = cells(last);
    Vector3 tip;
    for (int i = 0; i < 3; ++i) {
        const auto at =
            std::find(names.begin(), names.end(), std::string("true_") + "xyz"[i] + "_mm") -
            names.begin();
        tip[i] = std::stod(values.at(static_cast<std::size_t>(at)));
    }
    return tip;
}

Functions functions_of(const setup::Setup& setup, SeededNoise& noise) {
    Functions f{setup, *setup::rotary_stores(setup.machine.chain, setup.stores), {}};
    f.setup.stores.tools.tool[1] = {};
    f.setup.stores.tools.tool[1].length_geometry_mm = f.length_mm;
    f.point_M = Vector3(20, 30, 60) + random_vector(noise, 100.0);
    for (const std::size_t i : {0U, 1U, 2U}) {
        const auto k = static_cast<Eigen::Index>(i);
        f.setup.stores.work.standard[1].value[i] = f.point_M[k];
        f.setup.stores.fixture.set[0].offset.value[i] = f.point_M[k] - f.stores.g54[k];
    }
    return f;
}

bool inclined(const offsets::PivotParameters& pivot) {
    return pivot.first.line.cwiseAbs().maxCoeff() < 0.999 ||
           pivot.second.line.cwiseAbs().maxCoeff() < 0.999;
}

constexpr std::pair<double, double> poses[] = {{30, 0}, {-60, 75}, {0, 200}, {80, -130}};

/// How far the tip wanders from its place at home, mm: G43.4 and G68.2 first, then DPP and G54.2
/// (of machines with a rotary table, a head standing at zero).
std::pair<double, double> wander_mm(const Functions& f) {
    const bool head = f.stores.pivot.unit != offsets::MechanicalUnit::table_table;
    const bool table = f.stores.pivot.unit != offsets::MechanicalUnit::tool_tool;
    const Vector3 home = true_tip(f, f.rtcp(0, 0));
    double tcp = 0.0, g54 = 0.0;
    for (const auto& [first, second] : poses) {
        tcp = std::max({tcp, (true_tip(f, f.rtcp(first, second)) - home).norm(),
                        (true_tip(f, f.tw(first, second)) - home).norm()});
        if (!table) continue;
        const double tilt = head ? 0.0 : first;
        g54 = std::max(g54, (true_tip(f, f.dpp(tilt, second)) - home).norm());
        if (!inclined(f.stores.pivot))
            g54 = std::max(g54, (true_tip(f, f.rtdfo(tilt, second)) - home).norm());
    }
    return {tcp, g54};
}

/// The second table axis moved so that it meets the first.
void let_axes_meet(setup::Setup& setup) {
    if (setup::rotary_stores(setup.machine.chain, setup.stores)->pivot.unit !=
        offsets::MechanicalUnit::table_table)
        return;
    setup::RotaryStores right = setup::right_stores(
        setup.machine, *setup::rotary_stores(setup.machine.chain, setup.stores));
    const Vector3 step = setup::step_between_axes_mm(right);
    auto& location = setup.machine.errors.axis[index_of(right.pivot.second.axis)].location;
    for (const int i : {0, 1, 2}) location[static_cast<std::size_t>(i)] -= step[i];
}

}  // namespace

TEST_CASE("right stores keep the tip on its point in all functions, on every machine") {
    SeededNoise noise(41);
    int tested = 0;
    for (const std::string& file : machine_files()) {
        setup::Setup setup = load(file);
        std::vector<std::string> notes;
        if (!setup::derive_pivot_parameters(setup.machine, setup.stores.parameters).empty())
            continue;
        for (int k = 0; k < 3; ++k) {
            CAPTURE(file, k);
            displace(setup, noise);
            if (k > 0) let_axes_meet(setup);
            const auto before = wander_mm(functions_of(setup, noise));
            CHECK(before.first > 0.02);
            enter(setup::right_stores(setup.machine,
                                      *setup::rotary_stores(setup.machine.chain, setup.stores)),
                  setup);
            const Functions f = functions_of(setup, noise);
            const auto after = wander_mm(f);
            CHECK(after.first < 1e-6);
            const double apart_mm = setup::step_between_axes_mm(f.stores).norm();
            if (k > 0) CHECK(apart_mm < 1e-9);
            CHECK(after.second < 2.0 * apart_mm + 1e-6);
            if (apart_mm > 1e-6) CHECK(after.second > 0.2 * apart_mm);
            ++tested;
        }
    }
    CHECK(tested >= 18);
}

TEST_CASE("right stores hold on random chains, linear axes on either side") {
    SeededNoise noise(42);
    const char* files[] = {"ac_trunnion.toml", "bc_table.toml",       "head_table.toml",
                           "head_head.toml",   "nutating_table.toml", "nutating_head.toml"};
    for (int k = 0; k < 18; ++k) {
        setup::Setup setup = load(files[k % 6]);
        CAPTURE(k, files[k % 6]);
        kinematics::Chain& chain = setup.machine.chain;
        for (auto* side : {&chain.work, &chain.tool})
            for (kinematics::AxisGeometry& axis : *side)
                if (axis.rotary) axis.point_mm += random_vector(noise, 80.0);
        if (k % 2) {  // X carries the work and all that is under it
            const auto x = std::find_if(chain.tool.begin(), chain.tool.end(),
                                        [](auto& a) { return a.axis == Axis::X; });
            kinematics::AxisGeometry slide = *x;
            slide.direction = -slide.direction;
            chain.tool.erase(x);
            chain.work.insert(chain.work.begin(), slide);
        }
        displace(setup, noise);
        enter(setup::right_stores(setup.machine, *setup::rotary_stores(chain, setup.stores)),
              setup);
        CHECK(wander_mm(functions_of(setup, noise)).first < 1e-6);
    }
}

TEST_CASE("what ballbar prints to type keeps the tip on its point") {
    SeededNoise noise(43);
    for (const std::string file : {"ac_trunnion.toml", "bc_table.toml"}) {
        CAPTURE(file);
        setup::Setup setup = load(file);
        setup.ballbar->noise_um = 0.0;
        setup.ballbar->sample_hz = 4.0;
        displace(setup, noise);
        let_axes_meet(setup);
        // What no reading sees: the axes along themselves. The home pose is the table's own.
        const ballbar::test::BallbarResult result = ballbar::test::run_ballbar(setup, {});
        REQUIRE(result.stores);
        CHECK(result.stores->tilts_um < 1e-3);
        CHECK(result.stores->rounding_um < 3.0);
        enter(result.stores->exact, setup);
        const auto [tcp, g54] = wander_mm(functions_of(setup, noise));
        CHECK(tcp < 1e-6);
        CHECK(g54 < 1e-6);
    }
}

TEST_CASE("the shipped A-C table: 19704 is the C axis against the A axis") {
    setup::Setup setup = load("ac_trunnion.toml");
    const auto list = setup::stores_to_type(setup, setup.machine, {75, 0, 110}, {0, 0, -120});
    REQUIRE(list);
    CHECK(list->exact.pivot.table_offset_mm.y() == Approx(0.1041).margin(1e-12));
    CHECK(list->exact.pivot.table_offset_mm.x() == Approx(0.0283).margin(1e-12));
    CHECK(list->now_um > 100.0);
    CHECK(list->tilts_um < 60.0);
    enter(list->exact, setup);
    for (kinematics::AxisErrors& axis : setup.machine.errors.axis)
        for (const std::size_t tilt : {3U, 4U, 5U}) axis.location[tilt] = 0.0;
    SeededNoise noise(44);
    CHECK(wander_mm(functions_of(setup, noise)).first < 1e-6);
}

TEST_CASE("a G54.2 set is counted from G54, so it changes with it") {
    setup::Setup setup = load("bc_table.toml");
    setup.stores.fixture.set[0].offset[Axis::X] = 120.0;
    const auto list = setup::stores_to_type(setup, setup.machine, {75, 0, 110}, {0, 0, -120});
    REQUIRE(list);
    REQUIRE(list->fixture.size() == 3);
    CHECK(list->fixture[0].exact_mm == Approx(120.1443).margin(1e-12));
    CHECK(list->fixture[1].exact_mm == Approx(0.1443).margin(1e-12));
    CHECK(list->g54_left_um < 1e-6);
}

}  // namespace trunnion
