// The whole single-set-up procedure: run, identify, compensate the control, run again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/test/ballbar_fit.h"
#include "ballbar/test/ballbar_program.h"
#include "ballbar/test/ballbar_published.h"
#include "ballbar/test/circular_evaluation.h"
#include "emulator/run.h"
#include "setup/right_stores.h"

namespace trunnion::ballbar::test {

/// One line of the result table, mm or rad.
struct BallbarErrorRow {
    kinematics::ErrorName name;
    double before = 0.0, after = 0.0;
    double sigma_before = 0.0;
    double sigma = 0.0;  ///< of `after`; larger, because it contains the noise of both runs
    std::optional<double> published_before;
    std::optional<double> truly_left;  ///< simulation only: true error minus `before`

    double change_percent() const;  ///< change of the magnitude; 0 when there was no error before
};

/// Assumed manual times for the comparison with two set-ups, s.
struct SetupTimes {
    double setup_s = 600.0;   ///< clamp pivot and cup, set the origin, start the software
    double remount_s = 90.0;  ///< remove the bar, move, mount it again: between tests when it does
                              ///< not stay in place
};

struct PlanarResult {
    CircularTest test;
    CircularFigures figures;
    CircularDiagnosis diagnosis;
};

struct BallbarRun {
    records::ReadingTable readings;
    double time_s = 0.0;
};

/// Simulation only: largest true displacement of a tip from its position at home, with the
/// compensated control. The re-test with the same cup sees `cup_um` only.
struct TrueTip {
    double stated_um = 0.0;  ///< tool with exactly the length of its offset
    double cup_um = 0.0;     ///< the actual cup, including its wrong length
};

/// An independent check: a sphere measured by the probe in poses of the compensated control. It
/// does not use cup or bar and therefore reveals what the bar cannot: a cup whose position differs
/// from its offset. It cannot reveal an error common to stylus and cup.
struct SphereCheck {
    int poses = 0;
    double before_um = 0.0,
           after_um = 0.0;  ///< largest measured minus expected centre, zeroed at home
};

struct BallbarResult {
    std::string machine;
    std::string setup_path;
    interpreter::DialectFamily dialect = interpreter::DialectFamily::fanuc;
    BallbarProgramData data;
    double reading_sigma_mm = 0.0;  ///< standard uncertainty of one reading of the first run
    double reference_mm = 100.0;    ///< length of the bar to which the evaluation refers: at the
                                    ///< temperature that was read
    std::string program;
    BallbarRun before, after;
    std::vector<BallbarErrorRow> errors;           ///< with the definition of the setup file
    std::vector<BallbarErrorRow> at_intersection;  ///< with the definition of the paper
    BallbarFit fit;                                ///< cup assumed known
    BallbarFit open_fit;  ///< cup unknown too: rank and inseparable parameters
    ResidualVerdict verdict;
    PublishedEvaluation published;
    std::vector<PlanarResult> planar;
    std::optional<setup::StoresToType> stores;  ///< values to enter for the positions found
    SetupTimes times;
    bool simulated = true;            ///< false: passes of a real machine
    bool has_after = true;            ///< `after` was run or given
    std::optional<TrueTip> true_tip;  ///< after compensation; simulated test only
    std::optional<SphereCheck> sphere_check;
    std::vector<std::string> notes;

    std::size_t tests() const;  ///< number of distinct tests
    double single_setup_s() const;
    double two_setups_s() const;
};

struct BallbarProcedureOptions {
    std::uint64_t seed = 1;
    emulator::EffectModels effects;
    SetupTimes times;
    bool inside = false;  ///< bar reversed where it is horizontal
    /// Set-up error: actual minus stated position of the pivot, in W.
    Vector3 pivot_offset_mm = Vector3::Zero();
    /// Location errors added by `effects` to those of the setup; the true remaining errors include
    /// both.
    std::vector<NamedError> injected_errors;
    /// Told the number of steps done and what comes next; of `ballbar_steps`.
    std::function<void(int, const char*)> watch = [](int, const char*) {};
};
constexpr int ballbar_steps = 4;

/// Fitted length of the bar minus the reference length.
struct BarLength {
    double error_mm = 0.0, sigma_mm = 0.0;
};
BarLength bar_length(const BallbarResult& result);

/// Fitted minus stated position of the pivot, in W.
Vector3 pivot_found_mm(const BallbarResult& result);

/// The bar as stated by the operator: pivot from the setup's center_pivot, cup from the tool table
/// (the offset whose length is nearest to the cup's). Throws InputError when the setup lacks them.
BallbarLayout stated_layout(const setup::Setup& setup, int& tool_offset);

/// Input of the NC programs for this setup: stated layout, dialect of the control.
BallbarProgramData stated_program_data(const setup::Setup& setup, bool inside);

/// Throws Alarm when the program stops, InputError when the setup is unsuitable for the test or a
/// pass has no readings (out of range).
BallbarResult run_ballbar(const setup::Setup& stated, const BallbarProcedureOptions& options);

}  // namespace trunnion::ballbar::test
