// trunnion effects: the catalogue of effects used by --inject, identify and diagnose.
#include <CLI/CLI.hpp>
#include <memory>

#include "base/alarm.h"
#include "base/console.h"
#include "base/nearest.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/setups.h"
#include "effects/effect_names.h"
#include "report/effects_report.h"

namespace trunnion::cli {
namespace {

struct EffectsOptions {
    std::string name, setup;
    bool json = false;
};

/// The effect named, or all of them.
std::vector<effects::Effect> chosen_effects(const effects::Catalogue& catalogue,
                                            const std::string& name) {
    if (name.empty()) return catalogue;
    if (const effects::Effect* effect = effects::find_effect(catalogue, name)) return {*effect};
    throw InputError("no effect is named '" + name + "'" +
                     did_you_mean(name, effects::names_of(catalogue)));
}

int effects_command(const EffectsOptions& o) {
    const setup::Setup setup = open_setup(o.setup);
    const std::vector<effects::Effect> list =
        chosen_effects(effects::make_catalogue(setup), o.name);
    print_out("{}", o.json           ? report::effects_json(list, ReadRecord::files())
                    : o.name.empty() ? report::effects_text(list)
                                     : report::effect_text(list.front()));
    return exit_done;
}

}  // namespace

void add_effects(CLI::App& app, Run& run) {
    const auto o = std::make_shared<EffectsOptions>();
    CLI::App* command = app.add_subcommand(
        "effects", "list the effects of a machine: names for --inject and --effects");
    command->add_option("NAME", o->name, "show one effect with its formula and parameters");
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    command->add_flag("--json", o->json, "print the result as one JSON object");
    command->callback([o, &run] { run = [o] { return effects_command(*o); }; });
}

}  // namespace trunnion::cli
