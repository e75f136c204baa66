// trunnion backup load|save|diff: a real control's backup files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "backup/control_files.h"
#include "backup/differences.h"
#include "backup/folder_files.h"
#include "backup/parameter_names.h"
#include "backup/value_text.h"
#include "base/alarm.h"
#include "base/console.h"
#include "base/output_files.h"
#include "base/read_file.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/setups.h"
#include "setup/control_machine.h"
#include "setup/control_pivot.h"

namespace trunnion::cli {

namespace {

struct BackupCommand {
    std::string a, b, setup, setup_out;
    bool pivot = false;
    std::vector<double> measured_mm;
};

std::string line_of_file(const std::string& name, const std::string& bytes) {
    return fmt::format("{}\t\t{} bytes\t{}\t{}\n", name, bytes.size(),
                       backup::text_of(backup::standing_of_file(name)),
                       backup::kind_of_file(name, bytes));
}

std::string values_text(const backup::ControlBackup& backup) {
    std::string text;
    std::vector<backup::BackupValue> values = backup::list_values(backup);
    backup::name_axes(values);
    for (const backup::BackupValue& v : values) {
        const bool parameter = v.kind == backup::BackupValue::Kind::parameter;
        text += fmt::format("{}\t{}\t{}\t{}\t{}\n", v.file, v.name, v.text,
                            backup::text_of(backup::standing_of_value(v)),
                            parameter ? backup::name_of_parameter(v.number) : "");
    }
    for (const auto& [name, bytes] : backup.files) text += line_of_file(name, bytes);
    for (const std::string& name : backup::other_files(backup))
        text += line_of_file(name, read_file(backup.folder + "/" + name));
    return text;
}

/// Without G54 its zeros would be compared.
void require_g54(const backup::ControlBackup& backup, const std::string& path) {
    for (const backup::BackupValue& v : backup::list_values(backup))
        if (v.kind == backup::BackupValue::Kind::work_offset && v.name.starts_with("G54") &&
            !v.name.starts_with("G54.1"))
            return;
    throw InputError("this backup has no G54 (EXT_WKZ.TXT) to compare 19700-19705 with", {path});
}

int load(const BackupCommand& c) {
    const backup::ControlBackup backup = backup::read_backup(c.a);
    offsets::Stores stores;
    backup::apply_backup(backup, stores);
    OutputFiles out;
    if (!c.setup_out.empty())
        out.add(c.setup_out, setup::format_setup(setup::setup_of_control(stores, c.a)));
    if (!c.pivot) {
        out.add("-", values_text(backup));
        out.write();
        return exit_done;
    }
    require_g54(backup, c.a);
    std::optional<Vector3> measured_mm;
    if (!c.measured_mm.empty())
        measured_mm = Vector3(c.measured_mm[0], c.measured_mm[1], c.measured_mm[2]);
    const setup::PivotAgreement agreement = setup::compare_pivots(stores, measured_mm, c.a);
    out.add("-", setup::text_of(agreement) + '\n');
    out.write();
    return agreement.agrees() ? exit_done : exit_differs;
}

int save(const std::string& from, const std::string& to, const std::string& setup_path) {
    backup::ControlBackup backup = backup::read_backup(from);
    const auto changed = backup::update_backup(backup, open_setup(setup_path).stores);
    OutputFiles out;
    backup::add_backup_files(backup, to, out);
    std::string list, notes;
    for (const auto& [name, bytes] : backup.files) {
        const auto count = changed.find(name);
        list += fmt::format(
            "{}\t{}\t{}\n", name, backup::kind_of_file(name, bytes),
            count == changed.end() ? "unchanged" : fmt::format("{} values changed", count->second));
    }
    for (const std::string& name : backup::other_files(backup)) {
        const std::string kind = backup::kind_of_file(name, read_file(backup.folder + "/" + name));
        list += fmt::format("{}\t{}\tcopied\n", name, kind);
        if (kind == "binary" && !changed.empty())
            notes += fmt::format(
                "note: {} is copied as it is: an image of a memory in it still holds the "
                "old values\n",
                name);
    }
    out.add("-", list);
    out.write();
    print_error("{}", notes);
    return exit_done;
}

int diff(const std::string& a, const std::string& b) {
    const auto differences = backup::diff_backups(backup::read_backup(a), backup::read_backup(b));
    for (const backup::BackupDifference& d : differences)
        print_out("{}\t{}\t{}\t{}\t{}\n", d.file, d.name, d.a.empty() ? "-" : d.a,
                  d.b.empty() ? "-" : d.b, d.meaning);
    return differences.empty() ? exit_done : exit_differs;
}

}  // namespace

void add_backup(CLI::App& app, Run& run) {
    const auto o = std::make_shared<BackupCommand>();
    CLI::App* command =
        app.add_subcommand("backup", "read, write or compare the backup files of a real control");
    command->require_subcommand(1);

    CLI::App* load_word = command->add_subcommand(
        "load", "list every value of a backup folder: file, name, text, use");
    reads_file(load_word->add_option("FOLDER", o->a, "backup folder"))->required();
    writes_file(load_word->add_option("--setup-out", o->setup_out,
                                      "write a setup of the machine that the backup describes"));
    CLI::Option* pivot = load_word->add_flag(
        "--pivot", o->pivot,
        "print one line: do G54 and parameters 19700 to 19705 give the same pivot?");
    load_word
        ->add_option("--measured", o->measured_mm,
                     "measured pivot X Y Z in machine coordinates, mm")
        ->expected(3)
        ->needs(pivot);
    load_word->callback([o, &run] { run = [o] { return load(*o); }; });

    CLI::App* save_word = command->add_subcommand(
        "save", "write the backup FOLDER to OUT with the values of a setup");
    reads_file(save_word->add_option("FOLDER", o->a, "backup folder that gives the format"))
        ->required();
    writes_folder(save_word->add_option("OUT", o->b, "folder to write"))->required();
    reads_file(save_word->add_option("--setup", o->setup, "setup file"))->required();
    save_word->callback([o, &run] { run = [o] { return save(o->a, o->b, o->setup); }; });

    CLI::App* diff_word = command->add_subcommand(
        "diff", "list the values and programs that differ between two folders");
    reads_file(diff_word->add_option("A", o->a, "backup folder"))->required();
    reads_file(diff_word->add_option("B", o->b, "backup folder"))->required();
    diff_word->callback([o, &run] { run = [o] { return diff(o->a, o->b); }; });
}

}  // namespace trunnion::cli
