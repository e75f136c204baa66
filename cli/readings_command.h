// What identify, diagnose and predict share: the readings and the setup they are given.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"
#include "records/readings.h"

namespace trunnion {

/// Reads a table of readings; notes go to stderr. Throws InputError with path and line.
ReadingTable load_readings(const std::string& path);
/// The same of several files, joined in the order given.
ReadingTable load_readings(const std::vector<std::string>& paths);

/// Reads a setup, machines/bc_table.toml when `path` is empty, and switches on what `inject` says.
Setup load_setup_option(const std::string& path, const std::vector<std::string>& inject = {});

}  // namespace trunnion
