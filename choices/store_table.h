// Numbers stored in a control that may be stale: offsets, tools, pivot, reference positions.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "choices/program_stores.h"
#include "setup/setup.h"

namespace trunnion::choices {

/// One number: mm along X Y Z U V W, deg about A B C.
struct StoredNumber {
    std::string name;  ///< "G54.X", "H1.length", "19700", "#500"
    std::string unit;  ///< "mm" or "deg"; empty: what the program makes of it
    std::function<double&(setup::Setup&)> in;
    double least = -std::numeric_limits<double>::infinity();  ///< of a way: 0
    int variable = 0;  ///< number of a common variable; 0: none
};

/// A common variable without a value: a word with it is left out, so that no derivative leads from
/// there to a value.
bool is_vacant(const setup::Setup& setup, const StoredNumber& number);

/// Numbers that are entered together.
struct Store {
    std::string name;  ///< "G54", "H1.length", "pivot"
    std::string what;  ///< "work offset G54"
    std::vector<StoredNumber> numbers;
};

/// The stores that a program on this control may use: all of G54 to G59 and the external offset,
/// G54.1 and tools that are non-zero or that it names, its common variables, 5114, 5115, 5440,
/// reference positions, pivot (of a Hurco the centrelines and the height of M25).
std::vector<Store> store_table(const setup::Setup& setup, const ProgramStores& used = {});

bool is_hurco(const setup::Setup& setup);
/// The axis's own value of a parameter, for writing; the other axes keep theirs.
double& axis_value(setup::Setup& setup, int parameter, Axis axis);

}  // namespace trunnion::choices
