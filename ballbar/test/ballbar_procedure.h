// The whole single-set-up procedure: run, identify, compensate the control, run again.
#pragma once

#include <cstdint>
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

/// One line of the result table. mm or rad.
struct BallbarErrorRow {
    kinematics::ErrorName name;
    double before = 0.0, after = 0.0;
    double sigma_before = 0.0;
    double sigma = 0.0;  ///< of `after`: noise of both runs, so the larger one
    std::optional<double> published_before;
    std::optional<double> truly_left;  ///< a simulator knows: true error minus `before`

    double change_percent() const;  ///< of the size; 0 when there was no error before
};

/// Manual times that the comparison with two set-ups assumes, s.
struct SetupTimes {
    double setup_s = 600.0;   ///< clamp pivot and cup, set the origin, start the software
    double remount_s = 90.0;  ///< take the bar off, move, mount it again: between tests when it
                              ///< does not stay in place
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

/// Largest true way of a tip from its place at home, by the compensated control; only a simulator
/// knows it. The re-test with the same cup sees `cup_um` alone.
struct TrueTip {
    double stated_um = 0.0;  ///< of a tool exactly as long as its offset says
    double cup_um = 0.0;     ///< of the cup as it hangs, wrong length included
};

/// What a check says that took no part in the fit: a sphere found by the probe in poses of the
/// compensated control. Cup and bar have no say in it, so it shows what the bar cannot: a cup
/// that is not where its offset says. An error that stylus and cup share it cannot show.
struct SphereCheck {
    int poses = 0;
    double before_um = 0.0,
           after_um = 0.0;  ///< largest found minus expected centre, zeroed at home
};

struct BallbarResult {
    std::string machine;
    std::string setup_path;
    interpreter::DialectFamily dialect = interpreter::DialectFamily::fanuc;
    BallbarProgramData data;
    double reading_sigma_mm = 0.0;  ///< standard uncertainty of one reading of the first run
    double reference_mm = 100.0;  ///< length of the bar that the evaluation counts from: warm when
                                  ///< its temperature was read
    std::string program;
    BallbarRun before, after;
    std::vector<BallbarErrorRow> errors;           ///< as the setup file means them
    std::vector<BallbarErrorRow> at_intersection;  ///< as the paper means them
    BallbarFit fit;                                ///< cup taken as known
    BallbarFit open_fit;  ///< cup unknown too: rank, what cannot be told apart
    ResidualVerdict verdict;
    PublishedEvaluation published;
    std::vector<PlanarResult> planar;
    std::optional<setup::StoresToType> stores;  ///< what to type for the positions found
    SetupTimes times;
    bool simulated = true;            ///< false: the passes are of a real machine
    bool has_after = true;            ///< `after` was run or given
    std::optional<TrueTip> true_tip;  ///< after compensation; of a simulated test
    std::optional<SphereCheck> sphere_check;
    std::vector<std::string> notes;

    std::size_t tests() const;  ///< number of different tests
    double single_setup_s() const;
    double two_setups_s() const;
};

struct BallbarProcedureOptions {
    std::uint64_t seed = 1;
    emulator::EffectModels effects;
    SetupTimes times;
    bool inside = false;  ///< bar turned round where it lies flat
    /// Where the pivot really stands, from where the setup says: an error of the set-up, in W.
    Vector3 pivot_offset_mm = Vector3::Zero();
    /// Location errors that `effects` add to the setup's: what is truly left counts from both.
    std::vector<NamedError> injected_errors;
};

/// Length of the bar that the exact fit found, minus the reference length.
struct BarLength {
    double error_mm = 0.0, sigma_mm = 0.0;
};
BarLength bar_length(const BallbarResult& result);

/// Place of the pivot that the exact fit found, from the stated one, in W.
Vector3 pivot_found_mm(const BallbarResult& result);

/// The bar as the operator states it: pivot from the setup's center_pivot, cup from the tool table
/// (the offset whose length is nearest the cup's). Throws InputError when the setup lacks them.
BallbarLayout stated_layout(const setup::Setup& setup, int& tool_offset);

/// What the NC programs of this setup start from: stated layout, dialect of the control.
BallbarProgramData stated_program_data(const setup::Setup& setup, bool inside);

/// Evaluates passes of a real machine, `after` measured once more when the numbers were typed: each
/// against the nominal machine. Circles alone give their ISO 230-4 figures and no location errors.
/// Throws InputError when no row belongs to a pass.
BallbarResult evaluate_ballbar(const setup::Setup& stated, const records::ReadingTable& before,
                               const std::optional<records::ReadingTable>& after);

/// Throws Alarm when the program stops, InputError when the setup cannot carry the test or a pass
/// has no readings (out of range).
BallbarResult run_ballbar(const setup::Setup& stated, const BallbarProcedureOptions& options);

}  // namespace trunnion::ballbar::test
