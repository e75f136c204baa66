// Gain of effects with keys beside the base: the objective of every key search.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimation/projection.h"
#include "identification/base_model.h"

namespace trunnion::identification {

/// An effect with keys in a fit; `values` in the order of its parameters.
struct KeyedEffect {
    const effects::Effect* effect = nullptr;
    std::vector<double> values;
    std::vector<std::size_t> free;  ///< keys that may take values between those of the grid
};

/// Reduction of the weighted squared sum of `left_mm` (dimensionless: rows divided by their sigma)
/// when effects with given keys are added to the base in the fit, with free values of their other
/// parameters. `beside_mm`: further columns that are fitted with the base, or none. `replay` and
/// `base` must outlive it.
class KeyGain {
  public:
    KeyGain(const emulator::Replay& replay, const BaseModel& base, const Eigen::VectorXd& left_mm,
            const Eigen::MatrixXd& beside_mm = {});

    const emulator::Replay& replay() const { return replay_; }

    /// Uses the keys in `values`; other values are ignored.
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
