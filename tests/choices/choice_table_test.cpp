// The tables of options and stores: those of docs/control.md, and found in logs that they made.
#include "choices/choice_table.h"

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "choices/store_table.h"
#include "tests/choices/log_bench.h"

namespace trunnion {

namespace {

using Names = std::set<std::string>;

/// Switches that no log of axes shows; docs/instruments/control_log.md names them.
const Names not_offered{"3770", "3772",    "6241",        "6251",
                        "6254", "builder", "back_off_mm", "second_touch_feed"};

std::string text_of(const std::string& page) {
    std::ifstream in(std::string(TRUNNION_SOURCE_DIR) + "/docs/" + page);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// First and last cells of the rows of the table under a heading of docs/control.md.
std::vector<std::pair<std::string, std::string>> outer_cells(const std::string& heading) {
    const std::string page = text_of("control.md");
    std::istringstream lines(page.substr(page.find("\n## " + heading)));
    std::vector<std::pair<std::string, std::string>> out;
    std::string line;
    while (std::getline(lines, line) && !line.starts_with("|---")) {
    }
    while (std::getline(lines, line) && line.starts_with("| ")) {
        const std::size_t end = line.rfind(" |"), begin = line.rfind("| ", end - 1) + 2;
        out.emplace_back(line.substr(2, line.find(" | ") - 2), line.substr(begin, end - begin));
    }
    return out;
}

void add_matches(std::string text, const std::regex& wanted, Names& out) {
    for (std::smatch m; std::regex_search(text, m, wanted); text = m.suffix()) out.insert(m[1]);
}

/// "5003#0 #1": 5003#0 and 5003#1; "`[control] optional_stop = true`": optional_stop.
Names switches_in(std::string cell) {
    cell = std::regex_replace(cell, std::regex("effect `[^`]*`|alarm [0-9]+"), "");
    cell = std::regex_replace(cell, std::regex(R"((\d{4,5})(#\d) #(\d))"), "$1$2 $1#$3");
    Names out;
    add_matches(cell, std::regex(R"(\b(\d{4,5}(?:#\d)?))"), out);
    add_matches(cell, std::regex(R"(`(?:\[control[.\]] ?)?([a-z][a-z0-9_]*))"), out);
    return out;
}

const std::string table_machine = R"([machine]
name = "t"
chain = "w C B b X Y Z t"
[machine.axis.Z]
limits_mm = [-400, 300]
[machine.axis.B]
direction = [0, -1, 0]
point_mm = [0, 0, 0]
[machine.axis.C]
direction = [0, 0, -1]
point_mm = [0, 0, 0]
)";

setup::Setup mill(const std::string& keys, const std::string& parameters = "") {
    return log_bench::setup_of(
        "[machine]\nname = \"t\"\nchain = \"w b X Y Z t\"\n[control]\n" + keys +
        "[control.work_offsets]\nG54 = { X = 7.0, Y = -11.0, Z = 4.0 }\nG55 = { X = 60.0 }\n"
        "[control.parameters]\n3401 = \"00000001\"\n" +
        parameters + "[control.tools]\n1 = { length_mm = 120.0, diameter_mm = 8.0 }\n");
}

setup::Setup hurco(const std::string& keys) {
    return log_bench::setup_of(table_machine + "[control]\ndialect = \"hurco\"\n[control.hurco]\n" +
                               keys + "[control.work_offsets]\nG54 = { X = 5.0, Z = 8.0 }\n" +
                               "[control.tools]\n1 = { length_mm = 90.0 }\n");
}

/// First parts of the names of all rows: "5001#0", "hurco.tilt", "block_skip", "5440".
Names offered() {
    Names out{"nc"};  // "hurco.bnc" and "dialect=hurco-bnc"
    const auto add = [&out](std::string name) {
        if (name.starts_with("hurco.")) name.erase(0, 6);
        out.insert(name);
        out.insert(name.substr(0, name.find_first_of(".#")));
    };
    for (const choices::Choice& choice : choices::choice_table()) add(choice.key);
    for (const choices::Store& store : choices::store_table(hurco(""))) add(store.name);
    return out;
}

choices::ControlGap found(const setup::Setup& here, const setup::Setup& there,
                          const std::string& program) {
    return log_bench::gap_of(here, log_bench::log_of(there, program), program);
}

/// The setup of a gap reads back from its text and has no gap.
bool is_closed(const choices::ControlGap& gap, const setup::Setup& there,
               const std::string& program) {
    const setup::Setup again = log_bench::setup_of(setup::format_setup(gap.setup));
    return found(again, there, program).verdict == choices::GapVerdict::no_gap;
}

Names names_of(const choices::ControlGap& gap) {
    Names out;
    for (const choices::GapCause& cause : gap.causes) out.insert(cause.name);
    return out;
}

}  // namespace

TEST_CASE("every switch of docs/control.md is a row of the tables, or the docs say why not") {
    const Names rows = offered();
    const std::string page = text_of("instruments/control_log.md");
    for (const char* heading : {"Own choices", "Hurco"}) {
        const auto cells = outer_cells(heading);
        REQUIRE(cells.size() > 20);
        for (const auto& [matter, cell] : cells)
            for (const std::string& name : switches_in(cell)) {
                INFO(cell << ": " << name);
                CHECK(rows.contains(name) != not_offered.contains(name));
            }
    }
    for (const std::string& name : not_offered) CHECK_THAT(page, Catch::Contains(name));
}

TEST_CASE("the docs of logs list every own choice that has no switch") {
    const std::string page = text_of("instruments/control_log.md");
    int listed = 0;
    for (const auto& [matter, cell] : outer_cells("Own choices"))
        if (cell == "-") {
            CHECK_THAT(page, Catch::Contains(matter));
            ++listed;
        }
    CHECK(listed > 20);
}

TEST_CASE("#4012 as group 12 is found where the program restores its offset by it") {
    const std::string program =
        "N10 G90 G21 G17 G55\nN20 #110=#4012\nN30 #111=#4014\n"
        "N40 G54 G0 X[#110-30.] Y[#111-30.]\nN50 Z12.\nN60 G#110 X3. Y4.\n"
        "N70 G1 X9. Y2. F200.\nN80 M30\n";
    const setup::Setup there = mill("work_offset_is_group_12 = true\n");
    const choices::ControlGap gap = found(mill(""), there, program);
    CHECK(names_of(gap) == Names{"work_offset_is_group_12=true"});
    CHECK(is_closed(gap, there, program));
    CHECK(names_of(found(there, mill(""), program)) == Names{"work_offset_is_group_12=false"});
}

TEST_CASE("the overrun of G60 is found from none, and a stale one is fitted") {
    const std::string program =
        "N10 G90 G21 G54\nN20 G0 X4. Y3. Z30.\nN30 G60 X25. Y18.\n"
        "N40 G1 X31. F200.\nN50 G60 X12. Y6.\nN60 G1 Y9.\n"
        "N70 G60 X44. Y1.\nN80 G1 X50. Y5.\nN90 M30\n";
    const setup::Setup whole = mill("", "5440 = { X = 1.0, Y = -1.0 }\n"),
                       odd = mill("", "5440 = { X = 0.73, Y = 1.4 }\n");
    const setup::Setup small = mill("", "5440 = { X = 0.04, Y = -0.07 }\n");
    for (const setup::Setup& there : {whole, small}) {
        const choices::ControlGap from_none = found(mill(""), there, program);
        CHECK(names_of(from_none) == Names{"5440"});
        CHECK(is_closed(from_none, there, program));
    }
    const choices::ControlGap none = found(mill(""), odd, program);
    CHECK(names_of(none).contains("5440"));
    CHECK(is_closed(none, odd, program));
    const choices::ControlGap stale = found(whole, odd, program);
    CHECK(names_of(stale) == Names{"5440"});
    CHECK(is_closed(stale, odd, program));
    const choices::ControlGap all = found(mill("", "5440 = 1.0\n"), odd, program);
    CHECK(is_closed(all, odd, program));
}

TEST_CASE("centrelines of a Hurco's part set-up are found, and written as centrelines") {
    const std::string program =
        "N10 G90 G21 G17 G54\nN20 T1 M6\nN30 G0 X6. Y2. Z140.\nN40 M128\n"
        "N50 G1 X22. Y14. Z50. B25. C30. F500.\nN60 X8. Y-9. Z44. B-15. "
        "C75.\nN70 X1. Y5. Z61. B40. C-20.\nN80 M129\nN90 M30\n";
    const setup::Setup there = hurco(
        "centreline.B = { X = 0.14, Z = -0.05 }\n"
        "centreline.C = { X = 0.0, Y = 0.06 }\n");
    const choices::ControlGap gap = found(hurco(""), there, program);
    CHECK(names_of(gap) == Names{"hurco.centreline"});
    CHECK(gap.setup.centrelines.at(Axis::B)[0].value() == Approx(0.14).margin(1e-3));
    CHECK(is_closed(gap, there, program));
}

TEST_CASE("the height of M25 is found, also from none of its own") {
    const std::string program =
        "N10 G90 G21 G54\nN20 T1 M6\nN30 G0 X6. Y2. Z40.\nN40 M25\n"
        "N50 X30.\nN60 Z20.\nN70 M25\nN80 Y8.\nN90 M30\n";
    const setup::Setup there = hurco("tool_change_z_mm = 251.0\n");
    for (const char* keys : {"", "tool_change_z_mm = 240.0\n"}) {
        const choices::ControlGap gap = found(hurco(keys), there, program);
        CHECK(names_of(gap) == Names{"hurco.tool_change_z_mm"});
        CHECK(is_closed(gap, there, program));
    }
}

TEST_CASE("a control that does not refuse is found where this one stops: clamps, 3410") {
    const std::string clamped =
        "N10 G90 G21 G54 G0 X1.\nN20 M10\nN30 G1 Y5. Z8. F100.\n"
        "N40 X7.\nN50 Y9.\nN60 M30\n";
    const char* const keys = "clamps = { Z = { clamp = 10, release = 11, alarm = true } }\n";
    const char* const mute = "clamps = { Z = { clamp = 10, release = 11, alarm = false } }\n";
    CHECK(names_of(found(mill(keys), mill(mute), clamped)) == Names{"clamps.alarm=false"});
    const std::string arc =
        "N10 G90 G21 G17 G54 G0 X0. Y0.\nN20 G1 X5. F100.\n"
        "N30 G2 X15. Y0.9 I5. J0.\nN40 G1 X20.\nN50 Y9.\n"
        "N60 X3. Z8.\nN70 Y4.\nN80 X11. Z2.\nN90 M30\n";
    const Names causes = names_of(found(mill("", "3410 = 0.01\n"), mill(""), arc));
    CAPTURE(causes);
    CHECK((causes == Names{"3410=0"} || causes == Names{"3410=1"}));
}

}  // namespace trunnion
