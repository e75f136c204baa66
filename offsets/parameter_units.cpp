#include "offsets/parameter_units.h"

#include "base/units.h"

namespace trunnion::offsets {

double parameter_unit_mm(const Parameters& parameters, int number) {
    const bool length = number == 19666 || (number >= 19700 && number <= 19705) ||
                        (number >= 19709 && number <= 19714);
    return length && parameters.bit(1001, 0) ? mm_from_inch(1.0) : 1.0;
}

}  // namespace trunnion::offsets
