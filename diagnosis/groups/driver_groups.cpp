// Drivers as groups of columns: beside the effects, and whole.
#include <cmath>
#include <utility>

#include "diagnosis/groups/beside_places.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/groups/driver_list.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/whole_drivers.h"

namespace trunnion::diagnosis {

void add_driver_groups(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Eigen::Index owned) {
    std::vector<Axis> with_play;
    for (const Design::Entry& entry : design.groups())
        if (entry.group.table.play) with_play.push_back(entry.group.table.axis.axis);
    const std::vector<Driver> list =
        drivers_of(prepared.replay, prepared.table, prepared.base, std::move(with_play));
    const double prior = rules::table_prior - std::log(static_cast<double>(list.size()));
    const auto whitened = [&](const Driver& driver,
                              const std::vector<std::vector<double>>& of_rows) {
        Eigen::MatrixXd columns(static_cast<Eigen::Index>(prepared.replay.size()),
                                static_cast<Eigen::Index>(of_rows.size()));
        for (std::size_t c = 0; c < of_rows.size(); ++c)
            columns.col(static_cast<Eigen::Index>(c)) =
                usual_driver_mm *
                Eigen::Map<const Eigen::VectorXd>(of_rows[c].data(), columns.rows());
        whitener.apply(columns);
        if (driver.of_time) columns = beside_places(prepared, whitener, std::move(columns), false);
        return columns;
    };
    for (const Driver& driver : list) {
        ColumnGroup group;
        group.kind = GroupKind::driver;
        group.name = driver.by;
        group.component = driver.component;
        group.text = driver.text;
        group.of_time = driver.of_time;
        group.log_prior = prior;
        const auto on_features = [&](const std::vector<std::vector<double>>& of_rows) {
            const Eigen::MatrixXd columns = whitened(driver, of_rows);
            const Eigen::Index first = design.add_features(columns);
            ColumnGroup of = group;
            for (Eigen::Index k = 0; k < columns.cols(); ++k) of.features.push_back(first + k);
            return of;
        };
        const ColumnGroup own = on_features(driver.columns);
        // The first whole one is that of with_whole_drivers().
        if (!driver.only_where && !driver.has_effect) add_whole(design, own);
        if (!driver.walk.empty()) {
            ColumnGroup walk = on_features(driver.walk);
            walk.is_walk = true;
            add_whole(design, std::move(walk));
        }
        const std::size_t added = design.add_beside(own, owned);
        if (driver.only_where) design.hide(added);
    }
}

}  // namespace trunnion::diagnosis
