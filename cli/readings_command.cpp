#include "cli/readings_command.h"

#include "base/alarm.h"
#include "base/read_file.h"
#include "cli/files.h"
#include "effects/settings.h"

namespace trunnion {

ReadingTable load_readings(const std::string& path, const Setup& setup) {
    std::vector<std::string> notes;
    ReadingTable table =
        parse_readings(read_file_or_input(path), path, notes, setup.machine.chain.names());
    print_notes(notes);
    return table;
}

ReadingTable load_readings(const std::vector<std::string>& paths, const Setup& setup) {
    std::vector<ReadingTable> tables;
    for (const std::string& path : paths) tables.push_back(load_readings(path, setup));
    return join_readings(std::move(tables));
}

std::vector<std::string> split_names(const std::string& text) {
    std::vector<std::string> names;
    std::string name;
    for (const char c : text + ",") {
        if (c != ',') {
            if (c != ' ') name += c;
        } else if (!name.empty()) {
            names.push_back(std::exchange(name, {}));
        }
    }
    return names;
}

Setup load_setup_option(const std::string& path, const std::vector<std::string>& inject) {
    if (path.empty())
        throw InputError(
            "--setup is missing: readings belong to the machine that they were taken on");
    std::vector<std::string> notes;
    Setup setup = load_setup(path, notes);
    print_notes(notes);
    if (inject.empty()) return setup;
    const Catalogue catalogue = make_catalogue(setup);
    for (const std::string& text : inject)
        setup.effects.push_back(parse_injection(text, catalogue));
    return setup;
}

}  // namespace trunnion
