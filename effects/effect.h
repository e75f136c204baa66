// An effect: a named way in which the real machine may differ from its simulation.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emulator/instruments.h"

namespace trunnion::effects {

/// One scalar of an effect. A linear parameter enters the perturbation proportionally and is 0 when
/// the effect is off; a key (pitch, time constant, moment) shapes it and is searched over `grid`.
struct EffectParameter {
    std::string name;  ///< as in files and JSON, with its unit: "gap_rad"
    std::string unit;
    double typical = 1.0;  ///< linear: standard deviation expected in the trade; key: usual value
    int component = -1;    ///< 0.. of a vector parameter of this name
    std::vector<double> grid =
        {};              ///< a key: values to try first, rising; empty for a linear parameter
    bool refine = true;  ///< a key may lie between grid values
    bool usual = true;   ///< false: lets the form deviate from the textbook's; what only such
                         ///< parameters explain counts as not explained
    std::optional<kinematics::ErrorName> location = {};  ///< the location error that this is
    bool is_key() const { return !grid.empty(); }
};

/// Adds what the effect does at one reading; `value` in the order of `parameters`.
using EffectFunction =
    std::function<void(const AxisSample& sample, const emulator::Contact& contact,
                       std::span<const double> value, kinematics::Perturbation& out)>;

/// Which encoder of the axis itself sees an effect (rows of device `axis`).
enum class SeenBy : unsigned char { no_encoder, scale, any_encoder };

struct Effect {
    std::string name;    ///< as in formats.md: "C.backlash"
    std::string what;    ///< one sentence for the shop: what it is
    std::string cause;   ///< what usually causes it
    std::string remedy;  ///< what to do
    std::string formula;
    std::vector<EffectParameter> parameters;
    EffectFunction add;
    SeenBy seen_by = SeenBy::no_encoder;

    std::vector<double> zeros() const;  ///< every linear parameter 0, keys at their usual value
};

/// The effect switched on with values for all its parameters.
std::shared_ptr<const emulator::EffectModel> make_model(const Effect& effect,
                                                        std::vector<double> values);

}  // namespace trunnion::effects
