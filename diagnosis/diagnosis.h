// The sim-to-real gap of readings: its location, causes and reduction (diagnose.cpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/finite.h"
#include "diagnosis/advice/measurements.h"
#include "diagnosis/prepare/noise.h"
#include "diagnosis/verdict/verdict_kind.h"
#include "identification/unknown_sides.h"
#include "records/readings.h"
#include "setup/setup.h"

namespace trunnion::diagnosis {

/// The gap on readings that were not used in the fit, before and after, in um (not whitened).
struct HeldOut {
    Finite rms_before_um = 0.0, rms_after_um = 0.0, noise_um = 0.0;
    Finite shrink = 0.0;           ///< 1 - sqrt(max(0, after^2 - noise^2) / (before^2 - noise^2))
    Finite low = 0.0, high = 0.0;  ///< 95 %, bootstrap over poses and arcs
    std::size_t set_aside = 0;     ///< readings of a separate table that fit nothing
};

/// One value of a free-form error.
struct TablePoint {
    std::string error;  ///< ISO 230 name: "EXX"
    double at = 0.0, value = 0.0, sigma = 0.0;
    std::string at_unit, unit;  ///< mm or rad
    bool against = false;       ///< the error counts along + of M, the axis the other way round
};

/// How far an axis goes beyond its command, in its own sense, at places of its travel (mm or rad).
struct BeyondCommand {
    std::string axis;  ///< empty: the cause tells nothing of it
    bool rotary = false;
    std::vector<double> at, too_far;

    /// Linear interpolation; beyond the ends the nearest value (beyond_command.cpp). At least two
    /// places.
    double operator()(double q) const;
};

struct Cause {
    std::string effect;
    Finite probability = 0.0;
    std::vector<std::string> rivals;
    std::vector<identification::FitParameter> parameters;
    std::vector<identification::Inseparable>
        unseen;          ///< directions of the parameters that nothing here shows
    Finite share = 0.0;  ///< of the gap: what it does in the fit
    HeldOut heldout;
    std::string what, usual_cause, remedy;
    std::vector<TablePoint> points;  ///< of a cause in free form, else empty
    /// Of a positioning error in free form, with the other claimed ones of its axis; empty for
    /// those.
    BeyondCommand beyond;
    std::string includes;       ///< causes that `beyond` has besides: "Y.scale"
    Finite rms_sigma = 0.0;     ///< what it does to the readings, rms in their sigma
    bool holds_between = true;  ///< a free form that predicts places left out
    std::string since;          ///< a change: the session from which it holds; else empty
    bool known = true;          ///< false: structure that nothing in the catalogue explains
    bool written = true;        ///< false: it does not stand in Diagnosis::setup
};

/// Change of one parameter of the machine from one session to the next.
struct SessionChange {
    identification::FitParameter parameter;  ///< value and sigma are those of the change
    std::string since;                       ///< the first session with it
    double before = 0.0;                     ///< the parameter in the previous session, in its unit
    Finite probability =
        0.0;               ///< of the cause that it is part of; 0: the estimate beside all causes
    bool claimed = false;  ///< part of a cause that is claimed
};

/// Readings of one session, um.
struct SessionFit {
    std::string name;
    std::size_t readings = 0;
    double rms_before_um = 0.0, rms_after_um = 0.0;  ///< with the set-up alone, with the causes
};

/// Noise that adds to what the rows of a device state, rms of the rows, um.
struct AddedNoise {
    records::Device device = records::Device::none;
    double stated_um = 0.0, added_um = 0.0;
};

struct Diagnosis {
    bool angles = false;  ///< all readings are angles: what is named _um is µrad
    Verdict verdict = Verdict::no_gap;
    NoiseModel noise;
    std::vector<AddedNoise> added;    ///< where the rows state too little of it
    std::optional<Finite> stated_um;  ///< what is stated, where `noise_um` is another noise
    Finite rms_um = 0.0, noise_um = 0.0, excess_um = 0.0, p_value = 1.0;
    bool only_scatter = false;  ///< the gap is nothing but repeats that differ more than is stated
    std::vector<DriverShare> where;
    std::vector<Cause> causes;
    Finite after_rms_um = 0.0, unexplained_share = 0.0;
    Finite explained = 0.0;      ///< H of the readings left out, 0..1: it decides the verdict
    bool between_places = true;  ///< false: it holds at the measured places only
    std::vector<identification::FitParameter> set_up;  ///< nuisances: never causes
    std::vector<std::string> set_up_words;         ///< poses of instruments and zeros of encoders
    std::vector<identification::FoundSide> sides;  ///< likewise: what the table leaves open
    HeldOut after;
    bool writes_causes = true;            ///< false: none of the causes stands in `setup`
    std::vector<std::string> background;  ///< small errors that `setup` has beside the causes
    std::vector<NextMeasurement> next;
    std::vector<std::string> unseen;  ///< effects that these readings do not determine
    std::vector<identification::Inseparable>
        inseparable;          ///< of the base, and of the stores (pivot.*)
    bool unfinished = false;  ///< the search was ended: all this is of the best model until then
    std::size_t readings = 0, outliers = 0;
    std::vector<std::string> notes;  ///< large residuals declared as intended
    std::size_t copies = 0;       ///< readings that repeat the one before exactly, and do not count
    std::size_t chosen_from = 0;  ///< number of readings of a longer table from which these were
                                  ///< selected; else 0
    std::vector<double> before_um, after_um;  ///< machine minus simulation, for each reading
    std::vector<SessionFit> sessions;         ///< if changes between sessions were requested
    std::vector<SessionChange> changes;       ///< likewise
    setup::Setup setup;  ///< with the re-identified and added effects, for the last session
};

struct DiagnosisOptions {
    const records::ReadingTable* holdout = nullptr;
    bool plan_next = true;
    bool over_sessions = false;  ///< search for changes of the machine between sessions
    std::uint64_t seed = 1;
    /// Called with the name of each stage; may be empty.
    std::function<void(const char* stage)> watch = {};
    /// Asked during the search: false ends it, and the verdict is that of the best model so far.
    std::function<bool()> go_on = {};
    /// Asked after the verdict, while the next measurement is planned: false ends the planning.
    std::function<bool()> plan_on = {};
};

/// Throws InputError for readings that do not allow a verdict.
Diagnosis diagnose(const setup::Setup& setup, const records::ReadingTable& table,
                   const DiagnosisOptions& options = {});

}  // namespace trunnion::diagnosis
