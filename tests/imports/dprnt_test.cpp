// What the measuring programs print comes in as the readings of the run: shipped and planned ones.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <sstream>

#include "diagnosis/advice/measurements.h"
#include "effects/settings.h"
#include "emulator/run.h"
#include "imports/import.h"
#include "interpreter/program_folders.h"
#include "records/readings.h"
#include "setup/programmed_point.h"
#include "setup/right_stores.h"
#include "tests/pivot/pivot_bench.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;

setup::Setup machine(const std::string& file) {
    std::vector<std::string> notes;
    return setup::load_setup(root + "/machines/" + file, notes);
}

emulator::RunLog run(const setup::Setup& setup, interpreter::ProgramFolders& source,
                     const emulator::ProgramChoice& program) {
    emulator::RunOptions options;
    options.effects = effects::active_models(setup);
    emulator::RunLog log = emulator::run_program(setup, source, program, options);
    INFO((log.result.alarm ? log.result.alarm->text + " in " + log.result.alarm->block : ""));
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return log;
}

imports::Imported imported(const setup::Setup& setup, const std::string& text) {
    const std::vector<imports::ImportFile> files{{"dir/print.txt", text}};
    return imports::import_readings(imports::ImportKind::dprnt,
                                    {setup, files, imports::Facts({}), {}});
}

bool has_column(const records::ReadingTable& table, const std::string& name) {
    const auto& columns = table.optional_columns;
    return std::find(columns.begin(), columns.end(), name) != columns.end();
}

/// Seven decimals are printed; a direction is a quotient of such numbers.
constexpr double printed = 1.1e-7;

void require_same(const records::Reading& a, const records::Reading& b,
                  const std::vector<Axis>& axes) {
    REQUIRE(a.index == b.index);
    REQUIRE(a.test == b.test);
    REQUIRE(a.device == b.device);
    REQUIRE(a.feature == b.feature);
    REQUIRE(a.mode == b.mode);
    for (const Axis axis : axes) {
        INFO("axis " << letter_of(axis));
        REQUIRE(a.commanded[axis] == Approx(b.commanded[axis]).epsilon(0).margin(2 * printed));
    }
    REQUIRE((a.direction_M - b.direction_M).norm() < printed);
    REQUIRE(a.value_mm.has_value() == b.value_mm.has_value());
    REQUIRE(a.point_W_mm.has_value() == b.point_W_mm.has_value());
    if (a.point_W_mm) REQUIRE((*a.point_W_mm - *b.point_W_mm).norm() < 8 * printed);
    if (a.value_mm) REQUIRE(*a.value_mm == Approx(*b.value_mm).epsilon(0).margin(6 * printed));
    REQUIRE(a.feed_mm_min == Approx(b.feed_mm_min).epsilon(0).margin(1e-3));
    REQUIRE(a.spindle_rad == b.spindle_rad);
    REQUIRE(a.temperature_c == b.temperature_c);
    REQUIRE(a.load_kg == b.load_kg);
    REQUIRE(a.clamped == b.clamped);
    REQUIRE(a.extension_mm == b.extension_mm);
}

/// The point at which the skip signal latched is on the sphere, seen from the table that the
/// control believes in: it coincides with M at home, where the errors of the axes move the real
/// one. With stores that fit the machine this holds in every pose; stores know no tilts, the probe
/// has its noise, and G54 is one point for two axes that need not meet.
void require_on_the_sphere(const setup::Setup& setup, const records::Reading& row) {
    const Matrix3 to_W = setup.machine.poses(row.commanded).pose_MW.rotation.transpose();
    const setup::Artefact& sphere = *setup.find_artefact(row.feature);
    const Vector3 centre = setup.machine.poses({}).pose_MW * sphere.center_W_mm;
    const Vector3 latched_W = *row.point_W_mm + to_W * (*row.value_mm * row.direction_M);
    const double reach_mm = 0.5 * (sphere.diameter_mm + setup.probe->ball_diameter_mm);
    const auto stores = setup::rotary_stores(setup.machine.chain, setup.stores);
    const bool by_g54 = row.mode == PositioningMode::dpp || row.mode == PositioningMode::rtdfo;
    const double apart_mm = by_g54 ? setup::step_between_axes_mm(*stores).norm() : 0.0;
    REQUIRE((latched_W - centre).norm() == Approx(reach_mm).margin(0.05 + 2.0 * apart_mm));
}

/// Every column but time_s.
void require_same_readings(const setup::Setup& setup, const emulator::RunLog& log) {
    std::vector<std::string> notes;
    const records::ReadingTable table =
        records::parse_readings(imported(setup, log.printed).readings, "import.csv", notes);
    REQUIRE(notes.empty());
    REQUIRE(log.readings.rows.size() > 20);
    REQUIRE(table.rows.size() == log.readings.rows.size());
    for (const std::string& column : log.readings.optional_columns)
        REQUIRE(has_column(table, column));
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        INFO("row " << i << " of test " << log.readings.rows[i].test << ", printed at "
                    << table.rows[i].source);
        require_same(table.rows[i], log.readings.rows[i], table.axes);
    }
}

void require_pivot_programs(setup::Setup setup) {
    pivot_bench::enter(pivot_bench::true_stores(setup), setup);
    const pivot::PivotPlan plan = pivot::plan_pivot_test(setup);
    interpreter::ProgramFolders source({root + "/programs"});
    for (const auto& [name, text] : pivot::pivot_programs(plan)) {
        const auto owner = std::make_shared<std::string>(text);
        source.add_file({name, *owner, owner});
    }
    for (const pivot::PivotFunction& function : plan.functions) {
        INFO(setup.name << " " << function.name);
        const emulator::RunLog log = run(setup, source, function.program);
        require_same_readings(setup, log);
        for (const records::Reading& row : log.readings.rows)
            if (row.device == records::Device::touch) require_on_the_sphere(setup, row);
    }
}

/// The text of one line on, as a program that was stopped leaves it.
std::string first_lines(const std::string& text, std::size_t count) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < count; ++k) at = text.find('\n', at) + 1;
    return text.substr(0, at);
}

void refuses(const setup::Setup& setup, const std::string& text, const std::string& part,
             int line) {
    INFO(text.substr(0, 400));
    try {
        imported(setup, text);
        FAIL("no error, but '" + part + "' was expected");
    } catch (const InputError& error) {
        CHECK_THAT(error.message, Catch::Contains(part));
        CHECK(error.where.line == line);
        CHECK(error.where.program == "dir/print.txt");
    }
}

const std::string good =
    "PIVOT DPP AXES B C MAPS 1 TO 1\nSTORE G54 X 0.1443 Y 0.1443 Z 0.1443\n"
    "STORE N19700 V 0.2\nTEST DPP MAP 1\n"
    "AT X  120.0 Y    0.0 Z  248.7 D    0.0 E    0.0\n"
    "TOUCH I 0.0 J 0.0 K-5.0 X 10.0 Y 20.0 Z 98.7 U 10.0 V 20.0 W 95.7 F 100.0 T 1500\n"
    "DPP END\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("prints of the four-function test on tables come in as the run's readings",
          "[imports][dprnt]") {
    for (const char* file : {"bc_table.toml", "ac_trunnion.toml", "nutating_table.toml"})
        require_pivot_programs(machine(file));
}

TEST_CASE("prints of the four-function test on heads and on a Hurco come in as the run's readings",
          "[imports][dprnt]") {
    for (const char* file : {"head_head.toml", "head_table.toml", "nutating_head.toml"})
        require_pivot_programs(machine(file));
    setup::Setup hurco = machine("ac_trunnion.toml");
    hurco.dialect.family = interpreter::DialectFamily::hurco;
    require_pivot_programs(hurco);
}

TEST_CASE("prints of every planned measurement with a probe come in as the run's readings",
          "[imports][dprnt]") {
    for (const char* file : {"bc_table.toml", "ac_trunnion.toml"}) {
        const setup::Setup setup = machine(file);
        interpreter::ProgramFolders source({root + "/programs"});
        int probing = 0;
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0)) {
            INFO(setup.name << " " << m.name);
            if (m.table.rows.back().device == records::Device::ballbar ||
                m.program.find("BALLBAR*ON") != std::string::npos)
                continue;
            ++probing;
            require_same_readings(
                setup, run(setup, source, interpreter::ProgramText{"O8900", m.program, {}}));
        }
        CHECK(probing == 11);
    }
}

TEST_CASE("each planned program begins with the operator's sheet", "[imports][dprnt]") {
    for (const diagnosis::Measurement& m :
         diagnosis::ready_measurements(machine("bc_table.toml"), 0.0)) {
        INFO(m.program.substr(0, 900));
        const bool bar = m.program.find("BALLBAR*ON") != std::string::npos;
        CHECK_THAT(m.program, Catch::Contains("(OPERATOR'S SHEET)") &&
                                  Catch::Contains("(TYPE: NOTHING.") &&
                                  Catch::Contains(bar ? "(MOUNT: BALLBAR 100.000 MM"
                                                      : "(MOUNT: SPHERE S1 25.400 MM"));
        if (m.name == "added_load")
            CHECK_THAT(m.program, Catch::Contains("(SET, AT A STOP: PUT 80 KG ON THE TABLE"));
    }
}

TEST_CASE("one touch by hand: value, place, direction, and a store that is not the declared one",
          "[imports][dprnt]") {
    const setup::Setup setup = machine("bc_table.toml");
    const imports::Imported result = imported(setup, good);
    std::vector<std::string> notes;
    const auto rows = records::parse_readings(result.readings, "r.csv", notes).rows;
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].device == records::Device::none);
    CHECK(rows[1].commanded[Axis::Z] == Approx(243.7));
    CHECK(rows[1].direction_M == Vector3(0, 0, -1));
    CHECK(*rows[1].value_mm == Approx(-2.0));  // 3 of 5 mm gone
    CHECK(rows[1].source == "print.txt:6");
    REQUIRE(result.notes.size() == 1);
    CHECK_THAT(result.notes[0], Catch::Contains("19700 was 0.2000 when the program ran, the setup "
                                                "declares 0.1443"));
}

TEST_CASE("the printed length of the probe is the one in force", "[imports][dprnt]") {
    setup::Setup setup = machine("bc_table.toml");
    const double declared_mm = setup::probe_length_mm(setup);
    const auto read = [&](double length_mm) {
        const imports::Imported result = imported(
            setup,
            with(good, "TEST DPP", fmt::format("STORE H   1 V {:.4f}\nTEST DPP", length_mm)));
        std::vector<std::string> notes;
        const auto rows = records::parse_readings(result.readings, "r.csv", notes).rows;
        return std::pair{result.notes.size(), rows.back().point_W_mm.value()};
    };
    const auto [notes, point_mm] = read(declared_mm);
    const auto [more, longer_mm] = read(declared_mm + 0.25);
    CHECK(notes == 1);  // of 19700
    CHECK(more == 2);
    CHECK((longer_mm - point_mm - Vector3(0, 0, -0.25)).norm() < 1e-9);
}

TEST_CASE("each program that probes prints the length of its probe", "[imports][dprnt]") {
    setup::Setup setup = machine("bc_table.toml");
    setup.stores.tools.tool[1].length_geometry_mm = 149.5;
    setup.stores.tools.tool[1].length_wear_mm = 0.5;
    interpreter::ProgramFolders source({root + "/programs", root + "/programs/pivot"});
    const std::string line = "STORE H   1 V  150.0000000";
    CHECK_THAT(run(setup, source, 8001).printed, Catch::Contains(line));
    for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0))
        CHECK_THAT(m.program, Catch::Contains("DPRNT[STORE*H#8[30]*V#7[47]]"));
}

TEST_CASE("a touch whose line AT was lost is refused", "[imports][dprnt]") {
    setup::Setup setup = machine("bc_table.toml");
    interpreter::ProgramFolders source({root + "/programs", root + "/programs/pivot"});
    std::istringstream printed(run(setup, source, 8003).printed);
    std::vector<std::string> lines;
    for (std::string line; std::getline(printed, line);) lines.push_back(line);
    int refused = 0, touches = 0;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        if (!lines[k].starts_with("TOUCH") || ++touches % 60 != 30) continue;
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (i + 1 != k) text += lines[i] + '\n';
        refuses(setup, text, "a line is missing", static_cast<int>(k));
        ++refused;
    }
    CHECK(refused == 10);
}

TEST_CASE("for a control with tool offset memory A the program says what to delete",
          "[imports][dprnt]") {
    setup::Setup setup = machine("bc_table.toml");
    setup.stores.tools.tool[1].length_geometry_mm = 0.0;  // all in #10001, the only one of memory A
    setup.stores.tools.tool[1].length_wear_mm = 150.0;
    const std::string comment = "(DELETE +#[11000+#8] IN THE SECOND OF THE NEXT LINES)\n#8=";
    for (const diagnosis::Measurement& m : diagnosis::ready_measurements(setup, 0.0))
        CHECK_THAT(m.program, Catch::Contains(comment + "1\n#7=#[10000+#8]+#[11000+#8]\n"));
    const pivot::PivotPlan plan = pivot::plan_pivot_test(setup);
    auto programs = pivot::pivot_programs(plan);
    std::string& common = programs["common.nc"];
    REQUIRE_THAT(common, Catch::Contains(comment + "#506\n#7=#[10000+#8]+#[11000+#8]\n"));
    common = with(common, "\n#7=#[10000+#8]+#[11000+#8]", "\n#7=#[10000+#8]");
    interpreter::ProgramFolders source({root + "/programs"});
    for (const auto& [name, text] : programs) {
        const auto owner = std::make_shared<std::string>(text);
        source.add_file({name, *owner, owner});
    }
    CHECK_THAT(run(setup, source, 8001).printed, Catch::Contains("STORE H   1 V  150.0000000"));
}

TEST_CASE("one file of prints may hold several runs, each with a clock of its own",
          "[imports][dprnt]") {
    const setup::Setup setup = machine("bc_table.toml");
    const auto read = [&](const imports::Imported& result) {
        std::vector<std::string> notes;
        return records::parse_readings(result.readings, "import.csv", notes).rows;
    };
    const std::string runs = good + with(good, "T 1500", "T 700");
    const imports::Imported one = imported(setup, runs);
    CHECK_THAT(one.summary[0], Catch::Contains("2 touches in 2 tests, 2 runs of programs"));
    REQUIRE(one.notes.size() > 0);
    CHECK_THAT(one.notes.back(), Catch::Contains("--with session=each"));
    const auto joined = read(one), single = read(imported(setup, good));
    REQUIRE(joined.size() == 2 * single.size());
    for (std::size_t i = 0; i < single.size(); ++i) {
        const records::Reading &again = joined[single.size() + i], &first = single[i];
        CHECK(again.commanded == first.commanded);
        CHECK(again.value_mm == first.value_mm);
        CHECK(again.session.empty());
        CHECK(again.time_s > joined[single.size() - 1].time_s);
    }
    const std::vector<imports::ImportFile> files{{"print.txt", runs}};
    const auto days = read(imports::import_readings(
        imports::ImportKind::dprnt, {setup, files, imports::Facts({"session=each"}), {}}));
    CHECK(days.front().session == "run_1");
    CHECK(days.back().session == "run_2");
}

TEST_CASE("prints that an editor saved with a byte order mark are read", "[imports][dprnt]") {
    const setup::Setup setup = machine("bc_table.toml");
    CHECK(imported(setup, "\xEF\xBB\xBF" + good).readings == imported(setup, good).readings);
}

TEST_CASE("prints that are refused name their line", "[imports][dprnt]") {
    const setup::Setup setup = machine("bc_table.toml");
    refuses(setup, "", "nothing was printed", 1);
    refuses(setup, first_lines(good, 6), "the program stopped here", 6);
    refuses(setup, first_lines(good, 6) + good, "stopped: another one begins in line 7", 1);
    refuses(setup, with(good, "TEST DPP MAP 1", "TEXT"), "no line of a measuring program", 4);
    refuses(setup, with(good, "AT X", "MODE X"), "before any line AT", 6);
    refuses(setup, with(good, " B C ", " A C "), "prints of another machine", 1);
    refuses(setup, with(good, "F 100.0", "F"), "no number behind F", 6);
    refuses(setup, with(good, "U 10.0", "U 10.6"), "not on the way", 6);
    refuses(setup, with(good, "K-5.0", "K 0.0"), "without a way", 6);
    refuses(setup, with(good, "X  120.0", "X  320.0"), "no sphere", 6);
    refuses(setup, with(good, "TEST", "BALLBAR ON"), "import ballbar", 4);
    const std::string again = good.substr(good.find("AT X"));
    refuses(setup, with(good, "DPP END\n", with(again, "T 1500", "T 1400")),
            "not in ascending order", 8);
}

}  // namespace trunnion
