// Positions of an axis at which readings tell its own error.
#pragma once

#include <vector>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// The least and the greatest position of an axis, mm or rad.
struct Range {
    double low = 0.0, high = 0.0;
    double span() const { return high - low; }
};
/// Among all device rows.
Range range_of(const Prepared& prepared, Axis axis);

/// Squared derivatives of the readings at one position by a displacement of the axis there, divided
/// by their variances.
struct Place {
    double position = 0.0, weight = 0.0;  ///< mm or rad; 1 / mm^2 or 1 / rad^2
};

/// True for each device row that tells how the error of an axis differs from place to place: it
/// answers a displacement of a linear axis by a tenth of it at least (of a rotary axis at all: the
/// arm may be short), and what is free beside it (the zero of a laser test, an artefact, the pose
/// of an instrument) was read with the axis at two positions or more. While other axes are measured
/// this one stands anywhere, and its error is not seen.
std::vector<bool> tells_place(const Prepared& prepared, Axis axis);

/// True for each device row whose free zero was read with the axis at two positions or more: where
/// it rests in a test of another axis is no place of its error.
std::vector<bool> sees_moves(const Prepared& prepared, Axis axis);

/// The positions of the readings that tell, rising.
std::vector<Place> telling_places(const Prepared& prepared, Axis axis);
/// The same as positions alone.
std::vector<double> positions_at(const std::vector<Place>& places);

/// Number of equally weighted places with the same scatter of a mean (Kish): some places that tell
/// nearly nothing beside others hardly count.
double effective_count(const std::vector<Place>& places);

}  // namespace trunnion::diagnosis
