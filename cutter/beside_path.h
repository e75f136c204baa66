// The compensated point on its way beside the contour.
#pragma once

#include "cutter/held_moves.h"

namespace trunnion::cutter {

/// Parameters of cutter compensation.
struct CutterSettings {
    bool startup_type_b = false;    ///< 5003#0 SUP: outside corners of start-up and cancel
    bool startup_type_c = false;    ///< 5003#1 SUV: G41, G40 alone in a block shift the tool
    bool circular_corners = false;  ///< 19607#2 CCC (assumed): outside corners by an arc
    int blocks_ahead = 3;           ///< 19625 (assumed; absent: 3): read ahead under G41, G42
};

/// Points at the cutter's offset square to the end or start of a move, mm in the plane.
PlanePoint square_to_end(const PathMove& m);
PlanePoint square_to_start(const PathMove& m);

struct BesidePath {
    explicit BesidePath(PathReceiver& receiver) : held(receiver) {}

    CutterSettings settings;
    offsets::ControlPosition tool;  ///< program coordinates of the compensated point
    double last_offset_mm = 0.0;    ///< offset of the move before the one that waits
    HeldMoves held;

    /// The compensated point in the plane of a move.
    PlanePoint tool_in_plane(const PathMove& m) const {
        return {tool[m.axes.first], tool[m.axes.second]};
    }
    /// A way of the compensated point in the plane; other axes go to those of `m.to`.
    void send(const PathMove& m, const PlaneElement& way, bool beside);
    /// A straight way to `end` with the feed of `m`.
    void line_to(const PathMove& m, PlanePoint end);
    /// The move itself beside its path, from where the tool stands to `end`. PS0034 for an arc that
    /// starts or ends compensation, PS0038 and PS0041 when the cutter does not fit.
    void run_beside(const PathMove& m, PlanePoint end);
};

/// PS0038, PS0041 when an arc is smaller than the cutter: it has no path beside it.
void check_radius(const PathMove& m);

}  // namespace trunnion::cutter
