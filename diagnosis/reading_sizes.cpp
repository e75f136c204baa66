#include "diagnosis/reading_sizes.h"

#include <algorithm>
#include <cmath>

namespace trunnion::diagnosis {

Eigen::VectorXd noise_mm(const Outcome& f) {
    Eigen::VectorXd v = f.prepared.base.sigma_mm * std::sqrt(f.judgement.floor);
    for (Eigen::Index i = 0; i < v.size(); ++i)
        v(i) *=
            f.noise.model.of(f.prepared.replay.contact(static_cast<std::size_t>(i)).device).scale;
    return v;
}

double rms_um(const Outcome& f, const Eigen::VectorXd& v) {
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        if (!f.used[i]) continue;
        sum += std::pow(v(static_cast<Eigen::Index>(i)), 2);
        rows += 1.0;
    }
    return records::micro_per_one(f.prepared.table) * std::sqrt(sum / std::max(1.0, rows));
}

HeldOut held_out(const Outcome& f, const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
    const Eigen::VectorXd noise = noise_mm(f) / std::sqrt(f.judgement.floor);
    HeldOut h;
    h.rms_before_um = rms_um(f, before.cwiseProduct(noise));
    h.rms_after_um = rms_um(f, after.cwiseProduct(noise));
    h.noise_um = rms_um(f, noise_mm(f));
    const double gap = h.rms_before_um * h.rms_before_um - h.noise_um * h.noise_um;
    const double rest = h.rms_after_um * h.rms_after_um - h.noise_um * h.noise_um;
    h.shrink = gap > 0.0 ? 1.0 - std::sqrt(std::max(0.0, rest) / gap) : 0.0;
    h.low = h.high = h.shrink;
    return h;
}

std::vector<AddedNoise> added_noise(const Outcome& f) {
    std::vector<AddedNoise> list;
    const double micro = records::micro_per_one(f.prepared.table);
    for (const auto& [device, added] : f.prepared.added_mm) {
        if (added <= 0.0) continue;
        double sum = 0.0, rows = 0.0;
        for (std::size_t i = 0; i < f.used.size(); ++i)
            if (f.used[i] && f.prepared.replay.contact(i).device == device) {
                sum += std::pow(f.prepared.stated_sigma_mm(static_cast<Eigen::Index>(i)), 2);
                rows += 1.0;
            }
        const double nu = std::sqrt(f.judgement.floor) * f.noise.model.of(device).scale;
        list.push_back({device, micro * std::sqrt(sum / std::max(1.0, rows)), micro * nu * added});
    }
    return list;
}

std::optional<double> other_stated_um(const Outcome& f) {
    const bool known = f.noise.model.source == NoiseSource::repeats;
    if (known || !f.prepared.base.noise_given || !added_noise(f).empty()) return std::nullopt;
    return rms_um(f, f.prepared.stated_sigma_mm);
}

std::size_t set_aside(const Outcome& f) {
    return static_cast<std::size_t>(std::count(f.used.begin(), f.used.end(), false));
}

}  // namespace trunnion::diagnosis
