// Effects of instruments: pretravel lobes, stylus radius, runout, tool and ballbar length.
#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "effects/models.h"
#include "effects/touch_pattern.h"

namespace trunnion::effects {
namespace {

/// Pretravel in approach direction `d_M`: lobes over the azimuth in the spindle's own frame,
/// decreasing towards the pole. `value`: cosine and sine of orders 2 and 3.
double pretravel(const Vector3& d_M, double spindle_rad, std::span<const double> value) {
    const double across = std::hypot(d_M.x(), d_M.y());
    if (across < 1e-9) return 0.0;
    const double azimuth = std::atan2(d_M.y(), d_M.x()) - spindle_rad;
    return across * (value[0] * std::cos(2.0 * azimuth) + value[1] * std::sin(2.0 * azimuth) +
                     value[2] * std::cos(3.0 * azimuth) + value[3] * std::sin(3.0 * azimuth));
}

/// Cosine and sine of each order, smaller for two lobes than for the three seats of the stylus.
std::vector<EffectParameter> lobes() {
    std::vector<EffectParameter> list;
    for (const int order : {2, 3})
        for (const char* part : {"cos", "sin"}) {
            EffectParameter p{fmt::format("{}{}_mm", part, order), "mm", order == 2 ? 1e-3 : 2e-3};
            p.order = order;
            list.push_back(std::move(p));
        }
    return list;
}

}  // namespace

Effect probe_pretravel() {
    return {identity_of(EffectKind::probe_pretravel),
            "The probe triggers later in some directions than in others",
            "three-point seating of a touch-trigger probe, long stylus",
            "calibrate the probe in all directions used, or use a strain-gauge probe",
            "trigger later by sum cosN cos(N phi) + sinN sin(N phi), N = 2, 3, phi in the spindle",
            lobes(),
            [](const AxisSample& sample, const emulator::Contact& contact,
               std::span<const double> value, kinematics::Perturbation& out) {
                if (contact.device == records::Device::touch)
                    out.reading_mm += pretravel(contact.direction_M, sample.spindle_rad, value);
                if (contact.device != records::Device::sphere || contact.touches == 0) return;
                const Vector3 shift_mm =
                    touch_pattern(contact.touches).center_shift([&](const Vector3& outward_M) {
                        return -pretravel(-outward_M, sample.spindle_rad, value);
                    });
                out.reading_mm += contact.direction_M.dot(shift_mm);
            }};
}

Effect probe_radius() {
    return {identity_of(EffectKind::probe_radius),
            "The effective stylus radius, or the trigger delay, is not what was calibrated",
            "stylus changed, calibration with another probing feed",
            "calibrate the stylus radius with the feed that measures",
            "touch earlier by radius_mm, later by delay_s * feed",
            {{"radius_mm", "mm", 3e-3, -1, {}, true}, {"delay_s", "s", 5e-3, -1, {}, true}},
            [](const AxisSample& sample, const emulator::Contact& contact,
               std::span<const double> value, kinematics::Perturbation& out) {
                if (contact.device != records::Device::touch) return;
                out.reading_mm += -value[0] + value[1] * sample.feed_mm_min / 60.0;
            }};
}

Effect probe_runout() {
    return {identity_of(EffectKind::probe_runout),
            "The stylus ball does not sit on the spindle axis",
            "stylus not centred, probe shank not seated",
            "centre the stylus, or always probe with the same spindle orientation",
            "tip shifted by (dx_mm, dy_mm), turning with the spindle",
            {{"dx_mm", "mm", 5e-3, -1, {}, true}, {"dy_mm", "mm", 5e-3, -1, {}, true}},
            [](const AxisSample& sample, const emulator::Contact& contact,
               std::span<const double> value, kinematics::Perturbation& out) {
                if (!is_probe(contact) && !contact.stylus) return;
                const double c = std::cos(sample.spindle_rad), s = std::sin(sample.spindle_rad);
                out.tip_shift_mm +=
                    Vector3(c * value[0] - s * value[1], s * value[0] + c * value[1], 0.0);
            }};
}

Effect tool_length() {
    return {
        identity_of(EffectKind::tool_length),
        "The tool, probe or ballbar cup is longer or shorter than the control believes",
        "tool length measured with another reference, stylus changed",
        "measure the tool's length again",
        "tip lower by error_mm (probe and ballbar rows; run --truth: any tool); of 0: every tool "
        "by the same, 1: the probe's alone, 2: the ballbar's alone",
        {{"error_mm", "mm", 15e-3, -1, {}, true}, {"of", "1", 0.0, -1, {0.0, 1.0, 2.0}, false}},
        [](const AxisSample&, const emulator::Contact& contact, std::span<const double> value,
           kinematics::Perturbation& out) {
            const bool probe = is_probe(contact) && value[1] != 2.0;
            const bool cup = contact.device == records::Device::ballbar && value[1] != 1.0;
            if (probe || cup || contact.tip) out.tip_shift_mm.z() -= value[0];
        }};
}

Effect ballbar_length() {
    return {identity_of(EffectKind::ballbar_length),
            "The ballbar's calibrated length is not its length",
            "ballbar not zeroed on its calibrator, warm bar",
            "zero the ballbar on its calibrator before the test",
            "ballbar reading + error_mm",
            {{"error_mm", "mm", 3e-3, -1, {}, true}},
            [](const AxisSample&, const emulator::Contact& contact, std::span<const double> value,
               kinematics::Perturbation& out) {
                if (contact.device == records::Device::ballbar) out.reading_mm += value[0];
            }};
}

}  // namespace trunnion::effects
