// Common parts of identify, diagnose, predict and import: readings and setup.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::cli {

/// Reads a table of readings of the setup's machine; notes are printed on stderr. Throws InputError
/// with path and line.
records::ReadingTable load_readings(const std::string& path, const setup::Setup& setup);
/// The same of a text that was read from `path`.
records::ReadingTable parse_readings(const std::string& text, const std::string& path,
                                     const setup::Setup& setup);
/// The same for several files, joined in the given order.
records::ReadingTable load_readings(const std::vector<std::string>& paths,
                                    const setup::Setup& setup);

/// Splits "a, b" into a and b.
std::vector<std::string> split_names(const std::string& text);

/// Reads a setup and adds the effects of `inject`. Throws InputError when `path` is empty: readings
/// are never evaluated with a default machine.
setup::Setup load_setup_option(const std::string& path,
                               const std::vector<std::string>& inject = {});

}  // namespace trunnion::cli
