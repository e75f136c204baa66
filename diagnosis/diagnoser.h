// One diagnosis in progress, shared by the stages of docs/diagnosis.md (diagnosis/*.cpp).
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "diagnosis/drivers.h"
#include "diagnosis/heldout.h"
#include "diagnosis/key_search.h"
#include "diagnosis/rules.h"
#include "diagnosis/search.h"
#include "diagnosis/shrink_interval.h"

namespace trunnion {

/// One diagnosis in progress: the stages of docs/diagnosis.md in the order of run().
class Diagnoser {
  public:
    Diagnoser(const Setup& setup, const ReadingTable& table, const DiagnosisOptions& options);
    Diagnosis run();

  private:
    void refuse_poor_tables() const;
    void refuse_poor_holdout(const ReadingTable& table) const;

    void watch(const char* stage) const {
        if (options_.watch) options_.watch(stage);
    }

    void start_noise();

    void rewhiten();

    bool modelled(const Effect& effect) const;

    void build_design();

    /// Candidates of effects with keys, at the settings that promise most beside a set.
    void add_keyed(const EffectSet& beside, int count);

    std::vector<std::size_t> lone_probe_readings() const;
    std::vector<std::size_t> wild_readings() const;
    void leave_out(const std::vector<std::size_t>& rows);
    void drop_outliers();

    SearchOptions search_options() const;

    EffectSet best_set();

    /// Residual (mm) of all rows after the set.
    Eigen::VectorXd left_after(const EffectSet& set) const;

    double outliers() const;

    double freedom_after(const EffectSet& set) const;

    /// Mean squared z (in stated sigma) that base and columns leave, freedom accounted for.
    double mean_square(const std::vector<Eigen::Index>& columns, double scale) const;

    /// Too little change for another round.
    static bool same_noise(const NoiseModel& a, const NoiseModel& b);

    /// Noise anew from what the best set leaves, then the best set anew.
    void refine_noise();

    /// Keys of chosen effects refined, beside the others and alone; further keys tried on the rest.
    void refine_set();

    /// Large effects bend the readings (a stylus that meets a sphere aside): what the emulator
    /// reads with the chosen set takes the place of the straight line. False when that changed
    /// next to nothing.
    bool relinearise();

    /// Candidate `m` again with keys refined on what the effects `others` leave.
    void add_refined(std::size_t m, const std::vector<std::size_t>& others);

    /// What a subset of the chosen effects leaves, as mean squared z.
    double left_square(const std::vector<std::size_t>& members) const;

    /// Mean squared z that noise alone leaves.
    double floor_square() const;

    /// What the fit leaves is noise of another size than the setup states.
    bool stated_noise_is_off(const NoiseModel& found) const;
    NoiseModel noise_without_drivers(const Eigen::VectorXd& left) const;

    std::vector<double> shares_of(const std::vector<std::size_t>& members) const;

    /// Effects that add little to what the others explain are background, not causes.
    void prune();

    /// What is left after the chosen set, as mean squared z.
    struct Remainder {
        std::vector<DriverTest> drivers;  ///< significant ones
        double base = 0.0, after = 0.0, floor = 0.0, structured = 0.0;
        double gap = 0.0, unexplained = 0.0;
        bool plain = false;  ///< seen beside the noise, and no background
    };
    Remainder remainder();
    double unusual_square() const;
    double aliased_square() const;
    double ripple_square(const Eigen::VectorXd& left);
    bool coincidence() const;
    double noise_doubt() const;
    double independent_readings() const;
    bool holds_elsewhere() const;
    void judge();
    void describe_size(const Remainder& r);
    void describe_where();
    void claim(double gap);
    void add_unknown(double share, const std::vector<DriverTest>& left);
    std::vector<EffectSet> swapped_sets(std::size_t member) const;
    std::vector<EffectSet> possible_sets() const;
    std::map<std::string, double> belief_of(const std::vector<EffectSet>& sets) const;
    std::vector<std::string> rivals_of(std::size_t member) const;
    void add_alternatives();
    void settle();
    void finish_keys();
    bool by_chance() const;
    HeldOut held_out(const std::vector<std::size_t>& members, const ShrinkDraws& draws) const;
    std::vector<PossibleTruth> near_truths();
    ShrinkDraws shrink_draws(const std::vector<EffectSet>& sets);
    std::vector<FitParameter> parameters_of(const EffectSet& set, std::size_t member) const;
    void write_setup();
    /// Directions of an effect's parameters that these readings cannot show.
    std::vector<Inseparable> unseen_of(const Candidate& candidate) const;
    void ask_next();
    void test_holdout();

    Eigen::MatrixXd known_columns(const EffectSet& set) const;

    Eigen::VectorXd noise_mm() const;

    double rms_um(const Eigen::VectorXd& v) const;

    const ReadingTable& table_;
    DiagnosisOptions options_;
    Replay replay_;
    Catalogue catalogue_;
    BaseModel base_;
    std::vector<NoiseBlock> blocks_;
    Folds folds_;
    std::vector<bool> used_;
    Eigen::VectorXd sigma_mm_;  ///< large for outliers
    NoiseModel noise_;
    double noise_variance_ = 1.0;
    double prior_ = rules::effect_prior;
    std::optional<Whitener> whitener_;
    std::optional<Design> design_;
    std::optional<KeySearch> keys_;
    EffectSet set_;
    std::vector<EffectSet> visited_;    ///< the best sets of the last search
    double unknown_evidence_ = -1e300;  ///< of one unknown cause that follows one driver
    double unknown_belief_ = 0.0;       ///< in that cause, against all sets of effects
    Diagnosis result_;
};

}  // namespace trunnion
