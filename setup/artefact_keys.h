// [[artefact]] and [[instrument]] of a setup file: measured objects and measuring instruments.
#pragma once

#include <set>
#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

void read_artefacts(const TomlFile& file, Setup& setup);
void read_instruments(const TomlFile& file, Setup& setup);
/// The names of a list `free = [..]`; throws InputError for a name that is not in `allowed`.
std::set<std::string> read_free(const TomlFile& file, const TomlValue& value,
                                const std::set<std::string>& allowed);

/// The inverse: as TOML text.
std::string artefact_text(const Artefact& artefact);
std::string instrument_text(const Instrument& instrument);

}  // namespace trunnion::setup
