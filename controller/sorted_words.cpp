#include "controller/sorted_words.h"

#include <cmath>

#include "controller/alarms.h"

namespace trunnion::controller {

double SortedWords::axis_value(Axis axis) const {
    const char letter = letter_of(axis);
    return is_rotary(axis) ? angle_deg(letter) : length_mm(letter);
}

int SortedWords::whole(char letter) const {
    const double written = get(letter);
    const double rounded = std::round(written);
    if (std::abs(written - rounded) > 1e-6) raise_alarm(7, column_of(letter));
    if (std::abs(rounded) > 999999999.0) raise_alarm(3, column_of(letter));
    return static_cast<int>(rounded);
}

bool SortedWords::has_code(int code10) const {
    for (std::size_t i = 0; i < code_count; ++i)
        if (code[i]->code10 == code10) return true;
    return false;
}

}  // namespace trunnion::controller
