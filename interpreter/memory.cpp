#include "interpreter/memory.h"

#include "interpreter/alarms.h"

namespace trunnion::interpreter {

Memory::Memory(SystemVariables& system, bool has_98000) : system(system), has_98000(has_98000) {
    common.fill(vacant);
}

double Memory::get(int number) const {
    if (number == 0) return vacant;
    if (number >= 1 && number <= local_count) return (*locals)[static_cast<std::size_t>(number)];
    const int slot = common_slot(number, has_98000);
    if (slot >= 0) return common[static_cast<std::size_t>(slot)];
    if (number < 100) raise_language_alarm(115);
    return system.get(number);
}

void Memory::set(int number, double value, const char* comment) {
    if (number == 0) raise_language_alarm(116);
    if (number >= 1 && number <= local_count) {
        (*locals)[static_cast<std::size_t>(number)] = value;
        return;
    }
    const int slot = common_slot(number, has_98000);
    if (slot >= 0) {
        common[static_cast<std::size_t>(slot)] = value;
        return;
    }
    if (number < 100) raise_language_alarm(115);
    system.set(number, value, comment);
}

}  // namespace trunnion::interpreter
