// All coordinate stages, the believed five-axis geometry, and the resulting positions.
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

/// The rotary axes according to the parameters.
struct BelievedGeometry {
    std::optional<positioning::RotaryTransform> transform;  ///< empty: 19680 = 0, or `fault`
    std::optional<Alarm> fault;  ///< error of the parameters, thrown on use
    ParallelAxes parallel;       ///< U V W parallel to X Y Z
    std::optional<positioning::FixtureSettings> fixture;  ///< decoded at the first use of G54.2
};

/// The active tool length, from tip to gauge point.
struct ToolVector {
    Vector3 vector_mm = Vector3::Zero();  ///< rotary axes at zero
    int number = 0;                       ///< H, 0: none
};

/// An active tilted working plane.
struct TiltedPlaneState {
    Pose pose_PF;                ///< feature frame seen from the work frame (table frame, G54 etc.)
    int nesting = 1;             ///< 1 for G68.2, plus the number of G68.4 on top of it
    std::vector<Pose> below_PF;  ///< Hurco: the planes below this one, outermost first
    AxisPositions latched;       ///< axis positions when the frame was placed in the machine
};

/// Tool centre point control.
struct TipControl {
    std::optional<motion::ToolCentrePoint> in_force;  ///< G43.4, G43.5, M128
    std::optional<motion::ToolCentrePoint>
        starting;                     ///< becomes active at the end of the start-up block
    bool by_vector = false;           ///< G43.5: I J K instead of rotary words
    double lean_rad = 0.0;            ///< Q of G43.5
    bool by_angle_or_vector = false;  ///< M128: rotary words or I J K, whichever the block has
    bool along_line = false;          ///< Hurco's G43.4 was given: the tip keeps to its programmed
                                      ///< path
    /// G43.4 was alone in its block and its frame differs from the previous one: the programmed
    /// position is kept, and the next move starts at the actual tip position.
    bool keeps_program = false;
};

bool same_rotaries(const AxisPositions& a, const AxisPositions& b);

/// A subject that changes a stage must then call Mover::frames_changed(). Positions are mm and deg;
/// `axes` are the driven positions, mm and rad.
class Frames {
  public:
    explicit Frames(offsets::Stores& stores) : stores_(stores) {}

    Coordinates stages;
    offsets::ControlPosition program;  ///< present position: program coordinates of the tip
    offsets::ControlPosition machine;  ///< the same point in machine coordinates of the gauge point
    AxisPositions axes;                ///< the same as axis positions
    BelievedGeometry believed;
    ToolVector tool;
    std::optional<TiltedPlaneState> plane;
    TipControl tip;
    int fixture_number = 0;      ///< P of the active G54.2, 0: none
    bool length_parked = false;  ///< G28, G30, G53 removed the tool length until the axis moves
                                 ///< again
    bool length_moves = false;   ///< G43, G49 without axis words: the axis moves by the change of
                                 ///< length

    offsets::Stores& stores() { return stores_; }
    const offsets::Stores& stores() const { return stores_; }

    /// After a change of parameters: decodes 1022, 7580-7588 and 19680-19714 again.
    void parameters_changed(const ControlSettings& settings);
    /// The believed kinematics. Throws PS5459 when the parameters are invalid, alarm `otherwise`
    /// when there are none (19680 = 0).
    const positioning::RotaryTransform& transform(int otherwise) const;
    /// Travel of the rotary axes: the narrower of stored stroke and 19741-19744.
    positioning::RotaryTravel rotary_travel(const ControlSettings& settings) const;

    /// Compiles the stages and derives the program position again from the axis positions.
    void recompute();
    /// The program position of a machine position in the present state.
    offsets::ControlPosition program_at(const offsets::ControlPosition& machine_position) const;
    /// Reads the active work offset and the external offset from the stores.
    void take_work_offset(const Modal& modal);
    void stand_at(const offsets::ControlPosition& machine_position);

    /// True when G43.4, G54.2 or G68.2 is active.
    bool follows_rotaries() const { return tip.in_force || plane || fixture_number != 0; }
    /// The positioning function under which moves are sent.
    PositioningMode mode(const ControlSettings& settings) const;

    /// Origin of the work frame in M without tilted plane, mm.
    Vector3 origin_of_work() const;
    /// Places the feature frame in the machine for the present rotary positions.
    void place_plane();
    /// Tool length vector of the stages: in a tilted plane along the actual tool direction,
    /// including the displacement of a rotary head; otherwise `plain`.
    offsets::ControlPosition staged_length(offsets::ControlPosition plain) const;
    /// The tool length as shown by #5081..: without that displacement.
    offsets::ControlPosition shown_length() const;

    /// The settings of G54.2 from the parameters; PS5459 when they are invalid.
    const positioning::FixtureSettings& fixture_settings(const ControlSettings& settings);
    /// Computes the G54.2 vector for the rotary positions of `machine_position`; true when it
    /// changed.
    bool turn_fixture(const ControlSettings& settings,
                      const offsets::ControlPosition& machine_position);
    /// Sets the vector for the end of a move to `target` before the move (7570#0 = 1: only after
    /// the block; assumed).
    void follow_fixture(const ControlSettings& settings, const offsets::ControlPosition& target);

  private:
    offsets::Stores& stores_;
};

}  // namespace trunnion::controller
