// One door: what a run reads is what predict reads from the rows that the run wrote, for every key
// of a setup and every effect of the catalogue, on every program that measures.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "emulator/replay.h"
#include "tests/support/measured_machines.h"

namespace trunnion {
namespace {

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
        const std::string curve =
            axis.rotary ? "backlash_rad = { constant = 2e-5, harmonics = [[2, 4e-5, 1e-5]] }"
                        : "backlash_mm = { at_mm = [-300, 0, 40, 300], value = [0.004, 0.01, 0, "
                          "0.006] }";
        list.push_back({of + " backlash over the place", {{section, curve}}});
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

/// A shipped machine whose devices read without noise.
struct QuietMachine {
    const measured::Shipped& shipped;
    std::string text;
    setup::Setup setup;
    std::vector<measured::Program> programs;
    explicit QuietMachine(const measured::Shipped& of)
        : shipped(of),
          text(without_noise(measured::setup_text(of))),
          setup(measured::setup_of(text)),
          programs(measured::programs_of(of, setup)) {}

  private:
    static std::string without_noise(const std::string& text) {
        static const std::regex noise("(repeatability_um|noise_um) *= *[0-9.]+");
        return with_line(std::regex_replace(text, noise, ""), "[ballbar]", "sample_deg = 5");
    }
};

/// Run - predict of every row that a device read, by the CSV that run writes and predict reads.
std::vector<double> beyond_prediction_mm(const setup::Setup& setup,
                                         const records::ReadingTable& run) {
    std::vector<std::string> notes;
    const records::ReadingTable read =
        records::parse_readings(records::format_readings(run), "r.csv", notes);
    REQUIRE(notes.empty());
    const records::ReadingTable said =
        emulator::predicted(setup, read, effects::active_models(setup));
    std::vector<double> beyond;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
        if (run.rows[i].device != records::Device::none)
            beyond.push_back(*run.rows[i].value_mm - *said.rows[i].value_mm);
    return beyond;
}

double largest(const std::vector<double>& values_mm) {
    double most = 0.0;
    for (const double v : values_mm) most = std::max(most, std::abs(v));
    return most;
}

/// A run of the machine as it should be, and the noise in it: a laser is never without.
struct QuietRun {
    records::ReadingTable table;
    std::vector<double> noise_mm;
    QuietRun(const setup::Setup& setup, const measured::Program& program)
        : table(measured::run_of(setup, program)), noise_mm(beyond_prediction_mm(setup, table)) {
        std::size_t at = 0;
        for (const records::Reading& row : table.rows) {
            if (row.device == records::Device::none) continue;
            if (row.device != records::Device::linear) REQUIRE(std::abs(noise_mm[at]) <= 1e-9);
            ++at;
        }
    }
};

/// Largest |run - predict - noise|. Only a laser has noise: the same one in both runs, whose seed
/// is the same. A bar has fewer readings where long chords of a circle leave its range.
double worst_mm(const setup::Setup& setup, const records::ReadingTable& run,
                const QuietRun& quiet) {
    const bool noisy = largest(quiet.noise_mm) > 1e-9;
    std::vector<double> beyond = beyond_prediction_mm(setup, run);
    REQUIRE(!beyond.empty());
    if (noisy) REQUIRE(beyond.size() == quiet.noise_mm.size());
    for (std::size_t k = 0; noisy && k < beyond.size(); ++k) beyond[k] -= quiet.noise_mm[k];
    return largest(beyond);
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
std::vector<Wrong> wrongs_of(const QuietMachine& machine, const effects::DataExtent& extent) {
    std::vector<Wrong> list;
    add_errors(machine.setup.machine.chain, list);
    std::erase_if(list, [&](const Wrong& wrong) {  // the file has it already
        return machine.text.find("\n" + wrong.name) != std::string::npos;
    });
    add_keys(machine.setup.machine.chain, list);
    add_effects(machine.setup, extent, list);
    return list;
}

/// What the shortest program spans, so that a slip in its middle is seen.
effects::DataExtent shortest(const setup::Setup& setup, const std::vector<QuietRun>& runs) {
    effects::DataExtent least;
    for (const QuietRun& run : runs)
        if (const auto extent = effects::extent_of(setup, run.table); extent.end_s < least.end_s)
            least = extent;
    return least;
}

/// Every wrong thing on the first so many programs. Returns the most (mm) that any of them saw of
/// each.
std::map<std::string, double> check_door(const QuietMachine& machine, std::size_t programs) {
    std::map<std::string, double> seen_mm;
    std::vector<QuietRun> base;
    const std::size_t count = std::min(programs, machine.programs.size());
    for (std::size_t p = 0; p < count; ++p) base.emplace_back(machine.setup, machine.programs[p]);
    for (const Wrong& wrong : wrongs_of(machine, shortest(machine.setup, base))) {
        const setup::Setup setup = measured::setup_of(wrong.text(machine.text));
        for (std::size_t p = 0; p < count; ++p) {
            const records::ReadingTable run = measured::run_of(setup, machine.programs[p]);
            INFO(machine.shipped.file << ", " << machine.programs[p].name << ": " << wrong.name);
            CHECK(worst_mm(setup, run, base[p]) <= 1e-9);
            double& most = seen_mm[wrong.name];
            most = std::max(most, farthest_mm(run, base[p].table));
        }
    }
    return seen_mm;
}

/// An effect of the catalogue that no program of its machine sees, and why.
struct Unseen {
    const char *machine, *name, *why;
};
constexpr double seen_from_mm = 1e-6;

std::set<std::string> unseen_by(const std::string& machine) {
    static const char* const free = "every artefact of the file is free";
    static const char* const gain = "probe and ballbar have no gain";
    static const char* const clamp = "no rotary axis carries the work";
    static const char* const store = "no program goes to a place that comes from a store";
    static const std::vector<Unseen> list{
        {"bc_table.toml", "artefact.position", free},
        {"bc_table.toml", "sensor.gain", gain},
        {"ac_trunnion.toml", "artefact.position", free},
        {"ac_trunnion.toml", "sensor.gain", gain},
        {"head_table.toml", "artefact.position", free},
        {"head_table.toml", "sensor.gain", gain},
        {"head_table.toml", "pivot.g54", store},
        {"head_table.toml", "pivot.p1970x", store},
        {"head_head.toml", "artefact.position", free},
        {"head_head.toml", "sensor.gain", gain},
        {"head_head.toml", "clamp.shift", clamp},
        {"mill_xy_table.toml", "artefact.position", free},
        {"mill_xy_table.toml", "clamp.shift", clamp},
        {"mill_xy_table.toml", "location", "no rotary axis"},
        {"mill_xy_table.toml", "W.reversal_spike", "no circle moves the quill"},
    };
    std::set<std::string> names;
    for (const Unseen& unseen : list)
        if (machine == unseen.machine) names.insert(unseen.name);
    return names;
}

/// Readings of every program: planned rows as the diagnosis plans them, the others are run.
std::vector<records::ReadingTable> tables_of(const QuietMachine& machine) {
    std::vector<records::ReadingTable> tables;
    for (diagnosis::Measurement& planned : diagnosis::ready_measurements(machine.setup, 0.0))
        tables.push_back(std::move(planned.table));
    const std::size_t planned = tables.size();
    for (std::size_t p = 0; p + planned < machine.programs.size(); ++p)
        tables.push_back(measured::run_of(machine.setup, machine.programs[p]));
    return tables;
}

/// With its usual keys, or with one key at any value of its grid.
bool sees(const setup::Setup& setup, const records::ReadingTable& table, const std::string& name) {
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    const effects::Effect& effect = *effects::find_effect(catalogue, name);
    std::vector<double> usual = effect.zeros();
    for (std::size_t j = 0; j < usual.size(); ++j)
        if (!effect.parameters[j].is_key()) usual[j] = effect.parameters[j].typical;
    const records::ReadingTable without = emulator::predicted(setup, table, {});
    const auto shows = [&](const std::vector<double>& values) {
        const auto model = effects::make_model(effect, values);
        return farthest_mm(without, emulator::predicted(setup, table, {model})) > seen_from_mm;
    };
    if (shows(usual)) return true;
    for (std::size_t j = 0; j < usual.size(); ++j)
        for (const double key : effect.parameters[j].grid) {
            std::vector<double> values = usual;
            values[j] = key;
            if (shows(values)) return true;
        }
    return false;
}

}  // namespace

TEST_CASE("one door: every key and effect on every program of every machine", "[.assure][door]") {
    const QuietMachine machine(
        measured::shipped_machines()[static_cast<std::size_t>(GENERATE(range(0, 5)))]);
    std::string unseen;
    for (const auto& [name, most_mm] : check_door(machine, 100))
        if (most_mm < seen_from_mm) unseen += "; " + name;
    WARN(machine.shipped.file << " sees no" << unseen);
}

TEST_CASE("one door: a sphere, a laser and circles of a mill", "[door]") {
    check_door(QuietMachine(measured::shipped_machines().back()), 1);
}

TEST_CASE("every effect of the catalogue is seen by some program of its machine", "[door]") {
    for (const measured::Shipped& shipped : measured::shipped_machines()) {
        const QuietMachine machine(shipped);
        const std::vector<records::ReadingTable> tables = tables_of(machine);
        std::set<std::string> unseen;
        for (const effects::Effect& effect : effects::make_catalogue(machine.setup))
            if (std::none_of(tables.begin(), tables.end(), [&](const records::ReadingTable& table) {
                    return sees(machine.setup, table, effect.name);
                }))
                unseen.insert(effect.name);
        INFO(shipped.file);
        CHECK(unseen == unseen_by(shipped.file));
    }
}

}  // namespace trunnion
