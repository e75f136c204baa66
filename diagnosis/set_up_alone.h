// What is written where no cause is: the fitted set-up.
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// The set-up fitted by least squares to calibrated values and to all readings but lone ones: those
/// that only a model which is not written sets aside belong to the gap. Where nothing but zeros was
/// found, what was set aside is spoiled.
setup::Setup set_up_alone(const Outcome& f);

}  // namespace trunnion::diagnosis
