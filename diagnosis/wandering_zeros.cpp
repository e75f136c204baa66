#include "diagnosis/wandering_zeros.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {

void add_wandering_zeros(const Outcome& found, std::vector<DriverShare>& where) {
    Design& design = found.design;
    const double floor = found.judgement.floor;
    const Sizes sizes = sizes_of(design, found.model, floor, found.judgement.large);
    const Eigen::VectorXd y = design.projection().beside(design.data());
    const double gap = y.squaredNorm() - design.freedom() * floor;
    for (std::size_t k = 0; k < found.model.members.size(); ++k) {
        const ColumnGroup& group = design.group(found.model.members[k]);
        const double square = sizes.square[k];
        if (!group.of_cycles || square < rules::large_zero * floor * design.rows() ||
            square < rules::driver_share * gap ||
            std::any_of(where.begin(), where.end(),
                        [&](const DriverShare& d) { return d.by == group.name; }))
            continue;
        DriverShare zeros{group.name, group.component, "", 0.0, 1.0};
        zeros.share = std::clamp(square / gap, 0.0, 1.0);
        zeros.p_value =
            estimation::chi_squared_tail(square / floor, static_cast<double>(group.columns()));
        zeros.text = fmt::format("{:.0f} % of the gap {} ({}), which is free beside the causes",
                                 100.0 * zeros.share, group.text, group.component);
        where.push_back(std::move(zeros));
    }
}

}  // namespace trunnion::diagnosis
