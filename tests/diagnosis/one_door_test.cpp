// One door: what a run reads is what predict reads from the rows that the run wrote, for every key
// of a setup and every effect of the catalogue, on every program that measures.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "ballbar/test/ballbar_program.h"
#include "diagnosis/measurements.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {
namespace {

const std::string root = TRUNNION_SOURCE_DIR;

std::string file_text(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(root + "/" + path).rdbuf();
    return text.str();
}

/// The text with a line put behind a section's title, or in the place of the key's line there; the
/// section is added when it is missing.
std::string with_line(std::string text, const std::string& section, const std::string& line) {
    const std::size_t at = text.find(section + "\n");
    if (at == std::string::npos) return text + "\n" + section + "\n" + line + "\n";
    const std::size_t begin = at + section.size() + 1, end = text.find("\n[", begin);
    const std::string key = line.substr(0, line.find(' ')) + " ";
    for (std::size_t of = begin; of < end && of != 0; of = text.find('\n', of) + 1)
        if (text.compare(of, key.size(), key) == 0)
            return text.replace(of, text.find('\n', of) - of, line);
    return text.insert(begin, line + "\n");
}

/// One thing that may be wrong with the machine: keys of the file, or an effect's parameters.
struct Wrong {
    std::string name;
    std::vector<std::pair<std::string, std::string>> lines;  ///< section, key
    std::string text(std::string setup) const {
        for (const auto& [section, line] : lines) setup = with_line(setup, section, line);
        return setup;
    }
};

void add_errors(const kinematics::Chain& chain, std::vector<Wrong>& list) {
    for (const kinematics::AxisGeometry& axis : chain.axes())
        for (int k = 0; k < 6; ++k) {
            const std::string unit = k < 3 ? "_mm" : "_rad", size = k < 3 ? "0.01" : "4e-5";
            const std::string of(1, letter_of(axis.axis)), direction(1, "XYZABC"[k]);
            const std::string key = "E" + direction + "0" + of + unit;
            list.push_back({key, {{"[machine.errors]", key + " = " + size}}});
            const std::string curve = "E" + direction + of + unit;
            const std::string form = axis.rotary ? " = { constant = " + size + ", slope = " + size +
                                                       ", harmonics = [[2, " + size + ", 0]] }"
                                                 : " = { at_mm = [-300, 0, 40, 300], value = [" +
                                                       size + ", 0, " + size + ", -" + size +
                                                       "], interpolation = \"cubic\" }";
            list.push_back({curve, {{"[machine.errors]", curve + form}}});
        }
    for (const char* key : {"EX0S_mm = 0.01", "EA0S_rad = 4e-5"})
        list.push_back({key, {{"[machine.errors]", key}}});
    list.push_back(
        {"EYS_mm", {{"[machine.errors]", "EYS_mm = { harmonics = [[1, 0.005, 0.002]] }"}}});
}

void add_device_keys(std::vector<Wrong>& list) {
    for (const auto& [section, line] :
         {std::pair{"[probe]", "pretravel_um = 5"},
          {"[probe]", "tip_mm = [0.02, -0.01, -150.03]"},
          {"[probe]", "ball_diameter_mm = 5.99"},
          {"[probe]", "extension_errors_mm = [60, 0.02, -0.01, 0.03]"},
          {"[ballbar]", "cup_mm = [0.01, 0.02, -120.01]"},
          {"[ballbar]", "length_mm = 100.01"},
          {"[ballbar]", "expansion_per_k = 1e-5\ntemperature_c = 24"},
          {"[control.tools]", "1 = { length_mm = 150.02 }"},
          {"[[artefact]]", "diameter_mm = 25.41"}})
        list.push_back({std::string(section) + " " + line, {{section, line}}});
}

void add_keys(const kinematics::Chain& chain, std::vector<Wrong>& list) {
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        const std::string of(1, letter_of(axis.axis)), section = "[machine.axis." + of + "]";
        const std::string gap = axis.rotary ? "backlash_rad = 6e-5" : "backlash_mm = 0.006";
        list.push_back({of + " backlash key", {{section, gap}}});
        list.push_back({of + " backlash, side -",
                        {{section, gap}, {"[machine]", "side = { " + of + " = \"-\" }"}}});
        const Vector3 &d = axis.direction, &q = axis.point_mm;
        list.push_back(
            {of + " place",
             {{section, axis.rotary ? fmt::format("point_mm = [{}, {}, {}]", q.x(), q.y() + 0.01,
                                                  q.z() - 0.02)
                                    : fmt::format("direction = [{}, {}, {}]", d.x() + 3e-5,
                                                  d.y() - 2e-5, d.z() + 1e-5)}}});
    }
    add_device_keys(list);
}

/// Every effect: all parameters at their typical size, keys as usual, then each key at either end
/// of its values.
void add_effects(const setup::Setup& setup, const effects::DataExtent& extent,
                 std::vector<Wrong>& list) {
    for (const effects::Effect& effect : effects::make_catalogue(setup, extent)) {
        std::vector<double> values = effect.zeros();
        for (std::size_t j = 0; j < values.size(); ++j)
            if (!effect.parameters[j].is_key()) values[j] = effect.parameters[j].typical;
        const auto add = [&](const std::string& name) {
            const setup::EffectSetting setting = effects::setting_of(effect, values);
            if (setting.parameters.empty()) return;
            setup::Setup alone;
            alone.effects = {setting};
            const std::string text = setup::format_setup(alone);
            const std::size_t at = text.find("[effects]\n") + 10;
            list.push_back({name, {{"[effects]", text.substr(at, text.find('\n', at) - at)}}});
        };
        add(effect.name);
        for (std::size_t j = 0; j < values.size(); ++j) {
            const effects::EffectParameter& p = effect.parameters[j];
            if (!p.is_key()) continue;
            const double usual = values[j];
            for (const bool first : {true, false}) {
                values[j] = first ? p.grid.front() : p.grid.back();
                if (values[j] != usual)
                    add(effect.name + (first ? ", least " : ", largest ") + p.name);
            }
            values[j] = usual;
        }
    }
}

/// What runs: an O number of the program folders or a text.
struct Program {
    std::string name;
    emulator::ProgramChoice choice;
    std::vector<std::string> folders;
};

struct MeasuredMachine {
    std::string file;
    std::string text;  ///< of the setup, devices without noise
    std::vector<Program> programs;
};

/// A sphere and two circles on a machine without rotary axes; the sphere cycle is the shipped one.
const char* const mill_program =
    "%\nO8950 (SPHERE AND CIRCLES)\nG90 G21 G17 G40 G49 G80 G94 G54\nG10 L2 P1 X0 Y0 Z0\nPOPEN\n"
    "DPRNT[TEMPERATURE*24]\nDPRNT[TEST*SPHERE]\nG53 G0 Z50.\nG91 G0 X-5. Y-5.\nX5. Y5.\nG90\nG0 "
    "X60. Y20.\n"
    "G0 Z-60.\nG65 P8100 D25.4 S6. H40.\nG53 G0 Z50.\nG0 W-20.\nG0 Z-40.\n"
    "G65 P8100 D25.4 S6. H40.\nG0 W0\nG53 G0 Z50.\nG0 X99.6195 Y-8.7156\nG1 Z-160. F2000\n"
    "G3 X100. Y0 I-99.6195 J8.7156 F1500\nDPRNT[SAMPLE*5]\n"
    "DPRNT[BALLBAR*ON*XY*CCW*1500]\nG3 X100. Y0 I-100. J0\nDPRNT[BALLBAR*OFF]\n"
    "G3 X99.6195 Y8.7156 I-100. J0\nG2 X100. Y0 I-99.6195 J-8.7156\n"
    "DPRNT[BALLBAR*ON*XY*CW*1500]\nG2 X100. Y0 I-100. J0\nDPRNT[BALLBAR*OFF]\n"
    "G53 G0 Z50.\nPCLOS\nM30\n%\n";

std::string without_noise(const std::string& text) {
    static const std::regex noise("(repeatability_um|noise_um) *= *[0-9.]+");
    return with_line(std::regex_replace(text, noise, ""), "[ballbar]", "sample_deg = 5");
}

setup::Setup setup_of(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "one_door.toml", notes);
}

/// Programs that ship for a machine, and those that the diagnosis would write for it.
MeasuredMachine machine_of(const std::string& file, const std::vector<int>& shipped,
                           const std::string& folder) {
    MeasuredMachine machine{file, without_noise(file_text("machines/" + file)), {}};
    std::vector<std::string> folders{root + "/programs", root + "/programs/pivot"};
    if (!folder.empty()) folders.insert(folders.begin(), root + "/programs/" + folder);
    for (const int number : shipped)
        machine.programs.push_back({"O" + std::to_string(number), number, folders});
    const setup::Setup setup = setup_of(machine.text);
    for (const diagnosis::Measurement& planned : diagnosis::ready_measurements(setup, 0.0)) {
        const auto owner = std::make_shared<std::string>(planned.program);
        machine.programs.push_back(
            {planned.name, interpreter::ProgramText{"O8900", *owner, owner}, {root + "/programs"}});
    }
    if (machine.programs.empty())
        machine.programs.push_back({"sphere and circles",
                                    interpreter::ProgramText{"O8950", mill_program, {}},
                                    {root + "/programs"}});
    return machine;
}

records::ReadingTable run_of(const setup::Setup& setup, const Program& program) {
    interpreter::ProgramFolders folders(program.folders);
    emulator::RunOptions options;
    options.effects = effects::active_models(setup);
    emulator::RunLog log = emulator::run_program(setup, folders, program.choice, options);
    INFO(program.name << ": " << (log.result.alarm ? log.result.alarm->text : ""));
    REQUIRE(log.result.status == controller::RunStatus::ok);
    return std::move(log.readings);
}

/// Largest |run - predict| over the rows, read again from the CSV that run writes.
double worst_mm(const setup::Setup& setup, const records::ReadingTable& run) {
    std::vector<std::string> notes;
    const records::ReadingTable read =
        records::parse_readings(records::format_readings(run), "r.csv", notes);
    REQUIRE(notes.empty());
    const records::ReadingTable said =
        emulator::predicted(setup, read, effects::active_models(setup));
    double worst = 0.0;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
        if (run.rows[i].device != records::Device::none)
            worst = std::max(worst, std::abs(*run.rows[i].value_mm - *said.rows[i].value_mm));
    return worst;
}

double farthest_mm(const records::ReadingTable& a, const records::ReadingTable& b) {
    if (a.rows.size() != b.rows.size()) return 1.0;
    double most = 0.0;
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        if (a.rows[i].value_mm && b.rows[i].value_mm)
            most = std::max(most, std::abs(*a.rows[i].value_mm - *b.rows[i].value_mm));
    return most;
}

/// All that may be wrong with a machine.
std::vector<Wrong> wrongs_of(const MeasuredMachine& machine, const effects::DataExtent& extent) {
    const setup::Setup setup = setup_of(machine.text);
    std::vector<Wrong> list;
    add_errors(setup.machine.chain, list);
    std::erase_if(list, [&](const Wrong& wrong) {  // the file has it already
        return machine.text.find("\n" + wrong.name) != std::string::npos;
    });
    add_keys(setup.machine.chain, list);
    add_effects(setup, extent, list);
    return list;
}

/// What the shortest program spans, so that a slip in its middle is seen.
effects::DataExtent shortest(const setup::Setup& setup,
                             const std::vector<records::ReadingTable>& tables) {
    effects::DataExtent least;
    for (const records::ReadingTable& table : tables)
        if (const auto extent = effects::extent_of(setup, table); extent.end_s < least.end_s)
            least = extent;
    return least;
}

/// Every wrong thing on the first so many programs. Returns what none of them saw.
std::set<std::string> check_door(const MeasuredMachine& machine, std::size_t programs) {
    std::map<std::string, double> seen_mm;
    std::vector<records::ReadingTable> base;
    const std::size_t count = std::min(programs, machine.programs.size());
    for (std::size_t p = 0; p < count; ++p)
        base.push_back(run_of(setup_of(machine.text), machine.programs[p]));
    for (const Wrong& wrong : wrongs_of(machine, shortest(setup_of(machine.text), base))) {
        const setup::Setup setup = setup_of(wrong.text(machine.text));
        for (std::size_t p = 0; p < count; ++p) {
            const records::ReadingTable run = run_of(setup, machine.programs[p]);
            INFO(machine.file << ", " << machine.programs[p].name << ": " << wrong.name);
            CHECK(worst_mm(setup, run) <= 1e-9);
            double& most = seen_mm[wrong.name];
            most = std::max(most, farthest_mm(run, base[p]));
        }
    }
    std::set<std::string> unseen;
    for (const auto& [name, most] : seen_mm)
        if (most < 1e-6) unseen.insert(name);
    return unseen;
}

}  // namespace

TEST_CASE("one door: every key and effect on every program of every machine", "[.assure][door]") {
    struct Case {
        const char *file, *folder;
        std::vector<int> shipped;
    };
    const auto c =
        GENERATE(Case{"bc_table.toml", "ballbar/bc", {8001, 8002, 8003, 8004, 8200, 8300}},
                 Case{"ac_trunnion.toml", "ballbar", {8200, 8300}}, Case{"head_table.toml", "", {}},
                 Case{"head_head.toml", "", {}}, Case{"mill_xy_table.toml", "", {}});
    const MeasuredMachine machine = machine_of(c.file, c.shipped, c.folder);
    std::string unseen;
    for (const std::string& name : check_door(machine, 100)) unseen += "; " + name;
    WARN(c.file << " sees no" << unseen);
}

TEST_CASE("one door: a sphere and two circles", "[door]") {
    const MeasuredMachine machine = machine_of("mill_xy_table.toml", {}, "");
    const std::set<std::string> unseen = check_door(machine, 1);
    for (const std::string& name : unseen) UNSCOPED_INFO(name);
    CHECK(unseen.size() < 36);  // nothing loads the table: no play by load
    for (const char* name : {"X backlash key", "pretravel_um", "X.cyclic", "servo.mismatch",
                             "X.reversal_spike", "probe.radius", "XY.squareness"})
        CHECK(unseen.count(name) == 0);
}

}  // namespace trunnion
