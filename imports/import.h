// Files of measuring instruments and controls as readings (docs/readings.md, "From a machine").
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
    ImportFile map;  ///< of kind table: which column is what; empty path: none
};

struct Imported {
    std::string readings;              ///< CSV of records/readings.h
    std::vector<std::string> summary;  ///< what was understood, a line for each file and finding
    std::vector<std::string> notes;    ///< what was assumed
};

/// Throws InputError (path, line, column) for what is not understood; then nothing is to be
/// written.
Imported import_readings(ImportKind kind, const ImportRequest& request);

/// The tables of all files, one behind the other.
std::vector<TextTable> tables_of(const ImportRequest& request, std::vector<std::string>& notes);

// One function a kind; import_readings chooses.
Imported import_ballbar(const ImportRequest& request);
Imported import_iso230_2(const ImportRequest& request);
Imported import_points(const ImportRequest& request);
Imported import_axis_log(const ImportRequest& request);
Imported import_table(const ImportRequest& request);
Imported import_dprnt(const ImportRequest& request);
Imported import_pointing(const ImportRequest& request);

}  // namespace trunnion::imports
