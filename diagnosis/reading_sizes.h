// Sizes of noise, gap and shrink on the readings, um.
#pragma once

#include <optional>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Noise of each device row, mm.
Eigen::VectorXd noise_mm(const Outcome& found);

/// Rms over the readings that were not set aside, um (urad where all readings are angles).
double rms_um(const Outcome& found, const Eigen::VectorXd& left_mm);

/// Shrink from left-out whitened residuals, converted to um of the readings.
HeldOut held_out(const Outcome& found, const Eigen::VectorXd& before, const Eigen::VectorXd& after);

/// Number of readings that were set aside.
std::size_t set_aside(const Outcome& found);

/// What the rows of the devices state, and what was found to add to it.
std::vector<AddedNoise> added_noise(const Outcome& f);

/// Rms of the noise that is stated, um, where the readings were taken to have another one.
std::optional<double> other_stated_um(const Outcome& f);

}  // namespace trunnion::diagnosis
