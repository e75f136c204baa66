#include "imports/import.h"

#include <set>
#include <utility>

#include "base/alarm.h"
#include "base/utf8_text.h"
#include "imports/file_tables.h"
#include "imports/plain_text.h"
#include "records/table_line.h"

namespace trunnion::imports {

std::vector<TextTable> tables_of(const ImportRequest& request, std::vector<std::string>& notes) {
    std::vector<TextTable> all;
    for (const ImportFile& file : request.files)
        for (TextTable& table :
             tables_of(file.text, file.path, request.facts.text("columns"), notes))
            all.push_back(std::move(table));
    return all;
}

namespace {

/// An error in a line of one of the files shows this line.
[[noreturn]] void fail_with_line(InputError error, const std::vector<ImportFile>& files) {
    for (const ImportFile& file : files) {
        if (file.path != error.where.program || !error.line_text.empty()) continue;
        std::string_view rest = file.text, line;
        for (int number = 0; number < error.where.line && !rest.empty(); ++number)
            line = records::take_line(rest);
        error.line_text = line;
    }
    throw InputError(error);
}

}  // namespace

Imported import_readings(ImportKind kind, const ImportRequest& request) {
    using Function = Imported (*)(const ImportRequest&);
    static constexpr Function functions[] = {import_ballbar,  import_iso230_2, import_points,
                                             import_axis_log, import_table,    import_dprnt,
                                             import_pointing};
    std::vector<ImportFile> files;
    for (const ImportFile& file : request.files)
        files.push_back({file.path, plain_text(utf8_of(file.text, file.path))});
    Imported result = [&] {
        try {
            return functions[static_cast<std::size_t>(kind)](
                {request.setup,
                 files,
                 request.facts,
                 {request.map.path, plain_text(request.map.text)}});
        } catch (const InputError& error) {
            fail_with_line(error, files);
        }
    }();
    std::set<std::string> said;
    std::erase_if(result.notes, [&](const std::string& note) { return !said.insert(note).second; });
    return result;
}

}  // namespace trunnion::imports
