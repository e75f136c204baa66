// An effect: a named difference between the real machine and its simulation.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "effects/effect_kind.h"
#include "emulator/instruments.h"

namespace trunnion::effects {

/// One scalar of an effect. The perturbation is proportional to a linear parameter, which is 0 when
/// the effect is off. A key (period, time constant, time) changes its form nonlinearly and is
/// searched over `grid`.
struct EffectParameter {
    std::string name;  ///< name in files and JSON, with its unit: "gap_rad"
    std::string unit;
    double typical = 1.0;  ///< linear: expected standard deviation; key: usual value
    int component = -1;    ///< index in a vector parameter of this name; -1: scalar
    std::vector<double> grid =
        {};              ///< key: start values for the search, rising; empty for a linear parameter
    bool refine = true;  ///< a key may take values between those of the grid
    bool usual = true;   ///< false: deviation from the textbook form. Variance explained only by
                         ///< these parameters is reported as unexplained
    std::optional<kinematics::ErrorName> location = {};  ///< the location error that the parameter
                                                         ///< is
    bool mean_line = false;  ///< slope of the mean line of an axis. ISO 230-1 takes straightness
                             ///< from that line, and its slope is squareness
    std::string also_set_by = {};  ///< name in files that sets several parameters to one value
    bool counts_periods = false;   ///< key: a number of periods in a turn, not a length or an angle
    int order = 0;                 ///< of a harmonic of a turn
    bool is_part = false;          ///< 1 where the effect is there, else 0; a fit may lie between
    bool is_positive = false;      ///< below zero there is none: nothing hangs upwards
    double most = std::numeric_limits<double>::infinity();  ///< size that no machine reaches
                                                            ///< (assumed), in its unit
    bool is_key() const { return !grid.empty(); }
    EffectParameter up_to(double size) &&;  ///< the same with this `most`
};

inline EffectParameter EffectParameter::up_to(double size) && {
    most = size;
    return std::move(*this);
}

/// Adds the effect at one reading to `out` (units and frames: kinematics::Perturbation; sign:
/// actual - nominal). `value` in the order of `parameters`, in their units.
using EffectFunction =
    std::function<void(const AxisSample& sample, const emulator::Contact& contact,
                       std::span<const double> value, kinematics::Perturbation& out)>;

/// Which encoder of the axis itself sees an effect (rows of device `axis`).
enum class SeenBy : unsigned char { no_encoder, scale, any_encoder };

struct Effect : EffectIdentity {
    std::string what;    ///< one sentence for the workshop: what it is
    std::string cause;   ///< usual causes
    std::string remedy;  ///< remedy
    std::string formula;
    std::vector<EffectParameter> parameters;
    EffectFunction add;
    SeenBy seen_by = SeenBy::no_encoder;

    std::vector<double> zeros() const;  ///< linear parameters 0, keys at their usual value
};

/// The effect with the given parameter values, in the order of `parameters`.
std::shared_ptr<const emulator::EffectModel> make_model(const Effect& effect,
                                                        std::vector<double> values);

}  // namespace trunnion::effects
