// What identify, diagnose, predict and import share: the readings and the setup they are given.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::cli {

/// Reads a table of readings of the setup's machine; notes go to stderr. Throws InputError with
/// path and line.
records::ReadingTable load_readings(const std::string& path, const setup::Setup& setup);
/// The same of several files, joined in the order given.
records::ReadingTable load_readings(const std::vector<std::string>& paths,
                                    const setup::Setup& setup);

/// "a, b" as a and b.
std::vector<std::string> split_names(const std::string& text);

/// Reads a setup and switches on what `inject` says. Throws InputError when `path` is empty:
/// readings are never judged against a machine that nobody named.
setup::Setup load_setup_option(const std::string& path,
                               const std::vector<std::string>& inject = {});

}  // namespace trunnion::cli
