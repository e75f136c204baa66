// What the chosen effects leave unexplained, or explain only in appearance.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"
#include "diagnosis/statistics.h"

namespace trunnion {

bool Diagnoser::stated_noise_is_off(const NoiseModel& found) const {
    std::map<Device, double> rows;
    for (const NoiseBlock& block : blocks_)
        rows[block.device] += static_cast<double>(block.rows.size());
    return std::any_of(rows.begin(), rows.end(), [&](const auto& entry) {
        const DeviceNoise& noise = found.of(entry.first);
        const double chance = 3.0 / std::sqrt(2.0 * noise.independent(entry.second));
        return std::abs(std::log(noise.scale)) > std::max(0.1, chance);
    });
}

/// What the chosen set explains only by parameters that let forms deviate from the textbook's, as
/// mean squared z.
double Diagnoser::unusual_square() const {
    std::vector<Eigen::Index> usual;
    for (const std::size_t m : set_.members) {
        const Candidate& c = design_->candidates()[m];
        for (Eigen::Index j = 0; j < c.size(); ++j)
            if (c.effect->parameters[c.parameters[static_cast<std::size_t>(j)]].usual)
                usual.push_back(c.first + j);
    }
    const auto all = columns_of(*design_, set_.members);
    if (usual.size() == all.size()) return 0.0;
    return std::max(0.0, mean_square(usual, set_.scale) - mean_square(all, set_.scale));
}

/// What a ripple explains that stands beside positioning errors of the same axis while that axis
/// stood in few places: any function of so few places can be written so.
double Diagnoser::aliased_square() const {
    const auto has = [&](const std::string& name) {
        return std::any_of(set_.members.begin(), set_.members.end(), [&](std::size_t m) {
            return design_->candidates()[m].effect->name == name;
        });
    };
    double sum = 0.0;
    for (const std::size_t m : set_.members) {
        const Effect& effect = *design_->candidates()[m].effect;
        const auto axis = std::find_if(table_.axes.begin(), table_.axes.end(), [&](Axis a) {
            return table_.names.is_rotary(a) && effect.name == table_.names[a] + ".cyclic";
        });
        if (axis == table_.axes.end() || !has(table_.names[*axis] + ".positioning")) continue;
        std::set<long> places;
        for (std::size_t i = 0; i < replay_.size(); ++i)
            places.insert(std::lround(replay_.sample(i).position[*axis] * 1e4));
        if (places.size() > 30) continue;
        std::vector<std::size_t> others;
        for (const std::size_t o : set_.members)
            if (o != m) others.push_back(o);
        sum += std::max(0.0, left_square(others) - left_square(set_.members));
    }
    return sum;
}

/// Noise of what is left when the drivers that matter most are taken out as well: the size of the
/// noise shows although something unknown happened to the machine.
NoiseModel Diagnoser::noise_without_drivers(const Eigen::VectorXd& left) const {
    double lost = 0.0;
    const Eigen::VectorXd rest = without_drivers(replay_, table_, base_, known_columns(set_), left,
                                                 base_.sigma_mm, used_, *whitener_, lost);
    const double freedom =
        std::clamp((freedom_after(set_) - lost) / static_cast<double>(replay_.size()), 0.2, 1.0);
    return noise_from_residuals(replay_, blocks_, rest, sigma_mm_, NoiseModel{}, freedom,
                                base_.noise_given);
}

/// What a further ripple (a keyed effect at keys not used yet) would explain of the remainder.
double Diagnoser::ripple_square(const Eigen::VectorXd& left) {
    double most = 0.0;
    const Eigen::MatrixXd fitted = known_columns(set_);
    const double rows = static_cast<double>(replay_.size());
    for (const Effect& effect : catalogue_) {
        if (modelled(effect) || effect.name.find(".cyclic") == std::string::npos) continue;
        const auto keys = keys_->best(effect, left, sigma_mm_, fitted, 1);
        if (keys.empty()) continue;
        Eigen::MatrixXd a(left.size(), 2);
        for (Eigen::Index c = 0; c < 2; ++c)
            a.col(c) = effect_column(replay_, base_.gradient, effect, keys.front(),
                                     static_cast<std::size_t>(c));
        whitener_->apply(a);
        const Eigen::VectorXd h = a.transpose() * whitener_->apply(left);
        Eigen::Matrix2d information = a.transpose() * a;
        information.diagonal().array() += 1e-6;
        const double gain = h.dot(information.ldlt().solve(h));
        if (1e4 * chi_squared_tail(gain, 2.0) > rules::driver_p) continue;
        most = std::max(most, gain / rows * floor_square());
    }
    return most;
}

/// Several effects that all follow one driver, none of them the main one: a coincidence that rather
/// says that something unknown follows that driver.
bool Diagnoser::coincidence() const {
    if (result_.causes.size() < 3) return false;
    const double top = result_.causes.front().share;
    if (result_.causes.size() >= 4) return top < 0.6;
    if (top >= 0.6 || result_.where.empty()) return false;
    double sum = 0.0;
    for (const Cause& cause : result_.causes) sum += cause.share;
    return result_.where.front().share >= 0.95 * sum;
}

Diagnoser::Remainder Diagnoser::remainder() {
    Remainder r;
    const Eigen::VectorXd left = left_after(set_);
    r.drivers = test_drivers(replay_, table_, base_, known_columns(set_), left, base_.sigma_mm,
                             used_, *whitener_);
    std::erase_if(r.drivers, [](const DriverTest& t) { return t.p_value > rules::driver_p; });
    r.base = left_square({});
    r.after = left_square(set_.members);
    r.floor = floor_square();
    r.structured = r.drivers.empty() ? 0.0 : std::max(0.0, r.drivers.front().explained);
    r.structured = std::max(r.structured, ripple_square(left));
    const bool trusted = noise_.source == NoiseSource::repeats;
    if (!trusted && stated_noise_is_off(r.structured == 0.0 ? noise_ : noise_without_drivers(left)))
        noise_.source = NoiseSource::assumed;
    // Without repeats a remainder without structure is noise, whatever was stated.
    const double rows = independent_readings();
    const double doubt = trusted ? 4.0 * std::hypot(noise_.doubt, std::sqrt(2.0 / rows)) : 1.1;
    double beyond = r.after - r.floor > doubt * r.floor ? r.after - r.floor : 0.0;
    // A stated noise may be wrong by 30 %: what is left beyond that is no noise.
    const double most = rules::most_noise * (1.0 + 3.0 * std::sqrt(2.0 / rows));
    if (!trusted && base_.noise_given && r.after > most) beyond = r.after - 1.0;
    // A gap of structure alone, without any effect, must be plain to see.
    const double plain = set_.members.empty() ? rules::plain_square : rules::least_square;
    const double least = trusted ? std::max(plain, noise_.doubt) : plain;
    r.unexplained = std::max(r.structured > least * r.floor ? r.structured : 0.0, beyond);
    r.gap = std::max(1e-9, r.base - r.after) + r.unexplained;
    r.plain = r.unexplained > std::max(rules::admit_square * r.floor, rules::least_share * r.gap);
    r.unexplained = std::min(r.gap, r.unexplained + unusual_square() + aliased_square());
    return r;
}

}  // namespace trunnion
