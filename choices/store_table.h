// Numbers that a control keeps and that may be stale: offsets, tools, pivot, reference positions.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::choices {

/// One number: mm along X Y Z U V W, deg about A B C.
struct StoredNumber {
    std::string name;  ///< "G54.X", "H1.length", "19700"
    std::string unit;  ///< "mm" or "deg"
    std::function<double&(setup::Setup&)> in;
};

/// Numbers that are typed together.
struct Store {
    std::string name;  ///< "G54", "H1.length", "pivot"
    std::string what;  ///< "work offset G54"
    std::vector<StoredNumber> numbers;
};

/// The stores that a program on this control may use: all of G54 to G59 and the external offset,
/// G54.1 that are not zero, tools that are not zero, 5114 and 5115, reference positions, pivot.
std::vector<Store> store_table(const setup::Setup& setup);

}  // namespace trunnion::choices
