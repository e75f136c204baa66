#include "emulator/device_noise.h"

#include <algorithm>

namespace trunnion::emulator {
namespace {

/// Default noise, um or urad, in the order of records::Device.
constexpr double usual_noise[] = {0.0, 1.0, 1.0, 0.5, 0.5, 2.0, 10.0, 1.0};

}  // namespace

DeviceNoise device_noise(const setup::ModelSettings& model, const records::Reading& row) {
    const double unit = row.angular ? 1e-6 : 1e-3;
    const auto& list = row.angular ? model.noise_urad : model.noise_um;
    const auto told = list.find(std::string(name_of(row.device)));
    DeviceNoise noise;
    if (row.sigma_mm && *row.sigma_mm > 0.0) {
        noise.sigma_mm = *row.sigma_mm;
    } else {
        noise.given = told != list.end();
        noise.sigma_mm =
            unit * (noise.given ? told->second : usual_noise[static_cast<std::size_t>(row.device)]);
    }
    noise.sigma_mm = std::max(noise.sigma_mm, 1e-3 * unit);
    return noise;
}

}  // namespace trunnion::emulator
