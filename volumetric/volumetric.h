// Where in the working volume the tool point is off, and by which error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "emulator/effect_model.h"
#include "setup/setup.h"

namespace trunnion::volumetric {

/// One pose of the grid.
struct VolumetricPoint {
    AxisPositions at;                      ///< mm, rad
    Vector3 tip_W_mm = Vector3::Zero();    ///< nominal
    Vector3 error_W_mm = Vector3::Zero();  ///< physical - nominal
    std::size_t worst = 0;                 ///< index of the cause that contributes most
};

/// One error or effect, alone. `mm` of a vector is its length.
struct VolumetricCause {
    std::string name;         ///< EX0C, EYX, C.backlash, ...
    double largest_mm = 0.0;  ///< over the grid
    double rms_mm = 0.0;
    double share = 0.0;  ///< part of the sum of squares of all causes
};

struct VolumetricMap {
    std::string machine;     ///< name of the setup
    double length_mm = 0.0;  ///< tool
    AxisNames names;
    std::vector<Axis> axes;
    std::vector<Axis> assumed;  ///< their travel: the setup gives none
    std::vector<Axis> clamped;  ///< they run beyond a table of their errors, held constant there
    std::vector<VolumetricPoint> points;
    std::vector<VolumetricCause> causes;  ///< largest rms first; points refer to this order
    std::size_t worst = 0;                ///< point with the largest error
    double rms_mm = 0.0;
};

struct VolumetricOptions {
    int grid = 5;              ///< points along each linear axis
    int rotary_grid = 5;       ///< angles of each rotary axis
    double length_mm = 150.0;  ///< tool
    /// Asked after each pose; false: the map ends there. Empty: the whole grid.
    std::function<bool(std::size_t done, std::size_t total)> go_on = {};
};

/// Each axis steps through its limits, ends included (+-200 mm and +-180 degrees where the setup
/// gives none). An axis that can turn round steps through one turn instead, each angle once, 0
/// among them. Errors one by one come from the Jacobian, effects from switching them on alone.
VolumetricMap volumetric_map(const setup::Setup& setup,
                             const std::vector<std::string>& effect_names,
                             const emulator::EffectModels& effects,
                             const VolumetricOptions& options);

}  // namespace trunnion::volumetric
