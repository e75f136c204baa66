// Standard deviation of a device's reading.
#pragma once

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::emulator {

struct DeviceNoise {
    double sigma_mm = 0.0;  ///< rad for a row in degrees; at least 1 nm or 1 nrad
    bool given = true;      ///< given by the row or by the setup
};

/// Standard deviation of a row: its `sigma_mm`, else `noise_um` or `noise_urad` of the device in
/// the setup, else the default (*assumed*): 1 um for sphere, touch and axis, 0.5 um for ballbar and
/// linear, 10 um for point, 2 urad for angle, 1 urad for the log of a rotary axis.
DeviceNoise device_noise(const setup::ModelSettings& model, const records::Reading& row);

}  // namespace trunnion::emulator
