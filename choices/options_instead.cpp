#include "choices/options_instead.h"

#include <optional>
#include <utility>

#include "choices/choice_table.h"

namespace trunnion::choices {

namespace {

constexpr int most_refits = 5;  ///< steps of Gauss-Newton, of the stores beside an option

}  // namespace

std::vector<OptionInstead> options_instead(const RestOfStores& rest) {
    std::vector<OptionInstead> out;
    const ComparedRun own = rest.comparer.run(rest.setup);
    const SameWay same(rest.comparer, rest.setup, own.path);
    for (const Choice& choice : choice_table()) {
        if (choice.holds(rest.setup)) continue;
        FittedControl control{rest.setup, {}};
        choice.take(control.setup);
        std::optional<ControlPath> path = same.other(control.setup);
        if (!path) continue;
        control.run = rest.comparer.compared(std::move(*path));
        if (control.run.loss >= own.loss) continue;
        for (int k = 0; k < most_refits && improve(rest.comparer, rest.others, control); ++k) {
        }
        out.push_back({choice.name(), control.run.loss});
    }
    return out;
}

}  // namespace trunnion::choices
