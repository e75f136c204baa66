// trunnion backup load|save|diff: a real control's backup files.
#include <CLI/CLI.hpp>

#include "backup/control_files.h"
#include "base/console.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/setups.h"

namespace trunnion::cli {

namespace {

int load(const std::string& folder) {
    const backup::ControlBackup backup = backup::read_backup(folder);
    offsets::Stores stores;
    backup::apply_backup(backup, stores);
    for (const backup::BackupValue& v : backup::list_values(backup))
        print_out("{}\t{}\t{}\n", v.file, v.name, v.text);
    return exit_done;
}

int save(const std::string& from, const std::string& to, const std::string& setup_path) {
    backup::ControlBackup backup = backup::read_backup(from);
    backup::update_backup(backup, open_setup(setup_path).stores);
    backup::write_backup(backup, to);
    return exit_done;
}

int diff(const std::string& a, const std::string& b) {
    const auto differences = backup::diff_backups(backup::read_backup(a), backup::read_backup(b));
    for (const backup::BackupDifference& d : differences)
        print_out("{}\t{}\t{}\t{}\n", d.file, d.name, d.a.empty() ? "-" : d.a,
                  d.b.empty() ? "-" : d.b);
    return differences.empty() ? exit_done : exit_differs;
}

}  // namespace

void add_backup(CLI::App& app, Run& run) {
    struct Options {
        std::string a, b, setup;
    };
    const auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("backup", "a real control's backup files");
    command->require_subcommand(1);

    CLI::App* load_word = command->add_subcommand("load", "list every value of a backup folder");
    reads_file(load_word->add_option("FOLDER", o->a, "backup folder"))->required();
    load_word->callback([o, &run] { run = [o] { return load(o->a); }; });

    CLI::App* save_word = command->add_subcommand(
        "save", "write the backup FOLDER to OUT with the values of a setup's control in it");
    reads_file(save_word->add_option("FOLDER", o->a, "backup folder whose form is kept"))
        ->required();
    writes_file(save_word->add_option("OUT", o->b, "folder to write"))->required();
    reads_file(save_word->add_option("--setup", o->setup, "setup file"))->required();
    save_word->callback([o, &run] { run = [o] { return save(o->a, o->b, o->setup); }; });

    CLI::App* diff_word =
        command->add_subcommand("diff", "values that differ between two backup folders");
    reads_file(diff_word->add_option("A", o->a, "backup folder"))->required();
    reads_file(diff_word->add_option("B", o->b, "backup folder"))->required();
    diff_word->callback([o, &run] { run = [o] { return diff(o->a, o->b); }; });
}

}  // namespace trunnion::cli
