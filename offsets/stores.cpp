#include "offsets/stores.h"

#include "offsets/whole_parameter.h"

namespace trunnion::offsets {

std::optional<double> Parameters::find(int number) const {
    const auto it = entry.find(number);
    if (it == entry.end()) return std::nullopt;
    return it->second.value;
}

double Parameters::get(int number, double otherwise) const {
    return find(number).value_or(otherwise);
}

bool Parameters::bit(int number, int index) const {
    return (bits_of_parameter(get(number)) >> static_cast<unsigned>(index) & 1U) != 0;
}

void Parameters::set(int number, double value) {
    entry[number].value = value;
}

void Parameters::set_bit(int number, int index, bool on) {
    const unsigned mask = 1U << static_cast<unsigned>(index);
    const unsigned byte = bits_of_parameter(get(number));
    set(number, on ? (byte | mask) : (byte & ~mask));
}

}  // namespace trunnion::offsets
