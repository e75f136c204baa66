#include <fmt/format.h>

#include <cmath>

#include "effects/models.h"

namespace trunnion::effects {

double harmonic_sum(double angle_rad, std::span<const double> values) {
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < values.size(); k += 2) {
        if (values[k] == 0.0 && values[k + 1] == 0.0) continue;
        const std::size_t order = k / 2 + 1;
        const double angle = static_cast<double>(order) * angle_rad;
        sum += values[k] * std::cos(angle) + values[k + 1] * std::sin(angle);
    }
    return sum;
}

void append_harmonics(std::vector<EffectParameter>& list, const Harmonics& h) {
    for (int n = 1; n <= h.orders; ++n)
        for (const char* wave : {"cos", "sin"}) {
            list.push_back({fmt::format("{}{}{}_{}", h.prefix, wave, n, h.unit),
                            h.unit,
                            h.typical / n,
                            -1,
                            {},
                            true,
                            n <= h.usual_orders});
            list.back().order = n;
        }
}

int main_direction(const kinematics::AxisGeometry& axis) {
    int largest = 0;
    axis.direction.cwiseAbs().maxCoeff(&largest);
    return largest;
}

std::vector<double> geometric_grid(double low, double high, int count) {
    std::vector<double> grid;
    for (int k = 0; k < count; ++k) grid.push_back(low * std::pow(high / low, k / (count - 1.0)));
    return grid;
}

std::string motion_name(int direction, const kinematics::AxisGeometry& axis) {
    return std::string{'E', "XYZABC"[direction]} + axis.name;
}

EffectIdentity identity_of(const kinematics::AxisGeometry& axis, EffectKind kind) {
    return {effect_name(axis.name, kind), kind, axis.axis};
}

std::string axis_parameter(const char* before, const kinematics::AxisGeometry& axis,
                           const char* after) {
    return before + lower_case(axis.name) + after;
}

bool is_probe(const emulator::Contact& contact) {
    return contact.device == records::Device::sphere || contact.device == records::Device::touch;
}

}  // namespace trunnion::effects
