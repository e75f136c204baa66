// Files of instruments and controls as readings (docs/readings.md); each kind has its file: *.cpp
#pragma once

#include <string>
#include <vector>

#include "imports/facts.h"
#include "setup/setup.h"

namespace trunnion::imports {

enum class ImportKind : unsigned char {
    ballbar,
    iso230_2,
    points,
    axis_log,
    table,
    dprnt,
    pointing
};

struct ImportFile {
    std::string path, text;
};

struct ImportRequest {
    const setup::Setup& setup;
    const std::vector<ImportFile>& files;
    Facts facts;
    ImportFile map;  ///< kind table: assignment of columns; empty path: none
};

struct Imported {
    std::string readings;              ///< CSV of records/readings.h
    std::vector<std::string> summary;  ///< interpretation, one line for each file and finding
    std::vector<std::string> notes;    ///< assumptions
};

/// Throws InputError (path, line, column) for anything not understood; nothing must be written
/// then.
Imported import_readings(ImportKind kind, const ImportRequest& request);

/// The tables of all files, in order.
std::vector<TextTable> tables_of(const ImportRequest& request, std::vector<std::string>& notes);

// One function for each kind, called by import_readings.
Imported import_ballbar(const ImportRequest& request);
Imported import_iso230_2(const ImportRequest& request);
Imported import_points(const ImportRequest& request);
Imported import_axis_log(const ImportRequest& request);
Imported import_table(const ImportRequest& request);
Imported import_dprnt(const ImportRequest& request);
Imported import_pointing(const ImportRequest& request);

}  // namespace trunnion::imports
