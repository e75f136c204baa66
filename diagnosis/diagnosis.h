// The sim-to-real gap of a set of readings: where it lies, which effect causes it, how far it
// shrinks.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/noise.h"
#include "identification/unknown_sides.h"
#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::diagnosis {

enum class Verdict : unsigned char { no_gap, explained, partly_explained, ambiguous, unexplained };
const char* to_string(Verdict verdict);
const char* to_string(NoiseSource source);

/// The gap on readings that took no part in the fit, before and after, raw um.
struct HeldOut {
    double rms_before_um = 0.0, rms_after_um = 0.0, noise_um = 0.0;
    double shrink = 0.0;           ///< 1 - sqrt(max(0, after^2 - noise^2) / (before^2 - noise^2))
    double low = 0.0, high = 0.0;  ///< 95 %, bootstrap over poses and arcs
};

struct DriverShare {
    std::string by, component, text;
    double share = 0.0, p_value = 1.0;
};

/// One value of an error in free form.
struct TablePoint {
    std::string error;  ///< ISO 230 name: "EXX"
    double at = 0.0, value = 0.0, sigma = 0.0;
    std::string at_unit, unit;  ///< mm or rad
    bool travel = false;        ///< the error of a slide along its own travel
};

struct Cause {
    std::string effect;
    double probability = 0.0;
    std::vector<std::string> rivals;
    std::vector<identification::FitParameter> parameters;
    std::vector<identification::Inseparable>
        unseen;          ///< directions of the parameters that nothing here shows
    double share = 0.0;  ///< of the gap: what it does in the fit
    HeldOut heldout;
    std::string what, usual_cause, remedy;
    std::vector<TablePoint> points;  ///< of a cause in free form, else empty
    double rms_sigma = 0.0;          ///< what it does to the readings, rms in their sigma
    bool holds_between = true;       ///< a free form that predicts places left out
    std::string since;               ///< a change: the session from which it holds; else empty
};

/// One parameter of the machine from one session to the next.
struct SessionChange {
    identification::FitParameter parameter;  ///< value and sigma: those of the change
    std::string since;                       ///< the session that begins with it
    double before = 0.0;                     ///< the parameter in the session before, in its unit
    bool claimed = false;  ///< part of a cause; else what a change would be beside all causes
};

/// Readings of one session, um.
struct SessionFit {
    std::string name;
    std::size_t readings = 0;
    double rms_before_um = 0.0, rms_after_um = 0.0;  ///< with the set-up alone, with the causes
};

struct NextMeasurement {
    std::string first, second, text, program;
    double log_bayes_factor = 0.0;  ///< predicted
    double minutes = 0.0;
    bool settles = false;  ///< predicted: afterwards the rival stands no longer
};

struct Diagnosis {
    Verdict verdict = Verdict::no_gap;
    NoiseModel noise;
    double rms_um = 0.0, noise_um = 0.0, excess_um = 0.0, p_value = 1.0;
    std::vector<DriverShare> where;
    std::vector<Cause> causes;
    double after_rms_um = 0.0, unexplained_share = 0.0;
    double explained = 0.0;      ///< H of the readings left out, 0..1: it decides the verdict
    bool between_places = true;  ///< false: it holds at the measured places only
    std::vector<identification::FitParameter> set_up;  ///< nuisances: never causes
    std::vector<identification::FoundSide> sides;      ///< likewise: what the table leaves open
    HeldOut after;
    std::vector<NextMeasurement> next;
    std::vector<std::string> unseen;  ///< effects that these readings cannot show
    std::vector<identification::Inseparable>
        inseparable;  ///< of the base, and of the stores (pivot.*)
    std::size_t readings = 0, outliers = 0;
    std::vector<std::string> notes;  ///< large residuals that were meant
    std::size_t chosen_from = 0;  ///< readings of a longer table, of which those were chosen; or 0
    std::vector<double> before_um, after_um;  ///< machine minus simulation, by reading
    std::vector<SessionFit> sessions;         ///< where changes between them were asked for
    std::vector<SessionChange> changes;       ///< likewise
    setup::Setup setup;  ///< with the re-identified and added effects, of the last session
};

struct DiagnosisOptions {
    const records::ReadingTable* holdout = nullptr;
    bool plan_next = true;
    bool over_sessions = false;  ///< the machine may have changed between sessions: what did?
    std::uint64_t seed = 1;
    /// Told what is worked on now; empty: nobody looks on.
    std::function<void(const char* stage)> watch = {};
    /// Asked while the next measurement is planned, when the verdict stands: false ends the plan.
    std::function<bool()> plan_on = {};
};

/// Throws InputError on readings that allow no verdict.
Diagnosis diagnose(const setup::Setup& setup, const records::ReadingTable& table,
                   const DiagnosisOptions& options = {});

}  // namespace trunnion::diagnosis
