// The same machine under other names: predictions, fits and verdicts do not ask what an axis is
// called.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "identification/identify.h"
#include "tests/support/renamed.h"

namespace trunnion {
namespace {

using Names = std::map<std::string, std::string>;
const Names rotary_names{{"B", "Tilt"}, {"C", "J2"}};
const Names all_names{{"B", "Tilt"}, {"C", "J2"}, {"X", "Q1"}, {"Y", "Q2"}, {"Z", "Q3"}};

/// Tables of the same readings for the machine with letters and for the one with other names.
struct Twins {
    setup::Setup letters = campaign::bc_setup(), other;
    records::ReadingTable table = campaign::empty_table(letters), other_table;

    Twins(const std::string& injection, const Names& other_names) {
        campaign::add_sphere_map(table, letters, 40, 5);
        campaign::add_ballbar(table, letters, 36);
        setup::Setup truth = campaign::with_effect(campaign::real_machine(letters), injection);
        table = campaign::measured(truth, table, 7);
        other = campaign::renamed(letters, other_names);
        other_table = campaign::renamed(table, letters, other, other_names);
    }
};

std::string other_name(std::string name) {
    for (const auto& [letter, text] : rotary_names)
        if (name.size() >= 4 && name.substr(0, 1) == "E" && name[3] == letter[0])
            return name.substr(0, 3) + text + name.substr(4);
    return name;
}

}  // namespace

TEST_CASE("predictions are those of the machine with letters", "[identification]") {
    const Twins twins("C.backlash: gap_rad=8e-5", all_names);
    const records::ReadingTable a = emulator::predicted(twins.letters, twins.table, {});
    const records::ReadingTable b = emulator::predicted(twins.other, twins.other_table, {});
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        if (a.rows[i].value_mm) REQUIRE(*a.rows[i].value_mm == *b.rows[i].value_mm);
}

TEST_CASE("fitted parameters are those of the machine with letters", "[identification]") {
    const Twins twins("C.backlash: gap_rad=8e-5", rotary_names);
    const identification::Identification a =
        identification::identify(twins.letters, twins.table, {"location", "C.backlash"});
    const identification::Identification b =
        identification::identify(twins.other, twins.other_table, {"location", "J2.backlash"});
    REQUIRE(a.parameters.size() == b.parameters.size());
    CHECK(a.rms_after_um == Approx(b.rms_after_um));
    for (const identification::FitParameter& p : a.parameters) {
        const auto same = std::find_if(b.parameters.begin(), b.parameters.end(), [&](auto& q) {
            return q.name == other_name(p.name) && q.component == p.component;
        });
        INFO(p.name);
        REQUIRE(same != b.parameters.end());
        CHECK(same->value == Approx(p.value).margin(1e-9));
        CHECK(same->sigma == Approx(p.sigma).epsilon(1e-6));
    }
    const std::string text = setup::format_setup(b.setup);
    CHECK(text.find("EX0Tilt_mm = ") != std::string::npos);
    CHECK(text.find("J2.backlash") != std::string::npos);
    std::vector<std::string> notes;
    CHECK(setup::format_setup(setup::parse_setup(text, "again.toml", notes)) == text);
}

TEST_CASE("columns carry the names, and a column of an axis that the chain lacks is refused",
          "[identification]") {
    const Twins twins("C.backlash: gap_rad=8e-5", all_names);
    const AxisNames names = twins.other.machine.chain.names();
    const std::string text = records::format_readings(twins.other_table);
    CHECK(text.find("q1_mm") != std::string::npos);
    CHECK(text.find("tilt_deg") != std::string::npos);
    std::vector<std::string> notes;
    const records::ReadingTable again = records::parse_readings(text, "r.csv", notes, names);
    CHECK(notes.empty());
    CHECK(records::format_readings(again) == text);
    for (const char* column : {"j7_deg", "x_mm", "q1_deg"}) {
        std::string bad = text;
        bad.replace(bad.find("q1_mm"), 5, column);
        try {
            records::parse_readings(bad, "r.csv", notes, names);
            FAIL(column);
        } catch (const InputError& error) {
            INFO(error.message);
            CHECK(error.message.find(std::string("column '") + column + "'") == 0);
            CHECK(error.where.column > 1);
        }
    }
}

}  // namespace trunnion
