// The thresholds of the verdict; docs/diagnosis.md gives the reasons.
#pragma once

#include <cstddef>

namespace trunnion::diagnosis::rules {

// Log prior probabilities of being present.
constexpr double effect_prior = -3.2188758248682006;  ///< ln 0.04: a catalogue effect
constexpr double gain_prior = -5.521460917862246;     ///< ln 0.004: a wrong gain of the instrument,
                                                      ///< which is calibrated, or of all scales
                                                      ///< alike (assumed)
/// Angular errors that the readings may show as positioning, straightness and squareness alone: on
/// one line these are their names (ISO 230-1).
constexpr double by_an_arm = -0.7;  // ln 0.5
/// Forms that are rivals only: angles with a bow about one line, the slope of a straightness.
constexpr double unnamed_form = -1.4;  // ln 0.25
constexpr double far_off = -3.0;  ///< ln 0.05: of a stretch that the radius of a stylus does as
                                  ///< well, many times nearer to its usual size (assumed)
/// A ripple that no position resolves, of a period that no usual lead has (assumed).
constexpr double odd_period_prior = -3.0;           // ln 0.05
constexpr double table_prior = -3.912023005428146;  ///< ln 0.02: free form, driver

// A gap is reported when both the evidence and the left-out readings support it.
constexpr double of_line = 2.0 / 3.0;   ///< probability of positioning against angles of its axis,
                                        ///< where one line was read (assumed)
constexpr double spoiled_part = 0.02;   ///< of all readings, beforehand (assumed)
constexpr double least_evidence = 3.0;  ///< nats, for the whole model
constexpr double course_evidence =
    9.0;  ///< ... for a course of time over tests whose zeros scatter
constexpr double plain_evidence = 15.0;  ///< ... above which left-out blocks need not agree
constexpr double plain_chance = 1e-3;    ///< ... or below this chance, where repeats tell the noise
constexpr double free_chance = 0.01;   ///< ... or below this one, by what the members leave, where
                                       ///< nothing repeats (assumed)
constexpr double zeros_chance = 0.01;  ///< that noise makes means of passes differ as much: below
                                       ///< it each pass has a zero of its own (assumed)
constexpr double few_blocks = 12.0;    ///< left out: of so few a t of 2 is rarely reached (assumed)
constexpr double least_t = 2.0;        ///< t statistic of the loss saved on left-out blocks
constexpr double least_saving = 0.02;  ///< of the noise variance
constexpr double least_driver = 0.08;  ///< of the noise variance: a single driver establishes a
                                       ///< gap
constexpr double large_zero = 1.0;     ///< rms of a zero, in sigma, above which it is part of the
                                       ///< gap
constexpr double large_cycle = 3.0;    ///< ... of the cycles of a laser test: its few zeros wander
                                       ///< with the air and the frame, and are known well

constexpr double explained = 0.8, partly = 0.5;  ///< of H
constexpr double least_told = 0.5;  ///< of H: shares of all causes below it contradict it (assumed)
constexpr double between_part = 0.2;   ///< maximum part of the gap carried by tables that do not
                                       ///< interpolate
constexpr double between_least = 0.5;  ///< part that a table must predict at left-out positions

constexpr double alike =
    4.0;  ///< deviations: readings are correlated beyond (assumed); chance 1e-4
constexpr std::size_t table_places = 7;  ///< from which a curve of any form may hold between them:
                                         ///< of fewer, a ripple looks as smooth (assumed)
constexpr std::size_t bend_places = 5;   ///< from which a bend of known form holds between them
                                         ///< (assumed)
constexpr double many_places = 8.0;      ///< ... of fewer with this probability of no accident
constexpr double between_sure = 0.8;

constexpr double least_share = 0.05;  ///< of the gap: smaller effects are background ...
constexpr double least_rms = 0.7;     ///< ... unless they move the readings by this number of sigma
constexpr double most_own = 3.0;      ///< maximum squared sum of contributions that cancel
constexpr double main_family = 0.6;   ///< share of an axis's free forms; if smaller, none is named

/// t statistic of what small errors of all axes save together: none of them is a cause, and each
/// has the size that is seen (assumed).
constexpr double background_t = 1.0;
constexpr double size_of_noise = 0.5;  ///< nats: more than the size of an error that is not there
                                       ///< gains on average (assumed)
constexpr double enormous = 30.0;  ///< typical sizes: a cause beyond is not written unless claimed
                                   ///< (assumed)

constexpr double mistaken_sigmas = 3.0;   ///< left by the set-up: columns may be wrong from there
constexpr double mistaken_left = 0.7;     ///< most of that which is left with a column put right
constexpr double beside_mistaken = 0.05;  ///< probability at most of a cause beside a wrong table

constexpr double most_scatter = 4.0;    ///< of repeats, relative to what is stated: more is a gap
constexpr double told_scatter = 1.5;    ///< ... : more is said
constexpr double most_slow = 4.0;       ///< variance left of a bar, in that of its noise: more is a
                                        ///< course of time, which whitening conceals (assumed)
constexpr double most_unstated = 10.0;  ///< noise that nobody states, in what is usual of the
                                        ///< device: more is a gap (assumed)
constexpr double most_outliers = 0.04;  ///< of the readings: more are a gap of some kind
constexpr double most_doubtful = 0.2;   ///< ... of which the evidence may say that they are spoiled
constexpr double driver_p = 1e-4;       ///< significance level of a driver
constexpr double driver_share = 0.05;
constexpr double chance_of_difference =
    1e-3;                            ///< below it two columns do not do the same (assumed)
constexpr double rival_loss = 12.0;  ///< maximum chi-squared lost by a rival
constexpr double rival_part = 0.04;  ///< ... or as a part of the contribution
constexpr double rival_left = 3.0;   ///< ... and of a reading: no rival leaves twice the rms

constexpr double settles = 0.9;  ///< probability from which a measurement is expected to settle

constexpr double set_up_range = 20.0;  ///< typical sizes: sigma of a set-up value beforehand;
                                       ///< unobservable directions stay constant

constexpr double sure = 0.95;  ///< probability against the best model without a cause: from there
                               ///< on nothing is named in its place

constexpr double rather_not = 0.1;  ///< rather one of the rivals, or nothing: not written in vain
constexpr double claimed = 0.5;     ///< probability of a cause that is claimed, not only listed

constexpr double store_sigmas = 5.0;  ///< of a store's number: claimed from there, missed below
constexpr double strange_mm = 5e-3;   ///< differences of programmed points that no store explains:
                                      ///< larger than the last digits of rotary axes

/// Odds that a table is mistaken (columns, units, setup) where a cause is `enormous`: they grow
/// with its size; less where the causes explain the readings to their noise, as no wrong column
/// would (assumed).
constexpr double mistaken_odds = 0.05, mistaken_odds_explained = 0.005;

/// Probability at most of a cause of so many typical sizes.
double most_at_size(double sizes, bool to_the_noise);

/// Chi-squared that an effect may lose against the claimed one and still count as its rival.
double rival_limit(double contribution);

}  // namespace trunnion::diagnosis::rules
