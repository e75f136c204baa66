// The compensated point on its path beside the contour.
#pragma once

#include "cutter/held_moves.h"

namespace trunnion::cutter {

/// Parameters of cutter compensation.
struct CutterSettings {
    bool startup_type_b = false;    ///< 5003#0 SUP: outside corners at start-up and cancel
    bool startup_type_c = false;    ///< 5003#1 SUV: G41 or G40 alone in a block shifts the tool
    bool circular_corners = false;  ///< 19607#2 CCC (assumed): outside corners are rounded by arcs
    int blocks_ahead = 3;           ///< 19625 (assumed; 3 if absent): look-ahead blocks under G41,
                                    ///< G42
};

/// Points at the cutter offset perpendicular to the end or the start of a move, mm in the plane.
PlanePoint square_to_end(const PathMove& m);
PlanePoint square_to_start(const PathMove& m);

struct BesidePath {
    explicit BesidePath(PathReceiver& receiver) : held(receiver) {}

    CutterSettings settings;
    offsets::ControlPosition tool;  ///< program coordinates of the compensated point
    double last_offset_mm = 0.0;    ///< offset of the move before the buffered one
    HeldMoves held;

    /// The compensated point in the plane of `m`.
    PlanePoint tool_in_plane(const PathMove& m) const {
        return {tool[m.axes.first], tool[m.axes.second]};
    }
    /// Sends a path of the compensated point in the plane; other axes move to those of `m.to`.
    void send(const PathMove& m, const PlaneElement& way, bool beside);
    /// A straight path to `end` with the feed of `m`.
    void line_to(const PathMove& m, PlanePoint end);
    /// The move itself beside its path, from the present tool position to `end`. PS0034 for an arc
    /// that starts or ends compensation; PS0038 and PS0041 when the cutter does not fit.
    void run_beside(const PathMove& m, PlanePoint end);
};

/// PS0038, PS0041 when an arc is smaller than the cutter, so that it has no offset path.
void check_radius(const PathMove& m);

}  // namespace trunnion::cutter
