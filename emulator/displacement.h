// Readings of laser, autocollimator and the axis's own encoder.
#pragma once

#include "emulator/instruments.h"

namespace trunnion::emulator {

/// `linear`: displacement of the target, seen from the table, along the direction; actual -
/// commanded, mm. The zero of the test is not subtracted (Replay::predict does this).
double linear_mm(const InstrumentView& view);
/// `angle`: rotation of the tool relative to the table about the direction; actual - commanded,
/// rad.
double angle_rad(const InstrumentView& view);
/// `axis`: actual - commanded position of the row's axis by its own encoder, mm or rad: the sum of
/// the effects that an encoder sees, and its zero.
double encoder_mm(const InstrumentView& view);

/// Fills the contact of a `linear` or `angle` row: the tool pose in the declared control.
void aim_at_displacement(const setup::Setup& setup, const records::Reading& row, Contact& contact);
/// Fills the contact of an `axis` row. Throws InputError without position when the machine does not
/// have the axis named by the row's feature.
void aim_at_encoder(const setup::Setup& setup, const records::Reading& row, Contact& contact);

}  // namespace trunnion::emulator
