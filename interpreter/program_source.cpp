#include "interpreter/program_source.h"

#include <charconv>

namespace trunnion::interpreter {
namespace {

std::string o_name(int number) {
    std::string digits = std::to_string(number);
    if (digits.size() < 4) digits.insert(0, 4 - digits.size(), '0');
    return "O" + digits;
}

}  // namespace

void ProgramsInMemory::add(int o_number, std::string text) {
    programs_[o_number] = std::make_shared<const std::string>(std::move(text));
}

std::optional<ProgramText> ProgramsInMemory::find(int o_number) {
    const auto it = programs_.find(o_number);
    if (it == programs_.end()) return std::nullopt;
    return ProgramText{o_name(o_number), *it->second, it->second};
}

std::optional<ProgramText> ProgramsInMemory::find(std::string_view name) {
    if (!name.empty() && (name[0] == 'O' || name[0] == 'o')) name.remove_prefix(1);
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
    return find(number);
}

}  // namespace trunnion::interpreter
