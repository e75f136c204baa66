#include "imports/iso_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/units.h"

namespace trunnion::imports {
namespace {

/// Values beside their targets, in one unit.
struct Beside {
    std::vector<double> targets, apart;  ///< apart: value - target

    bool positions() const {  ///< "100.003" at the target 100
        return sum(apart, 0.0) < 0.05 * sum(targets, 0.0);
    }
    bool displacements() const {  ///< "200.003" at the target 100: counted from another zero
        return spread(apart) < 0.05 * spread(targets);
    }
    /// Two may do so by chance.
    bool follow() const { return targets.size() > 2 && (positions() || displacements()); }
    /// What deviations do not do: change as much as the targets.
    bool as_far_as_targets(const std::vector<double>& values) const {
        return spread(targets) > 0.0 && spread(values) > 0.5 * spread(targets);
    }

  private:
    static double sum(const std::vector<double>& list, double from) {
        double total = 0.0;
        for (const double v : list) total += std::abs(v - from);
        return total;
    }
    static double spread(const std::vector<double>& list) {
        const double total = std::accumulate(list.begin(), list.end(), 0.0);
        return sum(list, total / static_cast<double>(std::max<std::size_t>(1, list.size())));
    }
};

/// The plain numbers of a column beside those of the targets.
Beside numbers_beside(const IsoSource& source, std::size_t column) {
    const TextTable& table = source.table;
    Beside beside;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const auto target = table.find_number(cells[source.target].text),
                   value = table.find_number(cells[column].text);
        if (!target || !value) continue;
        beside.targets.push_back(*target);
        beside.apart.push_back(*value - *target);
    }
    return beside;
}

/// "-15.0001" at -15 mm is a position in mm, not a deviation of -15 um: as such it would be a
/// perfect error of scale of 1000 ppm.
void refuse_same_numbers(const IsoSource& source, const Beside& beside, bool same_unit,
                         std::size_t column) {
    if (same_unit || source.quantities.target != source.quantities.value ||
        source.facts.text("values") == "deviations" || !beside.follow())
        return;
    source.table.header_line().fail(
        "the values have the numbers of the targets, but another unit: positions? Tell their unit "
        "in the names of the columns, or omit --with unit=; --with values=deviations takes them as "
        "they are",
        column < source.table.columns().size() ? source.table.columns()[column].column : 1);
}

bool same(double a, double b) {
    return std::abs(a - b) <= 1e-9 * std::abs(a);
}

}  // namespace

std::string usual_unit(Quantity quantity) {
    return quantity == Quantity::angle ? "deg" : "mm";
}

double value_factor(const IsoSource& source, std::size_t column) {
    const Beside beside = numbers_beside(source, column);
    const bool named = !source.table.columns()[column].unit.empty();
    if (!named && !source.facts.has("unit") &&
        source.quantities.target == source.quantities.value && beside.follow())
        return source.factor;
    const double factor =
        number_column(source.table, column, source.quantities.value, source.facts.text("unit"))
            .factor;
    refuse_same_numbers(source, beside, named || same(factor, source.factor), column);
    return factor;
}

void refuse_numbers_of_targets(const IsoSource& source, const std::vector<IsoPoint>& points,
                               double target_factor, double value_factor) {
    Beside beside;
    for (const IsoPoint& p : points) {
        beside.targets.push_back(p.target / target_factor);
        beside.apart.push_back(p.deviation / value_factor - beside.targets.back());
    }
    refuse_same_numbers(source, beside, same(target_factor, value_factor), 0);
}

void note_units(const IsoSource& source, std::vector<std::string>& notes) {
    const TextColumn& target = source.table.columns()[source.target];
    if (!target.unit.empty()) return;
    const std::string unit = source.facts.text("unit");
    notes.push_back(fmt::format("{}: '{}' without unit taken as {}{}", source.table.path(),
                                target.name, usual_unit(source.quantities.target),
                                unit.empty() ? "" : "; unit " + unit + " is that of the values"));
}

void take_deviations(const TextTable& table, const Facts& facts, const IsoQuantities& quantities,
                     std::vector<IsoPoint>& points, std::vector<std::string>& notes) {
    const bool angle = quantities.target == Quantity::angle;
    Beside beside;
    std::vector<double> values;
    for (const IsoPoint& p : points) {
        const double apart = p.deviation - p.target;
        beside.targets.push_back(p.target);
        beside.apart.push_back(angle ? std::remainder(apart, 2.0 * pi) : apart);
        values.push_back(p.deviation);
    }
    const std::string told = facts.text("values");
    const bool same = quantities.value == quantities.target;
    const bool positions = told.empty() ? same && beside.positions() : told == "positions";
    if (positions || (told.empty() && same && beside.displacements())) {
        const double zero = positions ? 0.0 : beside.apart.front();
        for (std::size_t k = 0; k < points.size(); ++k)
            points[k].deviation = values[k] = beside.apart[k] - zero;
        notes.push_back(table.path() +
                        (positions ? ": values are positions: deviation = value - target"
                                   : ": values are displacements: deviation = value - target, "
                                     "counted from the first reading"));
    }
    if (told != "deviations" && same && beside.as_far_as_targets(values))
        table.header_line().fail(
            "the values change as much as the targets: another column, unit or sign? "
            "--with values=deviations takes them as they are",
            1);
}

}  // namespace trunnion::imports
