// Heights over one surface, which are machine and surface together (measured_surface.cpp).
#pragma once

#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Name of a rival: the measured surface is not what the drawing says.
inline constexpr const char* form_of_surface = "artefact.form";

/// Where all readings are points in one direction over one surface (a bed mesh, a straightedge, a
/// surface plate) that was clamped once, its own form makes the readings of a straightness or of
/// angles of the axes along it: these are as likely as the form at most, which is their rival. The
/// surface turned or shifted, as another session, would tell.
void doubt_measured_surface(const Outcome& found, std::vector<Claim>& claims);

/// Says so of the causes that have this rival.
void tell_measured_surface(const Outcome& found, std::vector<Cause>& causes);

}  // namespace trunnion::diagnosis
