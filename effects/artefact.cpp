// Deviations of the artefact: position, form, slip during the test.
#include <algorithm>
#include <cmath>

#include "effects/models.h"
#include "effects/touch_pattern.h"

namespace trunnion::effects {
namespace {

/// 0, 1, ... count - 1: grid of a key that selects one artefact of the setup.
std::vector<double> indices(std::size_t count) {
    std::vector<double> grid;
    for (std::size_t k = 0; k < std::max<std::size_t>(count, 1); ++k)
        grid.push_back(static_cast<double>(k));
    return grid;
}

/// Second-order form deviation of a sphere: five harmonics of the outward normal in W.
double form(const Vector3& n, std::span<const double> value) {
    return value[0] * (n.x() * n.x() - n.y() * n.y()) + value[1] * 2.0 * n.x() * n.y() +
           value[2] * 2.0 * n.x() * n.z() + value[3] * 2.0 * n.y() * n.z() +
           value[4] * (1.5 * n.z() * n.z() - 0.5);
}

/// Candidate times of a slip of one artefact: between its readings, evenly distributed.
std::vector<double> slip_times(const DataExtent& extent, int count) {
    std::vector<double> all;
    for (const auto& times : extent.times_s) {
        const std::size_t n = times.size();
        for (int k = 1; k <= count && n > 1; ++k) {
            const std::size_t at =
                n * static_cast<std::size_t>(k) / static_cast<std::size_t>(count + 1);
            if (at > 0 && at < n) all.push_back(0.5 * (times[at - 1] + times[at]));
        }
    }
    if (all.empty()) all.push_back(0.5 * (extent.start_s + extent.end_s));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return b - a < 1.0; }),
              all.end());
    return all;
}

struct SlipWords {
    const char *what, *cause;
};

/// What may slip in readings of these devices, and why.
SlipWords slip_words(const std::set<records::Device>& devices) {
    using records::Device;
    constexpr const char* clamp = "a clamp or magnet let go, someone touched it";
    const auto only = [&](std::initializer_list<Device> some) {
        return !devices.empty() && std::all_of(devices.begin(), devices.end(), [&](Device device) {
            return std::find(some.begin(), some.end(), device) != some.end();
        });
    };
    if (only({Device::linear}))
        return {"The reflector, the gauge or what holds it slipped during the test", clamp};
    if (only({Device::angle}))
        return {"The mirror or the instrument that reads angles slipped during the test", clamp};
    if (only({Device::point}))
        return {"The part or target that was measured, or the instrument, slipped during the test",
                clamp};
    if (only({Device::linear, Device::angle, Device::point, Device::axis}))
        return {"A target or an instrument slipped during the test", clamp};
    return {"A sphere or cup slipped during the test",
            "magnet or clamp let go, someone touched it"};
}

}  // namespace

Effect artefact_position(const std::vector<setup::Artefact>& artefacts) {
    Effect effect{identity_of(EffectKind::artefact_position),
                  "A sphere or centre cup does not stand where the setup says",
                  "artefact mounted again, position copied from another job",
                  "measure its position again, or declare it free in the setup",
                  "artefact shifted by shift_NAME_mm in W (only artefacts that are not free)",
                  {},
                  {}};
    std::vector<int> fixed;
    for (std::size_t k = 0; k < artefacts.size(); ++k) {
        if (artefacts[k].free_center) continue;
        fixed.push_back(static_cast<int>(k));
        for (int d = 0; d < 3; ++d)
            effect.parameters.push_back(
                {"shift_" + artefacts[k].name + "_mm", "mm", 20e-3, d, {}, true});
    }
    effect.add = [fixed](const AxisSample&, const emulator::Contact& contact,
                         std::span<const double> value, kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < fixed.size(); ++j)
            if (contact.artefact == fixed[j])
                out.work_shift_mm += Vector3(value[3 * j], value[3 * j + 1], value[3 * j + 2]);
    };
    return effect;
}

Effect artefact_form(const std::vector<setup::Artefact>& artefacts) {
    Effect effect{identity_of(EffectKind::artefact_form),
                  "A sphere is not round",
                  "worn or cheap sphere, dirt",
                  "clean or replace the sphere",
                  "surface out by q1 (x2-y2) + q2 2xy + q3 2xz + q4 2yz + q5 (3z2-1)/2, n in W",
                  {},
                  {}};
    for (const char* name : {"q1_mm", "q2_mm", "q3_mm", "q4_mm", "q5_mm"})
        effect.parameters.push_back({name, "mm", 0.7e-3, -1, {}, true});
    effect.parameters.push_back({"artefact", "1", 0.0, -1, indices(artefacts.size()), false});
    effect.add = [](const AxisSample&, const emulator::Contact& contact,
                    std::span<const double> value, kinematics::Perturbation& out) {
        if (!is_probe(contact) || contact.artefact != static_cast<int>(value[5])) return;
        if (contact.device == records::Device::touch) {
            out.reading_mm -= form(contact.direction_W, value);
        } else if (contact.touches > 0) {
            // Rotates M into W by the direction known in both frames; only the component read
            // matters.
            const Matrix3 turn_WM =
                Eigen::Quaterniond::FromTwoVectors(contact.direction_M, contact.direction_W)
                    .toRotationMatrix();
            out.reading_mm += contact.direction_M.dot(
                touch_pattern(contact.touches).center_shift([&](const Vector3& outward_M) {
                    return form(turn_WM * outward_M, value);
                }));
        }
    };
    return effect;
}

Effect artefact_moved(const std::vector<setup::Artefact>& artefacts, const DataExtent& extent) {
    const SlipWords words = slip_words(extent.devices);
    Effect effect{identity_of(EffectKind::artefact_moved),
                  words.what,
                  words.cause,
                  "fix it better and repeat the readings taken after the slip",
                  "artefact shifted by shift_mm in W from time_s on",
                  {},
                  {}};
    for (int d = 0; d < 3; ++d) effect.parameters.push_back({"shift_mm", "mm", 10e-3, d, {}, true});
    effect.parameters.push_back({"artefact", "1", 0.0, -1, indices(artefacts.size()), false});
    effect.parameters.push_back(
        {"time_s", "s", 0.5 * (extent.start_s + extent.end_s), -1, slip_times(extent, 16), true});
    effect.add = [](const AxisSample& sample, const emulator::Contact& contact,
                    std::span<const double> value, kinematics::Perturbation& out) {
        if (contact.artefact != static_cast<int>(value[3]) || sample.time_s < value[4]) return;
        out.work_shift_mm += Vector3(value[0], value[1], value[2]);
    };
    return effect;
}

}  // namespace trunnion::effects
