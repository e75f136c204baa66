// Any bytes as the four files of a control's backup, cut at 0x1E: refused with a place, or read; a
// backup whose values nothing changed keeps every byte.
#include "backup/control_files.h"
#include "base/alarm.h"
#include "fuzz/target.h"

namespace {

using namespace trunnion;

void check_backup(std::string_view text) {
    backup::ControlBackup files{"f", {}, {}};
    for (const std::string& name : backup::backup_file_names) {
        const std::size_t end = text.find('\x1e');
        files.files[name] = std::string(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    const std::size_t count = backup::list_values(files).size();
    offsets::Stores stores;
    backup::apply_backup(files, stores);
    backup::ControlBackup again = files;
    backup::update_backup(again, stores);
    fuzz::law(again.files == files.files, "an unchanged value keeps its bytes");
    backup::update_backup(again, offsets::Stores());
    fuzz::law(backup::list_values(again).size() == count, "no value comes or goes");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        check_backup(fuzz::text_of(data, size));
        ++fuzz::accepted;
    } catch (const InputError&) {
    }
    return 0;
}
