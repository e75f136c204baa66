// Numbers stored in a control that may be stale: offsets, tools, pivot, reference positions.
#pragma once

#include <functional>
#include <limits>
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
    double least = -std::numeric_limits<double>::infinity();  ///< of a way: 0
};

/// Numbers that are entered together.
struct Store {
    std::string name;  ///< "G54", "H1.length", "pivot"
    std::string what;  ///< "work offset G54"
    std::vector<StoredNumber> numbers;
};

/// The stores that a program on this control may use: all of G54 to G59 and the external offset,
/// non-zero G54.1, tools that are non-zero or whose number is `called`, 5114, 5115, 5440, reference
/// positions, pivot (of a Hurco the centrelines and the height of M25).
std::vector<Store> store_table(const setup::Setup& setup, const std::set<int>& called = {});

bool is_hurco(const setup::Setup& setup);
/// The axis's own value of a parameter, for writing; the other axes keep theirs.
double& axis_value(setup::Setup& setup, int parameter, Axis axis);

}  // namespace trunnion::choices
