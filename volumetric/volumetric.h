// Error of the tool point over the working volume, and its causes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/finite.h"
#include "emulator/effect_model.h"
#include "setup/setup.h"

namespace trunnion::volumetric {

/// One pose of the grid.
struct VolumetricPoint {
    AxisPositions at;                      ///< mm, rad
    Vector3 tip_W_mm = Vector3::Zero();    ///< nominal
    Vector3 error_W_mm = Vector3::Zero();  ///< physical - nominal
    std::size_t worst = 0;                 ///< index of the cause with the largest contribution
};

/// One error or effect alone. `mm` of a vector is its length.
struct VolumetricCause {
    std::string name;         ///< EX0C, EYX, C.backlash, ...
    Finite largest_mm = 0.0;  ///< over the grid
    Finite rms_mm = 0.0;
    Finite share = 0.0;  ///< part of the sum of squares of all causes
};

struct VolumetricMap {
    std::string machine;     ///< name of the setup
    double length_mm = 0.0;  ///< tool length
    AxisNames names;
    std::vector<Axis> axes;
    std::vector<Axis> assumed;  ///< axes with assumed travel, because the setup gives none
    std::vector<Axis> clamped;  ///< axes beyond a table of their errors, which is constant there
    std::vector<VolumetricPoint> points;
    std::vector<VolumetricCause> causes;  ///< by rms, largest first; points refer to this order
    std::size_t worst = 0;                ///< point with the largest error
    Finite rms_mm = 0.0;
};

struct VolumetricOptions {
    int grid = 5;              ///< points along each linear axis
    int rotary_grid = 5;       ///< angles of each rotary axis
    double length_mm = 150.0;  ///< tool length
    /// Called after each pose; when it returns false the map ends there. Empty: the whole grid.
    std::function<bool(std::size_t done, std::size_t total)> go_on = {};
};

/// Each axis steps through its travel including the limits (+-200 mm and +-180 degrees if the setup
/// gives none). An axis with unlimited rotation steps through one turn, each angle once, including
/// 0. Contributions of single errors come from the Jacobian, those of effects from switching on
/// each one alone.
VolumetricMap volumetric_map(const setup::Setup& setup,
                             const std::vector<std::string>& effect_names,
                             const emulator::EffectModels& effects,
                             const VolumetricOptions& options);

}  // namespace trunnion::volumetric
