#include "diagnosis/wandering_zeros.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

void add_wandering_zeros(const Outcome& found, std::vector<DriverShare>& where) {
    Design& design = found.design;
    const double floor = found.judgement.floor;
    const Sizes sizes = sizes_of(design, found.model, floor, found.judgement.large);
    const Eigen::VectorXd y = design.projection().beside(design.data());
    const double gap = y.squaredNorm() - design.freedom() * floor;
    for (std::size_t k = 0; k < found.model.members.size(); ++k) {
        const ColumnGroup& group = design.group(found.model.members[k]);
        const double square = sizes.square[k];
        const double sigmas = std::sqrt(square / (floor * design.rows()));
        const bool counts = sigmas >= rules::large_cycle || square >= rules::driver_share * gap;
        if (!group.of_cycles || sigmas < rules::large_zero || !counts ||
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

/// A note where a gap changes from cycle to cycle or in the order of the readings, and the table
/// has no times: without them a drift is not tried.
void tell_missing_times(const Outcome& found, Diagnosis& d) {
    const auto changes = [&](const DriverShare& where) {
        return std::any_of(found.design.groups().begin(), found.design.groups().end(),
                           [&](const Design::Entry& entry) {
                               const ColumnGroup& group = entry.group;
                               return (group.of_time || group.of_cycles) &&
                                      group.name == where.by && group.component == where.component;
                           });
    };
    if (records::has_times(found.prepared.table) ||
        std::none_of(d.where.begin(), d.where.end(), changes))
        return;
    d.notes.push_back(
        "the readings have no times, so no drift was tried: with times (a column time_s, or "
        "--with step_s= at the import) one can be told from the rest");
}

}  // namespace

void tell_wandering_zeros(const Outcome& found, Diagnosis& d) {
    add_wandering_zeros(found, d.where);
    tell_missing_times(found, d);
}

}  // namespace trunnion::diagnosis
