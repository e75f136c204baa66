// One standard deviation of a device's reading.
#pragma once

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::emulator {

struct DeviceNoise {
    double sigma_mm = 0.0;  ///< rad for a row in degrees; never below 1 nm, 1 nrad
    bool given = true;      ///< by the row or by the setup
};

/// The row's `sigma_mm`, else the setup's `noise_um` or `noise_urad` of the device, else what is
/// usual: 1 um for sphere, touch and axis, 0.5 um for ballbar and linear, 10 um for point, 2 urad
/// for angle, 1 urad for a rotary axis's log. The usual ones are *assumed*.
DeviceNoise device_noise(const setup::ModelSettings& model, const records::Reading& row);

}  // namespace trunnion::emulator
