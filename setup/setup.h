// Belief + machine + devices + artefacts: one copyable value, read from a TOML file.
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
#include "controller/variable_rounding.h"
#include "geometry/axes.h"
#include "geometry/pose.h"
#include "interpreter/dialect.h"
#include "kinematics/machine.h"
#include "offsets/stores.h"
#include "positioning/tcp_frame.h"
#include "setup/body.h"
#include "setup/physical_tool.h"

namespace trunnion::setup {

/// Position of the ball of a longer stylus or cup relative to the position straight below, by
/// length of the extension (readings column extension_mm), in S, mm.
using ExtensionErrors = std::map<double, Vector3>;

struct ProbeSettings {
    int tool = 0;                            ///< tool number in the control, 0 = any
    Vector3 tip_S_mm = Vector3(0, 0, -150);  ///< physical stylus ball centre in S
    double ball_diameter_mm = 6.0;
    double repeatability_um = 0.0;
    ExtensionErrors extension_errors;
    Vector3 tip_with(double extension_mm) const;  ///< stylus ball centre with an extension
};

struct BallbarSettings {
    Vector3 cup_S_mm = Vector3(0, 0, -120);  ///< physical tool-cup ball centre in S
    double length_mm = 100.0;                ///< ball to ball at 20 deg C
    double expansion_per_k = 0.0;            ///< of the bar, 1/K
    double temperature_c = 20.0;             ///< actual temperature of the bar
    double read_temperature_c = 20.0;        ///< temperature that the operator read
    double noise_um = 0.0;
    double sample_hz = 1000.0;
    double sample_deg = 0.0;  ///< > 0: sampled by swept angle instead of time
    bool free_cup = false;
    bool free_length = false;
    ExtensionErrors extension_errors;
    Vector3 cup_with(double extension_mm) const;  ///< cup ball centre with an extension

    double length_at_mm(double celsius) const {
        return length_mm * (1.0 + expansion_per_k * (celsius - 20.0));
    }
    /// Length of the bar at its actual temperature, the zero of its readings.
    double warm_length_mm() const { return length_at_mm(temperature_c); }
};

struct Artefact {
    enum class Kind : unsigned char { sphere, center_pivot, target };
    std::string name;
    Kind kind = Kind::sphere;
    Vector3 center_W_mm = Vector3::Zero();
    /// Target on the tool: position in S (arm without X, Y, Z: relative to the last axis's
    /// point_mm, along the axes of M at zero). A target without it is on the table at center_W_mm.
    std::optional<Vector3> tool_S_mm;
    /// Target: fitted position relative to the declared one; readings are relative to the declared
    /// one.
    Vector3 found_mm = Vector3::Zero();
    double diameter_mm = 25.4;
    bool free_center = false;
    bool free_tool = false;
};

/// A tracker, CMM or similar instrument that reads points (`point` rows): p_I = pose_IM * p_M.
struct Instrument {
    std::string name;
    bool sees_table = false;  ///< frame = "W": reads points of the workpiece in W instead of M
    Vector3 origin_mm = Vector3::Zero();     ///< origin of M in the instrument's frame
    Vector3 rotation_deg = Vector3::Zero();  ///< rotation of M about the instrument's fixed X, then
                                             ///< Y, then Z axis
    bool free_pose = false;                  ///< the pose is fitted in each session: six
                                             ///< corrections, of any size
    bool free_scale = false;                 ///< a scale factor of its readings is fitted in each
                                             ///< session
    /// Fitted: the instrument reads shift + exp([tilt]x) (1 + scale_error) pose_IM p_M.
    SmallMotion pose_error;
    double scale_error = 0.0;
    Pose pose_IM() const;
    Vector3 read_mm(const Vector3& p_M_mm) const;  ///< reading of a point
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

/// [model]: prior knowledge for identification and diagnosis.
struct ModelSettings {
    std::vector<std::string> modelled = {"location"};
    std::map<std::string, double> noise_um;               ///< by device name, for rows in mm
    std::map<std::string, double> noise_urad;             ///< by device name, for rows in degrees
    std::map<std::string, CalibrationPrior> calibration;  ///< by ISO 230 name
    bool allow_large = false;  ///< --allow-large: implausible residuals are reported, not refused
};

/// +1 for every axis.
constexpr AxisSides came_travelling_plus() {
    AxisSides sides{};
    sides.fill(1);
    return sides;
}

/// Intersection of a rotary axis of a Hurco's part set-up with the plane perpendicular to it: two
/// of X, Y, Z, mm.
using Centreline = std::array<std::optional<double>, 3>;

/// [[session]]: fitted set-up quantities of one day, which replace those given elsewhere.
struct SessionValues {
    std::string name;                      ///< column session of the readings
    std::map<std::string, double> values;  ///< by the name that identify gives the quantity:
                                           ///< "CMM.a_rad"
};

/// True when the machine has no X, Y or Z axis: its flange is positioned by other axes.
bool is_arm(const kinematics::Chain& chain);

struct Setup {
    std::string name;
    std::string path;  ///< path of the file, for messages
    std::string chain_text;
    kinematics::Machine machine;
    /// [machine] auxiliary: axes that carry neither work nor tool (pallet, tailstock). NC words
    /// move them and their limits hold; no kinematics, no errors, no readings.
    std::vector<kinematics::AxisGeometry> auxiliary;
    AxisSides side_before = came_travelling_plus();  ///< [machine] side: side of the axes before
                                                     ///< the first move
    std::array<bool, axis_count> scale_encoder{};  ///< encoder = "scale": does not see the backlash
                                                   ///< of the drive
    /// encoder_zero_mm, encoder_zero_rad: what the axis's own encoder reads, actual - commanded,
    /// where the axis stands as commanded; mm or rad. A fit of `axis` rows finds it.
    std::array<double, axis_count> encoder_zero{};
    /// time_constant_s of the axis: its drive follows the command as behind a low-pass of first
    /// order (effects/servo.cpp). A diagnosis of `axis` rows finds it.
    TimeConstants time_constant_s{};
    /// Backlash that depends on the place: backlash_mm, backlash_rad given as a table. The gap at a
    /// position, mm or rad, with the sign of the effect X.backlash, to which it adds.
    std::array<kinematics::ErrorCurve, axis_count> gap{};
    std::vector<EffectSetting> effects;  ///< including the keys backlash and pretravel
    interpreter::Dialect dialect;
    positioning::TcpFrame tcp_frame =
        positioning::TcpFrame::start;        ///< [control] tcp_frame = "start" or "rotary_zero"
    bool work_positions_with_length = true;  ///< #5041.. and #5061.. include the tool length
    bool work_offset_is_group_12 = false;    ///< #4012 reads G54-G59, #4014 G66 G67
    bool g89_feeds_to_initial = true;        ///< G89 under G98 feeds out all the way
    bool g53_under_g91_moves = false;        ///< G53 under G91 moves by its words
    bool rapids_are_doglegs = false;         ///< of a Fanuc: each axis at its own speed (1401#1)
    /// [control] variable_rounding: of a variable in a position word
    controller::VariableRounding variable_rounding = controller::VariableRounding::none;
    std::vector<controller::ClampCode> clamps;  ///< [control.clamps]
    std::vector<int> block_skip;                ///< [control] block_skip: active switches 1-9
    bool optional_stop = false;                 ///< [control] optional_stop: M01 stops
    bool threading = false;                     ///< [control] threading: the control has G33
    controller::BuilderProfile builder;         ///< [control.builder]
    controller::HurcoChoices hurco;             ///< [control.hurco]
    std::map<Axis, Centreline> centrelines;     ///< [control.hurco] centreline: of the part set-up
    offsets::Stores stores;
    std::size_t derived_parameters = 0;  ///< of the stores: not in the file, taken from [machine]
    std::optional<ProbeSettings> probe;
    std::optional<BallbarSettings> ballbar;
    std::vector<Artefact> artefacts;
    std::vector<Body> bodies;  ///< touched by G31 besides the spheres
    PhysicalTools tools;       ///< [tools]: as they are, whatever the offsets say
    std::vector<Instrument> instruments;
    ModelSettings model;
    std::vector<SessionValues> sessions;
    /// Fitted zero of each test of a laser or autocollimator, mm or rad (ZeroGroup of the replay).
    /// It belongs to the readings and is not written to the file.
    std::vector<double> zeros;

    const Artefact* find_artefact(const std::string& name) const;
    const Instrument* find_instrument(const std::string& name) const;
    const SessionValues* find_session(const std::string& name) const;
    /// The setup with the values of that session; unchanged if there is no [[session]] of that
    /// name (session_keys.cpp).
    Setup in_session(const std::string& name) const;
    /// Position in S of a target on the tool.
    Vector3 target_S_mm(const Artefact& target) const;
};

/// Fills the stores from the backup folder named in [control], before the file's own keys override
/// them. Provided by the command that loads the setup, because the rooms setup and backup do not
/// know each other.
using BackupReader = std::function<void(const std::string& folder, offsets::Stores& stores)>;

/// Reads a setup file; throws InputError with line, column and text of the line. `notes` gets one
/// line for each derived value (19680-19714) and each unknown key. A `backup` key without a reader
/// is an error.
Setup load_setup(const std::string& path, std::vector<std::string>& notes,
                 const BackupReader& backup = {});
Setup parse_setup(const std::string& text, const std::string& path, std::vector<std::string>& notes,
                  const BackupReader& backup = {});
/// The setup as TOML that reads back to the same value (setup_format.cpp).
std::string format_setup(const Setup& setup);

/// Derives 19680-19714 (and 19666, 19741-19744) as if the control knew the true geometry of this
/// machine. Parameters already present are kept. Returns an empty text on success. Otherwise
/// returns the reason (not two rotary axes, a linear axis carried by a rotary one, an axis line in
/// no coordinate plane) and changes nothing (derive_pivot.cpp).
std::string derive_pivot_parameters(const kinematics::Machine& machine,
                                    offsets::Parameters& parameters);
/// Derives 1022 for machines with U, V or W: 5, 6, 7 for an axis that moves the tool like X, Y, Z;
/// 0 for any other direction or an axis carried by a rotary one. Returns the letters of the latter.
/// No effect when 1022 is already present (derive_parallel.cpp).
std::string derive_parallel_axes(const kinematics::Machine& machine,
                                 offsets::Parameters& parameters);
/// Derives the G54.2 groups 7580-7588 of the table axes, nearest the workpiece first. No effect
/// when any of them is already present, or when a table axis is inclined (no group can describe
/// it).
void derive_fixture_groups(const kinematics::Machine& machine, offsets::Parameters& parameters);

}  // namespace trunnion::setup
