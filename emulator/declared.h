// Readings of points that were imported with another declared geometry than that of the setup.
#pragma once

#include <string>

#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// "chain, target S1": what the head lines `declared ..` of the table have otherwise than the
/// setup; empty if nothing, or without such lines.
std::string declared_otherwise(const setup::Setup& setup, const records::ReadingTable& table);
/// Throws InputError for such readings: their values are differences from positions that are no
/// longer declared.
void refuse_declared_otherwise(const setup::Setup& setup, const records::ReadingTable& table);
/// The values of the table are now those beside the positions that the setup declares.
void declare_anew(const setup::Setup& setup, records::ReadingTable& table);

}  // namespace trunnion::emulator
