// What effects with keys explain beside the base: the goal of every search for keys.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/projection.h"
#include "identification/base_model.h"

namespace trunnion::identification {

/// An effect with keys in a fit. `values` in the order of its parameters.
struct KeyedEffect {
    const effects::Effect* effect = nullptr;
    std::vector<double> values;
    std::vector<std::size_t> free;  ///< keys that may lie between grid values
};

/// Fall of the weighted squared sum of `left_mm` (no unit: rows over their sigma) when effects at
/// given keys join the base in the fit; their other parameters have any value. What `replay` and
/// `base` hold must outlive it.
class KeyGain {
  public:
    KeyGain(const emulator::Replay& replay, const BaseModel& base, const Eigen::VectorXd& left_mm);

    /// Keys stand in the `values`; other values there count for nothing.
    double operator()(const std::vector<KeyedEffect>& effects) const;
    double operator()(const effects::Effect& effect, const std::vector<double>& values) const {
        return (*this)({{&effect, values, {}}});
    }

  private:
    const emulator::Replay& replay_;
    const BaseModel& base_;
    Eigen::VectorXd weight_, left_;
    estimation::Projection known_;
};

}  // namespace trunnion::identification
