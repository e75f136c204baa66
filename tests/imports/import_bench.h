// A setup with a probe, a target, a bar and a tracker, and imports of texts as files.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "imports/import.h"
#include "records/readings.h"

namespace import_bench {

using namespace trunnion;

inline setup::Setup setup(const std::string& chain = "w C B b X Y Z t") {
    const std::string rotary =
        chain.find('C') == std::string::npos
            ? ""
            : "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
              "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n";
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"" + chain + "\"\n" + rotary +
            "[ballbar]\ncup_mm = [0, 0, -120]\nlength_mm = 100\n"
            "[[artefact]]\nname = \"P1\"\nkind = \"center_pivot\"\n"
            "center_mm = [75, 10, 110]\n"
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n",
        "s.toml", notes);
}

struct Case {
    imports::ImportKind kind;
    std::string text;
    std::vector<std::string> told;
    std::string map;
};

inline imports::Imported imported(const setup::Setup& setup, const Case& c) {
    const std::vector<imports::ImportFile> files{{"dir/f.txt", c.text}};
    imports::ImportRequest request{setup, files, imports::Facts(c.told), {}};
    if (!c.map.empty()) request.map = {"m.toml", c.map};
    return imports::import_readings(c.kind, request);
}

inline records::ReadingTable rows(const setup::Setup& setup, const Case& c) {
    std::vector<std::string> notes;
    records::ReadingTable table =
        records::parse_readings(imported(setup, c).readings, "r.csv", notes);
    CHECK(notes.empty());
    return table;
}

/// The rows that a device read.
inline std::vector<records::Reading> read_rows(const setup::Setup& setup, const Case& c) {
    std::vector<records::Reading> list;
    for (records::Reading& row : rows(setup, c).rows)
        if (row.device != records::Device::none) list.push_back(std::move(row));
    return list;
}

inline void refuses(const setup::Setup& setup, const Case& c, const std::string& part, int line) {
    INFO(c.text);
    try {
        imported(setup, c);
        FAIL("no error, but '" + part + "' was expected");
    } catch (const InputError& error) {
        CHECK_THAT(error.message, Catch::Contains(part));
        CHECK(error.where.line == line);
    }
}

}  // namespace import_bench
