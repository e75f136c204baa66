// Parameters of a machine whose two rotary axes carry the table, as tests of the control set them.
#pragma once

#include <utility>

#include "offsets/stores.h"

namespace trunnion::testing {

/// 19680 = 12, two rotary axes in the table: axis 4 turns about direction `first` (19682: 1 = X,
/// 2 = Y), axis 5 about Z and stands on it.
inline void set_two_table_axes(offsets::Parameters& parameters, int first) {
    for (const auto& [number, value] : {std::pair(19680, 12),
                                        {19681, 4},
                                        {19682, first},
                                        {19684, 1},
                                        {19686, 5},
                                        {19687, 3},
                                        {19689, 1}})
        parameters.set(number, value);
}

}  // namespace trunnion::testing
