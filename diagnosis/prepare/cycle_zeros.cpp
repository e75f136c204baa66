// Model       d_k = (z_b - z_a + e_k) / h_k: difference of two readings at one place, in the parts
//             a and b of the test; z: zero of a part, h: deviation of the difference by the sigma
//             of its two readings.
// Method      zeros by medians, part after part, then by means of what is not spoiled
//             (estimation/scatter.h). Parts are split where the zero jumps: a test of the loss of
//             medians, measured by differences of neighbours in time, which no zero and no jump
//             changes but at one place.
#include "diagnosis/prepare/cycle_zeros.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "estimation/distributions.h"
#include "estimation/quantiles.h"
#include "estimation/scatter.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t fewest_of_part = 3;     ///< differences; fewer tell no zero
constexpr std::size_t fewest_neighbours = 5;  ///< differences of neighbours that tell the noise
constexpr double beyond_line = 12.0;          ///< what a jump saves more than a line (assumed)
constexpr std::size_t most_candidates = 64;   ///< places of a jump in a part
constexpr double farthest_counted = 6.0;      ///< deviations: a reading farther off counts as there
constexpr double jump_chance = 0.05;          ///< that the noise alone shows a jump anywhere
constexpr double of_median = 0.37;  ///< efficiency of a deviation by the median absolute value
constexpr int most_sweeps = 30;

/// A difference seen from one of its parts: positive where the reading in this part is higher.
struct Seen {
    std::size_t difference;
    Eigen::Index row;  ///< device row in this part
    double sign;
};

class CycleZeros {
  public:
    CycleZeros(const std::vector<Eigen::Index>& cycle, const Eigen::VectorXd& sigma_mm,
               double least, const std::vector<Stretch>& list)
        : least_(least), part_(cycle.size(), 0) {
        for (const Stretch& s : list)
            differences_.push_back({s.before, s.rows.front(), s.value(0),
                                    std::hypot(sigma_mm(s.before), sigma_mm(s.rows.front()))});
        number_parts(cycle);
        place();
    }

    /// The cycles, of which some are two; numbered in the order of their first rows.
    std::vector<Eigen::Index> split(std::vector<Eigen::Index> cycle) {
        const std::size_t most = zeros_.size();
        for (std::size_t k = 0; k < most; ++k) {
            const Jump jump = clearest_jump();
            if (!jump.is_clear) break;
            for (auto i = static_cast<std::size_t>(jump.first_row); i < part_.size(); ++i)
                if (part_[i] == jump.part) part_[i] = static_cast<Eigen::Index>(zeros_.size());
            zeros_.push_back(0.0);
            place();
        }
        std::map<std::pair<Eigen::Index, Eigen::Index>, Eigen::Index> met;
        for (std::size_t i = 0; i < cycle.size(); ++i)
            cycle[i] = met.try_emplace({cycle[i], part_[i]}, static_cast<Eigen::Index>(met.size()))
                           .first->second;
        return cycle;
    }

    Eigen::VectorXd of_rows() const {
        Eigen::VectorXd zero(static_cast<Eigen::Index>(part_.size()));
        for (Eigen::Index i = 0; i < zero.size(); ++i) zero(i) = zero_mm(i);
        return zero;
    }

    /// What the zeros leave of each difference, scaled by the freedom that they take.
    std::vector<double> left() {
        refine();
        return scaled();
    }

  private:
    std::vector<double> scaled() const {
        std::set<Eigen::Index> present;
        for (const Difference& d : differences_)
            if (part(d.row) != part(d.before)) present.insert({part(d.row), part(d.before)});
        const auto n = static_cast<double>(differences_.size()),
                   zeros = static_cast<double>(std::max<std::size_t>(1, present.size()) - 1);
        const double free = std::sqrt(n / std::max(1.0, n - zeros));
        std::vector<double> left = residuals();
        for (double& value : left) value *= free;
        return left;
    }

    struct Difference {
        Eigen::Index before, row;
        double value, size_mm;  ///< in units of size_mm
    };

    Eigen::Index part(Eigen::Index row) const { return part_[static_cast<std::size_t>(row)]; }
    double zero_mm(Eigen::Index row) const { return zeros_[static_cast<std::size_t>(part(row))]; }
    double residual(const Difference& d) const {
        return d.value - (zero_mm(d.row) - zero_mm(d.before)) / d.size_mm;
    }
    std::vector<double> residuals() const {
        std::vector<double> left;
        for (const Difference& d : differences_) left.push_back(residual(d));
        return left;
    }

    /// The cycles as parts; one with few differences to others belongs to the part before.
    void number_parts(const std::vector<Eigen::Index>& cycle) {
        std::vector<std::size_t> count(static_cast<std::size_t>(cycle.back()) + 1, 0);
        for (const Difference& d : differences_)
            for (const Eigen::Index row : {d.before, d.row})
                if (cycle[static_cast<std::size_t>(d.before)] !=
                    cycle[static_cast<std::size_t>(d.row)])
                    ++count[static_cast<std::size_t>(cycle[static_cast<std::size_t>(row)])];
        std::vector<Eigen::Index> part_of_cycle(count.size(), 0);
        for (std::size_t c = 1; c < count.size(); ++c)
            part_of_cycle[c] = part_of_cycle[c - 1] + (count[c] < fewest_of_part ? 0 : 1);
        for (std::size_t i = 0; i < cycle.size(); ++i)
            part_[i] = part_of_cycle[static_cast<std::size_t>(cycle[i])];
        zeros_.assign(static_cast<std::size_t>(part_of_cycle.back()) + 1, 0.0);
    }

    /// The differences between each part and others, in the order of its rows.
    std::vector<std::vector<Seen>> seen_from_parts() const {
        std::vector<std::vector<Seen>> seen(zeros_.size());
        for (std::size_t k = 0; k < differences_.size(); ++k) {
            const Difference& d = differences_[k];
            if (part(d.row) == part(d.before)) continue;
            seen[static_cast<std::size_t>(part(d.row))].push_back({k, d.row, 1.0});
            seen[static_cast<std::size_t>(part(d.before))].push_back({k, d.before, -1.0});
        }
        for (std::vector<Seen>& list : seen)
            std::stable_sort(list.begin(), list.end(),
                             [](const Seen& a, const Seen& b) { return a.row < b.row; });
        return seen;
    }

    double signed_mm(const Seen& seen) const {
        const Difference& d = differences_[seen.difference];
        return seen.sign * residual(d) * d.size_mm;
    }

    /// Zeros by medians: of each part beside those before it, then beside all.
    void place() {
        std::fill(zeros_.begin(), zeros_.end(), 0.0);
        const auto seen = seen_from_parts();
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            double moved = 0.0;
            for (std::size_t q = 0; q < zeros_.size(); ++q) {
                std::vector<double> values;
                for (const Seen& s : seen[q]) {
                    const Difference& d = differences_[s.difference];
                    const Eigen::Index other = part(s.sign > 0.0 ? d.before : d.row);
                    if (sweep > 0 || other < static_cast<Eigen::Index>(q))
                        values.push_back(signed_mm(s));
                }
                const double step = estimation::median(std::move(values));
                zeros_[q] += step;
                moved = std::max(moved, std::abs(step));
            }
            if (sweep > 0 && moved == 0.0) return;
        }
    }

    /// Zeros by the means of what is not spoiled.
    void refine() {
        const auto seen = seen_from_parts();
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            const estimation::Scatter scatter = estimation::scatter_of(scaled(), least_);
            double moved = 0.0;
            for (std::size_t q = 0; q < zeros_.size(); ++q) {
                double sum = 0.0, weight = 0.0;
                for (const Seen& s : seen[q]) {
                    if (!scatter.kept[s.difference]) continue;
                    const double size_mm = differences_[s.difference].size_mm;
                    sum += signed_mm(s) / (size_mm * size_mm);
                    weight += 1.0 / (size_mm * size_mm);
                }
                if (weight <= 0.0) continue;
                zeros_[q] += sum / weight;
                moved = std::max(moved, std::abs(sum) / std::sqrt(weight));
            }
            if (moved < 1e-3 * std::max(least_, scatter.deviation)) return;
        }
    }

    /// Deviation of the differences by neighbours in time, and their number.
    std::pair<double, std::size_t> by_neighbours(const std::vector<std::vector<Seen>>& seen) const {
        std::vector<double> steps;
        for (const std::vector<Seen>& list : seen) {
            const Seen* last = nullptr;
            for (const Seen& now : list) {
                if (now.sign < 0.0) continue;  // seen from its other part
                if (last) steps.push_back((white(now) - white(*last)) / std::sqrt(2.0));
                last = &now;
            }
        }
        const std::size_t count = steps.size();
        return {std::max(least_, estimation::robust_deviation(std::move(steps))), count};
    }

    double white(const Seen& seen) const {
        return seen.sign * residual(differences_[seen.difference]);
    }

    /// What a line leaves of values one after the other.
    static std::vector<double> beside_line(std::vector<double> values) {
        const double middle = 0.5 * static_cast<double>(values.size() - 1);
        double sum = 0.0, square = 0.0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double at = static_cast<double>(k) - middle;
            sum += at * values[k];
            square += at * at;
        }
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] -= sum / square * (static_cast<double>(k) - middle);
        return values;
    }

    /// Sum of squares about the median, none beyond `farthest_counted` deviations.
    static double loss(const std::vector<double>& values, double deviation) {
        const double middle = estimation::median(values);
        double sum = 0.0;
        for (const double value : values) {
            const double z = std::min(farthest_counted, std::abs(value - middle) / deviation);
            sum += z * z;
        }
        return sum;
    }

    /// A jump of the zero within a part.
    struct Jump {
        Eigen::Index part = 0, first_row = 0;  ///< the first row behind it
        double gain = 0.0;                     ///< loss that it saves
        bool is_clear = false;
    };

    /// The place in one part where a jump saves most. A zero that moves steadily does not jump:
    /// what a line saves does not count.
    Jump best_jump(const std::vector<Seen>& list, double deviation, double& tried) const {
        Jump best;
        if (list.size() < 2 * fewest_of_part) return best;
        std::vector<double> all;
        for (const Seen& s : list) all.push_back(white(s));
        const double before = loss(all, deviation);
        const std::size_t step = 1 + list.size() / most_candidates;
        for (std::size_t k = fewest_of_part; k + fewest_of_part <= list.size(); k += step) {
            if (list[k].row == list[k - 1].row) continue;
            tried += 1.0;
            const auto middle = all.begin() + static_cast<std::ptrdiff_t>(k);
            const double gain = before - loss({all.begin(), middle}, deviation) -
                                loss({middle, all.end()}, deviation);
            if (gain <= best.gain) continue;
            best.gain = gain;
            best.part = part(list[k].row);
            best.first_row = list[k].row;
        }
        best.is_clear =
            best.gain > before - loss(beside_line(std::move(all)), deviation) + beyond_line;
        return best;
    }

    /// The clearest jump of all parts; not clear where the noise or a line explains it.
    Jump clearest_jump() const {
        const auto seen = seen_from_parts();
        const auto [deviation, count] = by_neighbours(seen);
        Jump best;
        if (count < fewest_neighbours || deviation <= 0.0) return best;
        double tried = 0.0;
        for (const std::vector<Seen>& list : seen) {
            const Jump jump = best_jump(list, deviation, tried);
            if (jump.is_clear && jump.gain > best.gain) best = jump;
        }
        const double freedom = std::max(1.0, of_median * static_cast<double>(count));
        best.is_clear =
            best.is_clear && estimation::f_tail(best.gain, 1.0, freedom) * tried < jump_chance;
        return best;
    }

    double least_;
    std::vector<Difference> differences_;
    std::vector<Eigen::Index> part_;  ///< of each device row
    std::vector<double> zeros_;       ///< of each part, mm or rad
};

}  // namespace

std::vector<Eigen::Index> split_at_jumps(const std::vector<Eigen::Index>& cycle,
                                         const Eigen::VectorXd& sigma_mm, double least,
                                         const std::vector<Stretch>& list) {
    if (cycle.empty() || list.empty()) return cycle;
    return CycleZeros(cycle, sigma_mm, least, list).split(cycle);
}

RepeatScatter scatter_beside_zeros(const std::vector<Eigen::Index>& cycle,
                                   const Eigen::VectorXd& sigma_mm, double least,
                                   const std::vector<Stretch>& list) {
    CycleZeros zeros(cycle, sigma_mm, least, list);
    const double deviation = estimation::scatter_of(zeros.left(), least).deviation;
    return {zeros.of_rows(), std::max(least, deviation)};
}

void remove_zeros_of_cycles(const std::vector<Eigen::Index>& cycle, const Eigen::VectorXd& sigma_mm,
                            double least, std::vector<Stretch>& list) {
    if (cycle.empty() || list.empty()) return;
    const std::vector<double> left = CycleZeros(cycle, sigma_mm, least, list).left();
    for (std::size_t k = 0; k < list.size(); ++k) list[k].value(0) = left[k];
}

}  // namespace trunnion::diagnosis
