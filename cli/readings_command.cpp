#include "cli/readings_command.h"

#include "base/alarm.h"
#include "base/read_file.h"
#include "cli/notes.h"
#include "cli/setups.h"
#include "effects/settings.h"

namespace trunnion::cli {

records::ReadingTable parse_readings(const std::string& text, const std::string& path,
                                     const setup::Setup& setup) {
    std::vector<std::string> notes;
    records::ReadingTable table =
        records::parse_readings(text, path, notes, setup.machine.chain.names());
    print_notes(notes);
    return table;
}

records::ReadingTable load_readings(const std::string& path, const setup::Setup& setup) {
    return parse_readings(read_file_or_input(path), path, setup);
}

records::ReadingTable load_readings(const std::vector<std::string>& paths,
                                    const setup::Setup& setup) {
    std::vector<records::ReadingTable> tables;
    for (const std::string& path : paths) tables.push_back(load_readings(path, setup));
    return records::join_readings(std::move(tables));
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

setup::Setup load_setup_option(const std::string& path, const std::vector<std::string>& inject) {
    if (path.empty())
        throw InputError(
            "--setup is missing: readings must be evaluated with the machine that they come from");
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(path, notes);
    tell_setup(setup, notes);
    if (inject.empty()) return setup;
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    for (const std::string& text : inject)
        setup.effects.push_back(effects::parse_injection(text, catalogue));
    return setup;
}

}  // namespace trunnion::cli
