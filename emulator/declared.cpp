#include "emulator/declared.h"

#include <string_view>

#include "base/alarm.h"
#include "setup/declared.h"

namespace trunnion::emulator {
namespace {

/// Calls `each(name, digest in the table, digest of the setup)`; what the setup lacks is left out:
/// the rows that name it are refused where they are read.
template <typename Table, typename Each>
void for_each_declared(const setup::Setup& setup, Table& table, Each each) {
    const std::string_view begin = records::declared_key;
    const auto digests = setup::declared_digests(setup);
    for (auto& [key, value] : table.comment) {
        if (!key.starts_with(begin)) continue;
        const auto own = digests.find(key.substr(begin.size()));
        if (own != digests.end()) each(own->first, value, own->second);
    }
}

}  // namespace

std::string declared_otherwise(const setup::Setup& setup, const records::ReadingTable& table) {
    std::string list;
    for_each_declared(setup, table, [&](auto& name, auto& told, auto& own) {
        if (told != own) list += (list.empty() ? "" : ", ") + name;
    });
    return list;
}

void refuse_declared_otherwise(const setup::Setup& setup, const records::ReadingTable& table) {
    const std::string list = declared_otherwise(setup, table);
    if (list.empty()) return;
    throw InputError("these points were imported with another declared geometry (" + list +
                         "), and their values are differences from it: import them again with "
                         "this setup",
                     {table.path, 0, 0});
}

void declare_anew(const setup::Setup& setup, records::ReadingTable& table) {
    for_each_declared(setup, table, [](auto&, auto& told, auto& own) { told = own; });
}

}  // namespace trunnion::emulator
