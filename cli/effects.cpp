// trunnion effects: what a machine may have: the catalogue that --inject, identify and diagnose
// share.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/alarm.h"
#include "base/console.h"
#include "base/nearest.h"
#include "cli/command.h"
#include "cli/help_text.h"
#include "cli/options.h"
#include "cli/setups.h"
#include "effects/effect_names.h"

namespace trunnion::cli {
namespace {

struct Options {
    std::string name, setup;
    bool json = false;
};

std::string parameter_name(const effects::EffectParameter& p) {
    return p.component < 0 ? p.name : fmt::format("{}[{}]", p.name, "xyz"[p.component]);
}

/// The effect named, or all of them.
std::vector<effects::Effect> chosen(const effects::Catalogue& catalogue, const std::string& name) {
    if (name.empty()) return catalogue;
    if (const effects::Effect* effect = effects::find_effect(catalogue, name)) return {*effect};
    throw InputError("no effect is named '" + name + "'" +
                     did_you_mean(name, effects::names_of(catalogue)));
}

nlohmann::ordered_json json_of(const std::vector<effects::Effect>& list) {
    nlohmann::ordered_json json{{"schema", "trunnion.effects/1"},
                                {"effects", nlohmann::ordered_json::array()}};
    for (const effects::Effect& effect : list) {
        nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
        for (const effects::EffectParameter& p : effect.parameters)
            parameters.push_back(
                {{"name", parameter_name(p)}, {"unit", p.unit}, {"typical", p.typical}});
        json["effects"].push_back({{"name", effect.name},
                                   {"what", effect.what},
                                   {"cause", effect.cause},
                                   {"remedy", effect.remedy},
                                   {"formula", effect.formula},
                                   {"parameters", parameters}});
    }
    return json;
}

void print_paragraph(const std::string& head, const std::string& text) {
    constexpr std::size_t column = 10, width = 70;
    const auto lines = wrapped(text, width);
    for (std::size_t i = 0; i < lines.size(); ++i)
        print_out("{:<{}}{}\n", i == 0 ? head : "", column, lines[i]);
}

void print_effect(const effects::Effect& effect) {
    print_out("{}\n", effect.name);
    print_paragraph("what", effect.what);
    print_paragraph("cause", effect.cause);
    print_paragraph("remedy", effect.remedy);
    print_paragraph("formula", effect.formula);
    for (const effects::EffectParameter& p : effect.parameters)
        print_out("          {:<24} {:<8} typical {:.3g}\n", parameter_name(p), p.unit, p.typical);
    if (!effect.parameters.empty())
        print_out("example   --inject '{}: {}={:.3g}'\n", effect.name,
                  effect.parameters.front().name, effect.parameters.front().typical);
}

int effects_command(const Options& o) {
    const setup::Setup setup = open_setup(o.setup);
    const std::vector<effects::Effect> list = chosen(effects::make_catalogue(setup), o.name);
    if (o.json) {
        print_out("{}\n", json_of(list).dump(2));
        return exit_done;
    }
    if (!o.name.empty()) {
        print_effect(list.front());
        return exit_done;
    }
    for (const effects::Effect& effect : list) {
        const auto lines = wrapped(effect.what, 57);
        for (std::size_t i = 0; i < lines.size(); ++i)
            print_out("{:<22} {}\n", i == 0 ? effect.name : "", lines[i]);
    }
    return exit_done;
}

}  // namespace

void add_effects(CLI::App& app, Run& run) {
    const auto o = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("effects", "what a machine may have: names for --inject and --effects");
    command->add_option("NAME", o->name, "one effect, with its formula and parameters");
    reads_file(command->add_option("--setup", o->setup, "setup file (machines/bc_table.toml)"));
    command->add_flag("--json", o->json, "one JSON object on stdout");
    command->callback([o, &run] { run = [o] { return effects_command(*o); }; });
}

}  // namespace trunnion::cli
