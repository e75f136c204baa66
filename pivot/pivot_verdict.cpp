#include "pivot/pivot_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/rounded.h"
#include "base/units.h"

namespace trunnion::pivot {

namespace {

/// Derivatives of the correct values by the unknowns; with the covariance they give the sigmas.
std::vector<double> sigmas_of(const PivotVerdict& verdict) {
    const auto numbers = setup::store_numbers(verdict.right);
    const auto& unknowns = verdict.fit.unknowns;
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(numbers.size()),
                                                  static_cast<Eigen::Index>(unknowns.size()));
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
        const double step = unknowns[k].tilt ? 1e-6 : 1e-3;
        const kinematics::Machine machine = moved(verdict.fit.machine, unknowns[k], step);
        const auto there = setup::store_numbers(setup::right_stores(machine, verdict.in_force));
        for (std::size_t n = 0; n < numbers.size(); ++n)
            slope(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) =
                (there[n].value_mm - numbers[n].value_mm) / step;
    }
    const Eigen::MatrixXd covariance = slope * verdict.fit.covariance * slope.transpose();
    std::vector<double> sigmas;
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        const auto k = static_cast<Eigen::Index>(n);
        sigmas.push_back(std::sqrt(std::max(0.0, covariance(k, k))));
    }
    return sigmas;
}

bool measured(const std::vector<PivotMap>& maps, PivotGroup group) {
    for (const PivotMap& map : maps)
        for (const PivotArc& arc : map.arcs)
            if (arc.group == group) return true;
    return false;
}

/// Poses of a group; if it was not run, those of the other group.
std::vector<PivotPoint> poses_of(const std::vector<PivotMap>& maps, PivotGroup group) {
    const bool own = measured(maps, group);
    std::vector<PivotPoint> poses;
    for (const PivotMap& map : maps)
        for (const PivotArc& arc : map.arcs)
            if (arc.group == group || !own)
                poses.insert(poses.end(), arc.points.begin(), arc.points.end());
    return poses;
}

struct Models {
    PivotModel in_force, right, typed;
};

GroupVerdict group_verdict(const PivotEvidence& evidence, const PivotVerdict& verdict,
                           const Models& models, const std::vector<PivotMap>& maps,
                           PivotGroup group) {
    GroupVerdict out;
    out.group = group;
    out.measured = measured(maps, group);
    for (const PivotPoint& p : poses_of(maps, group)) {
        const Vector3 right = models.right.error_mm(group, p.first_deg, p.second_deg);
        const Vector3 now = models.in_force.error_mm(group, p.first_deg, p.second_deg);
        const Vector3 typed = models.typed.error_mm(group, p.first_deg, p.second_deg);
        out.visible_um = std::max(out.visible_um, Finite(um_from_mm((now - right).norm())));
        out.left_um = std::max(out.left_um, Finite(um_from_mm(typed.norm())));
    }
    double variance = 0.0;
    for (const StoreVerdict& store : verdict.stores)
        if ((store.in_force.parameter == 0) == (group == PivotGroup::g54))
            variance += store.sigma_mm * store.sigma_mm;
    out.sigma_um = 2.0 * um_from_mm(std::sqrt(variance));
    out.stale = (out.measured || group == PivotGroup::p1970x) &&
                out.visible_um > std::max(evidence.limit_um, 4.0 * out.sigma_um);
    return out;
}

/// Largest difference of the two groups at one pose, with the new values.
double agreement_um(const PivotModel& typed, const std::vector<PivotMap>& maps) {
    if (!measured(maps, PivotGroup::g54)) return 0.0;
    double worst = 0.0;
    for (const PivotPoint& p : poses_of(maps, PivotGroup::g54))
        worst = std::max(worst,
                         um_from_mm((typed.error_mm(PivotGroup::g54, p.first_deg, p.second_deg) -
                                     typed.error_mm(PivotGroup::p1970x, p.first_deg, p.second_deg))
                                        .norm()));
    return worst;
}

void add_stores(PivotVerdict& verdict, bool with_g54) {
    const auto now = setup::store_numbers(verdict.in_force),
               right = setup::store_numbers(verdict.right),
               typed = setup::store_numbers(verdict.typed);
    const auto sigma = sigmas_of(verdict);
    for (std::size_t i = 0; i < now.size(); ++i)
        if (with_g54 || now[i].parameter != 0)
            verdict.stores.push_back({now[i], right[i].value_mm, typed[i].value_mm,
                                      now[i].value_mm - right[i].value_mm, sigma[i], false});
}

std::string along(const std::string& numbers, const offsets::PivotAxis& axis) {
    return fmt::format("{}: its part along the {} axis (any point of the line serves)", numbers,
                       letter_of(axis.axis));
}

/// Both axes in the table: the numbers of the dialect.
std::vector<std::string> along_table_axes(const offsets::PivotParameters& pivot, bool hurco) {
    if (!hurco) return {along("19700-19702", pivot.first), along("19703-19705", pivot.second)};
    const auto line = [](const offsets::PivotAxis& axis) {
        return along(fmt::format("{} centreline", letter_of(axis.axis)), axis);
    };
    return {line(pivot.first), line(pivot.second)};
}

bool moves_a_store(const PivotVerdict& verdict, const LineUnknown& unknown) {
    const auto here = setup::store_numbers(verdict.right);
    const auto there = setup::store_numbers(setup::right_stores(
        moved(verdict.fit.machine, unknown, unknown.tilt ? 1e-5 : 1e-2), verdict.in_force));
    for (std::size_t n = 0; n < here.size(); ++n)
        if (std::abs(there[n].value_mm - here[n].value_mm) > 1e-7) return true;
    return false;
}

std::vector<std::string> unobservable(const PivotVerdict& verdict, bool with_g54, bool hurco) {
    const offsets::PivotParameters& pivot = verdict.in_force.pivot;
    std::vector<std::string> out;
    switch (pivot.unit) {
        case offsets::MechanicalUnit::table_table: out = along_table_axes(pivot, hurco); break;
        case offsets::MechanicalUnit::mixed:
            out = {along("19700-19702", pivot.second), along("19709-19711", pivot.first)};
            if (with_g54) out.push_back(along("G54", pivot.second));
            break;
        default: out = {along("19709-19711", pivot.first), along("19712-19714", pivot.second)};
    }
    if (pivot.unit != offsets::MechanicalUnit::table_table)
        out.push_back(
            "the stylus length in the tool table and zero positions of the head's axes: wrong ones "
            "read as 19709-19714");
    if (!with_g54)
        out.push_back(fmt::format("G54 as a pivot: no {} run is among the readings",
                                  hurco ? "DPP" : "DPP or G54.2"));
    out.push_back(fmt::format("zero positions of {} and {}: a sphere turns with them",
                              letter_of(pivot.first.axis), letter_of(pivot.second.axis)));
    for (const std::size_t k : verdict.fit.unseen)
        if (moves_a_store(verdict, verdict.fit.unknowns[k]))
            out.push_back(verdict.fit.unknowns[k].name);
    return out;
}

}  // namespace

const GroupVerdict* PivotVerdict::find(PivotGroup group) const {
    for (const GroupVerdict& verdict : groups)
        if (verdict.group == group) return &verdict;
    return nullptr;
}

PivotVerdict judge_pivot(const PivotEvidence& evidence, const std::vector<PivotMap>& maps) {
    PivotVerdict verdict;
    verdict.fit = fit_pivot_machine(evidence, maps);
    verdict.in_force = evidence.in_force;
    verdict.right = setup::right_stores(verdict.fit.machine, evidence.in_force);
    verdict.typed = setup::rounded(verdict.right, evidence.increment_mm);
    verdict.increment_mm = evidence.increment_mm;
    verdict.limit_um = evidence.limit_um;
    const bool with_g54 = measured(maps, PivotGroup::g54);
    add_stores(verdict, with_g54);
    const auto model = [&](const setup::RotaryStores& stores) {
        return PivotModel(verdict.fit.machine, stores, evidence.sphere_mm, evidence.tip_S_mm);
    };
    const Models models{model(verdict.in_force), model(verdict.right), model(verdict.typed)};
    for (const PivotGroup group : {PivotGroup::g54, PivotGroup::p1970x})
        if (with_g54 || group == PivotGroup::p1970x)
            verdict.groups.push_back(group_verdict(evidence, verdict, models, maps, group));
    for (StoreVerdict& store : verdict.stores) {
        const PivotGroup group =
            store.in_force.parameter == 0 ? PivotGroup::g54 : PivotGroup::p1970x;
        store.stale =
            verdict.find(group)->stale &&
            std::abs(store.error_mm) > std::max(3.0 * store.sigma_mm, 0.51 * verdict.increment_mm);
    }
    verdict.unobservable = unobservable(verdict, with_g54, evidence.hurco);
    verdict.agree_um = agreement_um(models.typed, maps);
    return verdict;
}

void add_expected(const PivotModel& model, const offsets::PivotParameters& pivot,
                  std::vector<PivotMap>& maps) {
    for (PivotMap& map : maps) {
        const Vector3 axis_M = moving_axis_M(pivot, map);
        for (PivotArc& arc : map.arcs) {
            std::vector<PivotPoint> expected = arc.points;
            arc.expected_mm.clear();
            for (PivotPoint& p : expected) {
                p.error_mm = model.error_mm(arc.group, p.first_deg, p.second_deg);
                arc.expected_mm.push_back(p.error_mm);
            }
            arc.circle = fit_circle(map, arc.points, axis_M);
            arc.expected = fit_circle(map, expected, axis_M);
        }
    }
}

std::string sentence(const PivotVerdict& verdict, bool hurco) {
    std::string text;
    for (const GroupVerdict& group : verdict.groups) {
        const bool g54 = group.group == PivotGroup::g54;
        const std::string store = g54     ? "G54 as the pivot"
                                  : hurco ? "The rotary centrelines of the part set-up"
                                          : "The pivot parameters 19700-19714";
        const std::string parts = g54     ? hurco ? "DPP" : "DPP and G54.2"
                                  : hurco ? "M128"
                                          : "G43.4 and tilted-plane";
        text += fmt::format("{}{} {} {}: {} parts are off by up to {} because of {}.",
                            text.empty() ? "" : " ", store,
                            hurco && !g54 ? "are"
                            : g54         ? "is"
                                          : "are",
                            group.stale ? "stale" : "right within what counts", parts,
                            length_words(group.visible_um), g54 ? "it" : "them");
    }
    return text;
}

}  // namespace trunnion::pivot
