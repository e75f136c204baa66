#include "imports/import.h"

#include <cstdint>
#include <set>
#include <utility>

#include "base/alarm.h"
#include "imports/file_tables.h"

namespace trunnion::imports {
namespace {

void append_utf8(std::uint32_t code, std::string& out) {
    const auto tail = [&](unsigned shift) {
        out += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
    };
    if (code < 0x80U) {
        out += static_cast<char>(code);
    } else if (code < 0x800U) {
        out += static_cast<char>(0xC0U | (code >> 6U));
        tail(0);
    } else {
        out += static_cast<char>(0xE0U | (code >> 12U));
        tail(6);
        tail(0);
    }
}

/// The text as UTF-8, converted from UTF-16 (as saved by spreadsheets) if its byte order mark says
/// so.
std::string utf8_of(const ImportFile& file) {
    const bool little = file.text.starts_with("\xFF\xFE"), big = file.text.starts_with("\xFE\xFF");
    if (!little && !big) return file.text;
    if (file.text.size() % 2 != 0)
        throw InputError("text in UTF-16 that ends within a character", {file.path, 1, 1});
    std::string out;
    for (std::size_t k = 2; k < file.text.size(); k += 2) {
        const auto first = static_cast<unsigned char>(file.text[k]);
        const auto second = static_cast<unsigned char>(file.text[k + 1]);
        append_utf8(little ? first + 256U * second : 256U * first + second, out);
    }
    return out;
}

}  // namespace

std::vector<TextTable> tables_of(const ImportRequest& request, std::vector<std::string>& notes) {
    std::vector<TextTable> all;
    for (const ImportFile& file : request.files)
        for (TextTable& table :
             tables_of(file.text, file.path, request.facts.text("columns"), notes))
            all.push_back(std::move(table));
    return all;
}

Imported import_readings(ImportKind kind, const ImportRequest& request) {
    using Function = Imported (*)(const ImportRequest&);
    static constexpr Function functions[] = {import_ballbar,  import_iso230_2, import_points,
                                             import_axis_log, import_table,    import_dprnt,
                                             import_pointing};
    std::vector<ImportFile> files;
    for (const ImportFile& file : request.files) files.push_back({file.path, utf8_of(file)});
    Imported result = functions[static_cast<std::size_t>(kind)](
        {request.setup, files, request.facts, request.map});
    std::set<std::string> said;
    std::erase_if(result.notes, [&](const std::string& note) { return !said.insert(note).second; });
    return result;
}

}  // namespace trunnion::imports
