#include "records/iso230_2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/units.h"

namespace trunnion::records {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Spread {
    int n = 0;
    double mean = nan, s = nan;
};

Spread spread_of(const std::vector<double>& values) {
    Spread result;
    result.n = static_cast<int>(values.size());
    if (values.empty()) return result;
    double sum = 0.0, squares = 0.0;
    for (const double v : values) sum += v;
    result.mean = sum / result.n;
    for (const double v : values) squares += (v - result.mean) * (v - result.mean);
    if (result.n > 1) result.s = std::sqrt(squares / (result.n - 1));
    return result;
}

/// Largest and smallest value; NaN when any value is NaN.
class Range {
  public:
    void add(double v) {
        if (std::isnan(v)) bad_ = true;
        low_ = std::min(low_, v);
        high_ = std::max(high_, v);
    }
    double width() const { return bad_ || high_ < low_ ? nan : high_ - low_; }
    double most() const { return bad_ || high_ < low_ ? nan : high_; }

  private:
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
    bool bad_ = false;
};

void fill_one_way(Iso230Figures& f, bool up) {
    Range mean, band, repeat;
    for (const TargetFigures& t : f.targets) {
        const double m = up ? t.mean_up : t.mean_down, s = up ? t.s_up : t.s_down;
        mean.add(m);
        band.add(m + 2.0 * s);
        band.add(m - 2.0 * s);
        repeat.add(4.0 * s);
    }
    (up ? f.systematic_E_up : f.systematic_E_down) = mean.width();
    (up ? f.accuracy_A_up : f.accuracy_A_down) = band.width();
    (up ? f.repeatability_R_up : f.repeatability_R_down) = repeat.most();
}

void fill_both_ways(Iso230Figures& f) {
    Range middle, mean, band, repeat;
    double sum = 0.0;
    f.reversal_B = 0.0;
    for (const TargetFigures& t : f.targets) {
        middle.add(t.mean());
        sum += t.reversal();
        if (!(std::abs(t.reversal()) <= std::abs(f.reversal_B))) f.reversal_B = t.reversal();
        for (const auto& [m, s] :
             {std::pair(t.mean_up, t.s_up), std::pair(t.mean_down, t.s_down)}) {
            mean.add(m);
            band.add(m + 2.0 * s);
            band.add(m - 2.0 * s);
        }
        repeat.add(std::max({2.0 * t.s_up + 2.0 * t.s_down + std::abs(t.reversal()), 4.0 * t.s_up,
                             4.0 * t.s_down}));
    }
    f.mean_reversal = f.targets.empty() ? nan : sum / static_cast<double>(f.targets.size());
    f.mean_deviation_M = middle.width();
    f.systematic_E = mean.width();
    f.accuracy_A = band.width();
    f.repeatability_R = repeat.most();
}

/// The only axis whose position differs between the rows.
Axis moving_axis(const ReadingTable& table, const std::vector<const Reading*>& rows) {
    std::set<Axis> moving;
    for (const Reading* row : rows)
        for (const Axis axis : table.axes)
            if (row->commanded[axis] != rows.front()->commanded[axis]) moving.insert(axis);
    if (moving.size() != 1)
        throw InputError(moving.empty() ? "no axis moves in this test"
                                        : "several axes move in this test: no ISO 230-2 figures",
                         place_of(table, *rows.front()));
    return *moving.begin();
}

}  // namespace

Iso230Figures iso230_2_figures(const std::vector<DeviationPoint>& points) {
    std::map<double, std::pair<std::vector<double>, std::vector<double>>> by_target;
    for (const DeviationPoint& p : points) {
        auto& [up, down] = by_target[p.target];
        (p.direction > 0 ? up : down).push_back(p.deviation);
    }
    Iso230Figures figures;
    for (const auto& [target, values] : by_target) {
        const Spread up = spread_of(values.first), down = spread_of(values.second);
        figures.targets.push_back({target, up.mean, down.mean, up.s, down.s, up.n, down.n});
    }
    fill_one_way(figures, true);
    fill_one_way(figures, false);
    fill_both_ways(figures);
    return figures;
}

std::string iso230_2_words(const Iso230Figures& f, bool rotary) {
    const auto number = [&](double v) {
        const double shown = rotary ? deg_from_rad(v) * 3600.0 : um_from_mm(v);
        return std::isnan(v) ? std::string("-") : fmt::format("{:.2f}", shown);
    };
    const char* const unit = rotary ? "arcsec" : "µm";
    const auto has = [&](auto count) {
        return std::any_of(f.targets.begin(), f.targets.end(),
                           [&](const TargetFigures& t) { return t.*count > 0; });
    };
    const bool up = has(&TargetFigures::n_up), down = has(&TargetFigures::n_down);
    if (up != down)
        return fmt::format("ISO 230-2, only towards {}: E {}, R {}, A {} {}", up ? '+' : '-',
                           number(up ? f.systematic_E_up : f.systematic_E_down),
                           number(up ? f.repeatability_R_up : f.repeatability_R_down),
                           number(up ? f.accuracy_A_up : f.accuracy_A_down), unit);
    return fmt::format("ISO 230-2: B {} (mean {}), M {}, E {}, R {}, A {} {}", number(f.reversal_B),
                       number(f.mean_reversal), number(f.mean_deviation_M), number(f.systematic_E),
                       number(f.repeatability_R), number(f.accuracy_A), unit);
}

std::vector<DeviationPoint> deviation_points(const ReadingTable& table, const std::string& test) {
    std::vector<const Reading*> rows;
    for (const Reading& row : table.rows)
        if (row.test == test) rows.push_back(&row);
    if (rows.empty()) throw InputError("no test is named '" + test + "'", {table.path});
    const Axis axis = moving_axis(table, rows);
    std::vector<DeviationPoint> points;
    int side = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double step = k == 0 ? 0.0 : rows[k]->commanded[axis] - rows[k - 1]->commanded[axis];
        if (step != 0.0) side = step > 0.0 ? 1 : -1;
        const bool read = rows[k]->device == Device::linear || rows[k]->device == Device::angle;
        if (read && rows[k]->value_mm && side != 0)
            points.push_back({rows[k]->commanded[axis], side, *rows[k]->value_mm});
    }
    return points;
}

}  // namespace trunnion::records
