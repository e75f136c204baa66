// What laser, autocollimator and a servo's own encoder read.
#pragma once

#include "emulator/instruments.h"

namespace trunnion::emulator {

/// `linear`: displacement of the target along the direction as seen from the table, actual -
/// commanded, mm. The zero of its test is not taken off (Replay::predict does).
double linear_mm(const InstrumentView& view);
/// `angle`: rotation of the tool against the table about the direction, actual - commanded, rad.
double angle_rad(const InstrumentView& view);
/// `axis`: actual - commanded position of the row's axis by its own encoder, mm or rad: what the
/// effects that an encoder sees add to it.
double encoder_mm(const InstrumentView& view);

/// Fills the contact of a `linear` or `angle` row: where the declared control puts the tool.
void aim_at_displacement(const setup::Setup& setup, const records::Reading& row, Contact& contact);
/// Fills the contact of an `axis` row. Throws InputError without a place when the machine has no
/// axis of the row's feature.
void aim_at_encoder(const setup::Setup& setup, const records::Reading& row, Contact& contact);

}  // namespace trunnion::emulator
