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

inline Setup setup(const std::string& chain = "w C B b X Y Z t") {
    const std::string rotary =
        chain.find('C') == std::string::npos
            ? ""
            : "[machine.axis.B]\ndirection = [0, -1, 0]\npoint_mm = [0, 0, 0]\n"
              "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n";
    std::vector<std::string> notes;
    return parse_setup(
        "[machine]\nname = \"m\"\nchain = \"" + chain + "\"\n" + rotary +
            "[ballbar]\ncup_mm = [0, 0, -120]\nlength_mm = 100\n"
            "[[artefact]]\nname = \"P1\"\nkind = \"center_pivot\"\n"
            "center_mm = [75, 10, 110]\n"
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n",
        "s.toml", notes);
}

struct Case {
    ImportKind kind;
    std::string text;
    std::vector<std::string> told;
    std::string map;
};

inline Imported imported(const Setup& setup, const Case& c) {
    const std::vector<ImportFile> files{{"dir/f.txt", c.text}};
    ImportRequest request{setup, files, Facts(c.told), {}};
    if (!c.map.empty()) request.map = {"m.toml", c.map};
    return import_readings(c.kind, request);
}

inline ReadingTable rows(const Setup& setup, const Case& c) {
    std::vector<std::string> notes;
    ReadingTable table = parse_readings(imported(setup, c).readings, "r.csv", notes);
    CHECK(notes.empty());
    return table;
}

/// The rows that a device read.
inline std::vector<Reading> read_rows(const Setup& setup, const Case& c) {
    std::vector<Reading> list;
    for (Reading& row : rows(setup, c).rows)
        if (row.device != Device::none) list.push_back(std::move(row));
    return list;
}

inline void refuses(const Setup& setup, const Case& c, const std::string& part, int line) {
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
