// Options of the control in place of a store that was found beside others.
#pragma once

#include <string>
#include <vector>

#include "choices/store_columns.h"

namespace trunnion::choices {

struct OptionInstead {
    std::string name;
    double loss = 0.0;  ///< with the other stores fitted beside it
};

/// The control without one store. `others`: the numbers of the stores that stay.
struct RestOfStores {
    const Comparer& comparer;
    const setup::Setup& setup;
    const Numbers& others;
};

/// Those that explain a part of what is left without the store.
std::vector<OptionInstead> options_instead(const RestOfStores& rest);

}  // namespace trunnion::choices
