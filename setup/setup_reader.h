// Reads parts of a setup file; internal to setup.cpp. The parts are the files setup_*.cpp.
#pragma once

#include <string>
#include <vector>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

void read_machine(const TomlFile& file, const TomlValue& machine, Setup& setup);
/// A parameter of an effect that a key of another name sets: backlash, pretravel.
struct EffectKey {
    std::string effect, parameter;
    double value;
};
/// Throws InputError at `place` when [effects] gives the effect, too.
void add_effect_key(const TomlFile& file, const TomlValue& place, const EffectKey& key,
                    Setup& setup);
void read_machine_errors(const TomlFile& file, const TomlValue& errors, Setup& setup);
void read_control(const TomlFile& file, const TomlValue& control, const BackupReader& backup,
                  Setup& setup);
/// [probe], [ballbar], [[artefact]], [model], [effects].
void read_devices(const TomlFile& file, Setup& setup);

}  // namespace trunnion::setup
