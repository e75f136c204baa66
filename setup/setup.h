// Belief + machine + devices + artefacts: one copyable value, from a TOML file.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "controller/builder_profile.h"
#include "controller/clamp.h"
#include "controller/hurco_choices.h"
#include "geometry/axes.h"
#include "geometry/pose.h"
#include "interpreter/dialect.h"
#include "kinematics/machine.h"
#include "offsets/stores.h"
#include "positioning/tcp_frame.h"
#include "setup/body.h"
#include "setup/physical_tool.h"

namespace trunnion::setup {

/// Where the ball of a longer stylus or cup was found beside its place straight below, by length
/// of the extension (readings column extension_mm), in S.
using ExtensionErrors = std::map<double, Vector3>;

struct ProbeSettings {
    int tool = 0;                            ///< control tool it is called as, 0 = any
    Vector3 tip_S_mm = Vector3(0, 0, -150);  ///< physical stylus ball centre in S
    double ball_diameter_mm = 6.0;
    double repeatability_um = 0.0;
    ExtensionErrors extension_errors;
    Vector3 tip_with(double extension_mm) const;  ///< stylus ball centre with a longer stylus
};

struct BallbarSettings {
    Vector3 cup_S_mm = Vector3(0, 0, -120);  ///< physical tool-cup ball centre in S
    double length_mm = 100.0;                ///< ball to ball at 20 degrees
    double expansion_per_k = 0.0;            ///< of the bar
    double temperature_c = 20.0;             ///< of the bar, physical
    double read_temperature_c = 20.0;        ///< what the operator's thermometer said
    double noise_um = 0.0;
    double sample_hz = 1000.0;
    double sample_deg = 0.0;  ///< above 0: sampled by swept angle instead of time
    bool free_cup = false;
    bool free_length = false;
    ExtensionErrors extension_errors;
    Vector3 cup_with(double extension_mm) const;  ///< cup ball centre with a longer cup

    double length_at_mm(double celsius) const {
        return length_mm * (1.0 + expansion_per_k * (celsius - 20.0));
    }
    /// Of the bar as it is: readings count from here.
    double warm_length_mm() const { return length_at_mm(temperature_c); }
};

struct Artefact {
    enum class Kind : unsigned char { sphere, center_pivot, target };
    std::string name;
    Kind kind = Kind::sphere;
    Vector3 center_W_mm = Vector3::Zero();
    /// Of a target that the tool carries, in S (of an arm without X, Y, Z: from the last axis's
    /// point_mm, along M's axes at zero); a target without it stands on the table at center_W_mm.
    std::optional<Vector3> tool_S_mm;
    /// Of a target: found so far beside the declared place, which readings count from.
    Vector3 found_mm = Vector3::Zero();
    double diameter_mm = 25.4;
    bool free_center = false;
    bool free_tool = false;
};

/// A tracker, CMM or the like that reads points (`point` rows): p_I = pose_IM * p_M.
struct Instrument {
    std::string name;
    bool sees_table = false;  ///< frame = "W": reads points of the work, later, in W instead of M
    Vector3 origin_mm = Vector3::Zero();     ///< of M, in the instrument's frame
    Vector3 rotation_deg = Vector3::Zero();  ///< of M, about the instrument's fixed X, then Y, Z
    bool free_pose = false;                  ///< six small numbers left of the pose, each session
    bool free_scale = false;                 ///< a factor on what it reads, each session
    /// Found: the instrument reads shift + exp([tilt]x) (1 + scale_error) pose_IM p_M.
    SmallMotion pose_error;
    double scale_error = 0.0;
    Pose pose_IM() const;
    Vector3 read_mm(const Vector3& p_M_mm) const;  ///< what it reads of a point
};

/// One entry of [effects]: name and parameters as in formats.md; a parameter may be a vector.
struct EffectSetting {
    std::string name;
    std::map<std::string, std::vector<double>> parameters;
};

struct CalibrationPrior {
    double value = 0.0;  ///< mm or rad
    double sigma = 0.0;
};

/// [model]: what identification and diagnosis know beforehand.
struct ModelSettings {
    std::vector<std::string> modelled = {"location"};
    std::map<std::string, double> noise_um;               ///< by device name, of rows in mm
    std::map<std::string, double> noise_urad;             ///< the same of rows in degrees
    std::map<std::string, CalibrationPrior> calibration;  ///< by ISO 230 name
    bool allow_large =
        false;  ///< --allow-large: residuals that no machine has are told, not refused
};

/// +1 for every axis.
constexpr AxisSides came_travelling_plus() {
    AxisSides sides{};
    sides.fill(1);
    return sides;
}

/// Where a rotary axis of a Hurco's part set-up crosses the plane across it: two of X, Y, Z, mm.
using Centreline = std::array<std::optional<double>, 3>;

/// [[session]]: what was found of the set-up on one day, in place of what stands elsewhere.
struct SessionValues {
    std::string name;                      ///< readings column session
    std::map<std::string, double> values;  ///< by quantity as identify names it: "CMM.a_rad"
};

struct Setup {
    std::string name;
    std::string path;  ///< of the file, for messages
    std::string chain_text;
    kinematics::Machine machine;
    /// [machine] auxiliary: axes that carry neither work nor tool (pallet, tailstock). NC words
    /// move them and their limits hold; no kinematics, no errors, no readings.
    std::vector<kinematics::AxisGeometry> auxiliary;
    AxisSides side_before = came_travelling_plus();  ///< [machine] side: before the first move
    std::array<bool, axis_count> scale_encoder{};  ///< encoder = "scale": reads behind the backlash
    std::vector<EffectSetting> effects;            ///< backlash and pretravel keys too
    interpreter::Dialect dialect;
    positioning::TcpFrame tcp_frame =
        positioning::TcpFrame::start;           ///< [control] tcp_frame = "start" or "rotary_zero"
    bool work_positions_with_length = true;     ///< #5041.. and #5061.. include the tool length
    bool g89_feeds_to_initial = true;           ///< G89 under G98 feeds out all the way
    std::vector<controller::ClampCode> clamps;  ///< [control.clamps]
    std::vector<int> block_skip;                ///< [control] block_skip: switches 1-9 that are on
    bool optional_stop = false;                 ///< [control] optional_stop: M01 stops
    bool threading = false;                     ///< [control] threading: the control has G33
    controller::BuilderProfile builder;         ///< [control.builder]
    controller::HurcoChoices hurco;             ///< [control.hurco]
    std::map<Axis, Centreline> centrelines;     ///< [control.hurco] centreline: of the part set-up
    offsets::Stores stores;
    std::optional<ProbeSettings> probe;
    std::optional<BallbarSettings> ballbar;
    std::vector<Artefact> artefacts;
    std::vector<Body> bodies;  ///< that G31 meets beside the spheres
    PhysicalTools tools;       ///< [tools]: as they are, whatever the offsets say
    std::vector<Instrument> instruments;
    ModelSettings model;
    std::vector<SessionValues> sessions;
    /// Zero of each test of a laser or autocollimator, mm or rad, as a fit found it (ZeroGroup of
    /// the replay); it belongs to the readings and is not written.
    std::vector<double> zeros;

    const Artefact* find_artefact(const std::string& name) const;
    const Instrument* find_instrument(const std::string& name) const;
    const SessionValues* find_session(const std::string& name) const;
    /// With the values of that session in their places; without a [[session]] of the name as it is.
    Setup in_session(const std::string& name) const;
    /// A target that the tool carries, in S.
    Vector3 target_S_mm(const Artefact& target) const;
};

/// Fills the stores from the backup folder that [control] names, before the file's own keys
/// override them. The backup room stands beside this one, so the command that loads the setup hands
/// it in.
using BackupReader = std::function<void(const std::string& folder, offsets::Stores& stores)>;

/// Reads a setup file; throws InputError with line, column and the line's text. `notes` gets one
/// line for each value that was derived (19680-19714) or key that is not known. A `backup` key
/// without a reader is an error.
Setup load_setup(const std::string& path, std::vector<std::string>& notes,
                 const BackupReader& backup = {});
Setup parse_setup(const std::string& text, const std::string& path, std::vector<std::string>& notes,
                  const BackupReader& backup = {});
/// The setup as TOML that loads again to the same value.
std::string format_setup(const Setup& setup);

/// 19680-19714 (and 19666, 19741-19744) as they would be if the control were told the truth about
/// this machine. Numbers that `parameters` already has stay. Returns why they cannot be derived
/// (not two rotary axes, a linear axis carried by a rotary one, an axis line in no coordinate
/// plane), and then leaves all as it was; empty when done.
std::string derive_pivot_parameters(const kinematics::Machine& machine,
                                    offsets::Parameters& parameters);
/// 1022 of machines with U, V or W: 5, 6, 7 for one that moves the tool as X, Y, Z do, 0 for one
/// that runs otherwise or that a rotary axis carries; returns the letters of those. Nothing when
/// 1022 is present already.
std::string derive_parallel_axes(const kinematics::Machine& machine,
                                 offsets::Parameters& parameters);
/// G54.2 groups 7580-7588 of the machine's table axes, the one nearest the work first. Nothing when
/// any of them is present already, or when a table axis is inclined (no group can say that).
void derive_fixture_groups(const kinematics::Machine& machine, offsets::Parameters& parameters);

}  // namespace trunnion::setup
