// The interface between a command and main; each add function is in the .cpp of its command: *.cpp
#pragma once

#include <functional>
#include <string>

#include "base/exit_codes.h"

namespace CLI {
class App;
}

namespace trunnion::cli {

/// Set by the chosen command; returns the exit code (docs/formats.md).
using Run = std::function<int()>;

/// Each command adds its subcommand and options to `app` and, when chosen, sets `run`.
void add_backup(CLI::App& app, Run& run);
void add_ballbar(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_completion(CLI::App& app, Run& run);
void add_diagnose(CLI::App& app, Run& run);
void add_effects(CLI::App& app, Run& run);
void add_help(CLI::App& app, Run& run);
void add_identify(CLI::App& app, Run& run);
void add_import(CLI::App& app, Run& run);
void add_merge(CLI::App& app, Run& run);
void add_pivot(CLI::App& app, Run& run);
void add_predict(CLI::App& app, Run& run);
void add_run(CLI::App& app, Run& run);
void add_compensate(CLI::App& app, Run& run);
void add_volumetric(CLI::App& app, Run& run);

}  // namespace trunnion::cli
