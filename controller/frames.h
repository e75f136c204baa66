// All coordinate stages, the believed five-axis geometry, and the positions that they give.
#pragma once

#include <optional>
#include <vector>

#include "base/alarm.h"
#include "controller/coordinates.h"
#include "controller/modal.h"
#include "motion/tool_centre_point.h"
#include "positioning/fixture_offset.h"
#include "positioning/rotary_choice.h"
#include "positioning/rotary_transform.h"

namespace trunnion::controller {

/// What parameters say about the rotary axes.
struct BelievedGeometry {
    std::optional<positioning::RotaryTransform> transform;  ///< nothing: 19680 = 0, or `fault`
    std::optional<Alarm> fault;  ///< what is wrong with the parameters, thrown on use
    ParallelAxes parallel;       ///< U V W beside X Y Z
    std::optional<positioning::FixtureSettings> fixture;  ///< decoded when G54.2 is first used
};

/// The tool length in force, tip to gauge point.
struct ToolVector {
    Vector3 vector_mm = Vector3::Zero();  ///< with the rotaries at zero
    int number = 0;                       ///< H, 0: none
};

/// A tilted working plane in force.
struct TiltedPlaneState {
    Pose pose_PF;     ///< feature frame seen from the work frame (table frame, G54 and so on)
    int nesting = 1;  ///< G68.2, and how many G68.4 on top
    std::vector<Pose> below_PF;  ///< Hurco: the planes that this one stands on, the first one first
    AxisPositions latched;       ///< where the axes stood when the frame was laid into the machine
};

/// Tool centre point control.
struct TipControl {
    std::optional<motion::ToolCentrePoint> in_force;  ///< G43.4, G43.5, M128
    std::optional<motion::ToolCentrePoint>
        starting;                     ///< takes over at the end of the start-up block
    bool by_vector = false;           ///< G43.5: I J K instead of rotary words
    double lean_rad = 0.0;            ///< Q of G43.5
    bool by_angle_or_vector = false;  ///< M128: rotary words or I J K, as the block has them
    bool along_line = false;          ///< Hurco's G43.4 was given: the tip keeps to its way
    /// G43.4 had a block of its own in a frame that differs from the one before: the programmed
    /// position stands, and the next move goes there from where the tip is.
    bool keeps_program = false;
};

bool same_rotaries(const AxisPositions& a, const AxisPositions& b);

/// A subject that changes a stage calls Mover::frames_changed() after it. Positions are mm and deg;
/// `axes` is what was driven, mm and rad.
class Frames {
  public:
    explicit Frames(offsets::Stores& stores) : stores_(stores) {}

    Coordinates stages;
    offsets::ControlPosition program;  ///< where the control stands: program coordinates of the tip
    offsets::ControlPosition machine;  ///< the same point as machine coordinates of the gauge point
    AxisPositions axes;                ///< the same at the door
    BelievedGeometry believed;
    ToolVector tool;
    std::optional<TiltedPlaneState> plane;
    TipControl tip;
    int fixture_number = 0;      ///< P of G54.2 in force, 0: none
    bool length_parked = false;  ///< G28, G30, G53 left the length out until the axis moves again
    bool length_moves = false;   ///< G43, G49 without axis words: the axis moves by the offset

    offsets::Stores& stores() { return stores_; }
    const offsets::Stores& stores() const { return stores_; }

    /// After parameters changed: 1022, 7580-7588 and 19680-19714 anew.
    void parameters_changed(const ControlSettings& settings);
    /// The believed kinematics; throws PS5459 when the parameters are wrong, `otherwise` when there
    /// are none (19680 = 0).
    const positioning::RotaryTransform& transform(int otherwise) const;
    /// Where the rotaries may go: stored strokes and 19741-19744, whichever is narrower.
    positioning::RotaryTravel rotary_travel(const ControlSettings& settings) const;

    /// Compiles the stages and derives the program position of the place of the axes anew.
    void recompute();
    /// The program position of a place of the axes, by all that is in force.
    offsets::ControlPosition program_at(const offsets::ControlPosition& machine_position) const;
    /// Takes the active work offset and the external one from the stores.
    void take_work_offset(const Modal& modal);
    void stand_at(const offsets::ControlPosition& machine_position);

    /// Any of G43.4, G54.2, G68.2 follows the rotaries or leads the tip.
    bool follows_rotaries() const { return tip.in_force || plane || fixture_number != 0; }
    /// The positioning function under which moves go out.
    PositioningMode mode(const ControlSettings& settings) const;

    /// Zero of the work frame in M, without tilted plane, mm.
    Vector3 origin_of_work() const;
    /// Lays the feature frame into the machine as the rotaries stand now.
    void place_plane();
    /// Tool length vector of the stages: in a tilted plane along the tool as it stands, with the
    /// swing of a rotary head; otherwise `plain`.
    offsets::ControlPosition staged_length(offsets::ControlPosition plain) const;
    /// The tool length as #5081.. show it: without that swing.
    offsets::ControlPosition shown_length() const;

    /// G54.2 as parameters say; PS5459 when they are wrong.
    const positioning::FixtureSettings& fixture_settings(const ControlSettings& settings);
    /// The G54.2 vector with the rotaries where `machine_position` says; true when it changed.
    bool turn_fixture(const ControlSettings& settings,
                      const offsets::ControlPosition& machine_position);
    /// The vector as the end of a move to `target` needs it, before the move (7570#0 = 1: only
    /// after the block; assumed).
    void follow_fixture(const ControlSettings& settings, const offsets::ControlPosition& target);

  private:
    offsets::Stores& stores_;
};

}  // namespace trunnion::controller
