#include "cli/help_text.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "report/paragraph.h"

namespace trunnion::cli {
namespace {

constexpr std::size_t help_columns = 80, text_column = 28;

/// Invented names represent the user's own files.
const std::map<std::string, std::vector<std::string>>& example_table() {
    static const std::map<std::string, std::vector<std::string>> table{
        {"ballbar",
         {"trunnion ballbar --setup machines/ac_trunnion.toml --svg out",
          "trunnion ballbar before.csv after.csv --setup my_machine.toml"}},
        {"backup", {"trunnion backup load stick", "trunnion backup diff stick_old stick_new"}},
        {"check",
         {"trunnion check programs", "trunnion check O1234.nc --run --format github",
          "trunnion check O1234.nc --against hurco"}},
        {"compare",
         {"trunnion compare old.nc new.nc", "trunnion compare OLD_DIR NEW_DIR --html report.html",
          "trunnion compare --suite suite.toml"}},
        {"compensate", {"trunnion compensate part.nc --setup identified.toml --out part_c.nc"}},
        {"completion", {"trunnion completion bash > /etc/bash_completion.d/trunnion"}},
        {"diagnose",
         {"trunnion diagnose readings.csv --setup my_machine.toml --html gap.html",
          "trunnion diagnose control_log.csv --program part.nc --setup my_machine.toml"}},
        {"effects", {"trunnion effects", "trunnion effects C.backlash"}},
        {"help", {"trunnion help units", "trunnion help run"}},
        {"identify",
         {"trunnion identify readings.csv --setup my_machine.toml \\",
          "    --effects location,C.backlash --out identified.toml"}},
        {"import", {"trunnion import ballbar xy_ccw.csv --setup my_machine.toml --out bar.csv"}},
        {"merge", {"trunnion merge part1.json part2.json"}},
        {"pivot",
         {"trunnion pivot --svg out/pivot",
          "trunnion pivot --setup my_machine.toml --write-programs nc",
          "trunnion pivot prints.txt --setup my_machine.toml --html pivot.html"}},
        {"predict", {"trunnion predict positions.csv --setup identified.toml"}},
        {"run",
         {"trunnion run programs/examples/bracket_g43_4.nc --trace path.csv --truth",
          "trunnion run O8002 --programs programs --readings touches.csv --json"}},
        {"volumetric", {"trunnion volumetric --setup my_machine.toml --html map.html"}}};
    return table;
}

/// Left column, then the text in its own column.
std::string entry(const std::string& left, const std::string& text) {
    std::string out = "  " + left;
    const auto lines = report::wrapped(text, help_columns - text_column);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool beside = i == 0 && out.size() + 2 <= text_column;
        if (beside)
            out.append(text_column - out.size(), ' ');
        else
            out += '\n' + std::string(text_column, ' ');
        out += lines[i];
    }
    return out + '\n';
}

class HelpForm : public CLI::Formatter {
  public:
    std::string make_option(const CLI::Option* option, bool) const override {
        return entry(option_words(*option), option->get_description());
    }
    std::string make_subcommand(const CLI::App* command) const override {
        return entry(command->get_name(), command->get_description());
    }
    std::string make_description(const CLI::App* app) const override {
        std::string out;
        for (const std::string& line : report::wrapped(app->get_description(), help_columns))
            out += line + '\n';
        return out;
    }
    std::string make_usage(const CLI::App* app, std::string name) const override {
        std::string out = "Usage: " + name;
        for (const CLI::Option* option : app->get_options()) {
            if (!option->get_positional()) continue;
            const std::string more = option->get_expected_max() > 1 ? "..." : "";
            const std::string word = option->get_name() + more;
            out += option->get_required() ? ' ' + word : " [" + word + ']';
        }
        if (!app->get_subcommands({}).empty()) out += " COMMAND";
        return out + " [OPTIONS]\n";
    }
};

}  // namespace

std::string value_word(const CLI::Option& option) {
    if (option.get_expected_max() == 0 || option.get_type_size() == 0) return {};
    const std::string type = option.get_type_name();
    if (type.starts_with("FILE") || type.starts_with("OUT")) return "FILE";
    if (type.starts_with("UINT") || type.starts_with("INT")) return "N";
    if (type.starts_with("FLOAT")) return "NUMBER";
    return "TEXT";
}

std::string option_words(const CLI::Option& option) {
    if (option.get_positional()) return option.get_name();
    std::string out = option.get_name(false, true);
    for (std::size_t at = 0; (at = out.find(',', at)) != std::string::npos; at += 2)
        out.insert(at + 1, " ");
    const std::string value = value_word(option);
    return value.empty() ? out : out + ' ' + value;
}

std::vector<std::string> examples_of(const std::string& command) {
    const auto at = example_table().find(command);
    return at == example_table().end() ? std::vector<std::string>{} : at->second;
}

void set_help(CLI::App& app) {
    app.formatter(std::make_shared<HelpForm>());
    const auto examples = examples_of(app.get_name());
    if (!examples.empty()) {
        std::string footer = examples.size() > 1 ? "Examples:" : "Example:";
        for (const std::string& line : examples) footer += "\n  " + line;
        app.footer(footer);
    }
    for (CLI::App* command : app.get_subcommands({})) set_help(*command);
}

}  // namespace trunnion::cli
