#include "diagnosis/advice/next_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>

#include "diagnosis/advice/measurement_repeats.h"
#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"
#include "estimation/inner_products.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

/// Base columns of one set of rows, in sigma, and their products with each other.
struct Block {
    std::vector<std::string> names;
    Eigen::MatrixXd base, square;
};

/// `own_set_up`: set-up quantities are those of this block alone, because a part or a reflector
/// that is mounted again is not at its old place.
std::vector<std::string> names_of(const std::vector<identification::FitParameter>& parameters,
                                  bool own_set_up) {
    std::vector<std::string> names;
    for (const identification::FitParameter& p : parameters)
        names.push_back((own_set_up && p.of_set_up ? "again " : "") + p.effect + "." + p.name +
                        "." + std::to_string(p.component));
    return names;
}

/// A prepared measurement: rows, derivatives and base columns.
struct Worked {
    Measurement measurement;
    std::unique_ptr<emulator::Replay> replay;  ///< at one address: the whitener refers to it
    std::vector<kinematics::Perturbation> gradient;
    std::unique_ptr<Whitener> whitener;
    Block block;
};

Eigen::MatrixXd whitened(const Whitener& whitener, Eigen::MatrixXd columns) {
    whitener.apply(columns);
    return columns;
}

Block block_of(const Whitener& whitener,
               const std::vector<identification::FitParameter>& parameters,
               const Eigen::MatrixXd& columns, bool own_set_up) {
    Block block{names_of(parameters, own_set_up), whitened(whitener, columns), {}};
    block.square = estimation::inner_products(block.base);
    return block;
}

Worked work_out(Measurement m, const setup::Setup& present, const effects::Catalogue& catalogue,
                const std::vector<std::string>& effects, const NoiseModel& noise) {
    Worked w;
    w.measurement = std::move(m);
    const setup::Setup& setup = w.measurement.setup ? *w.measurement.setup : present;
    w.replay = std::make_unique<emulator::Replay>(setup, w.measurement.table);
    const kinematics::ForwardModel forward(setup.machine);
    for (std::size_t i = 0; i < w.replay->size(); ++i)
        w.gradient.push_back(w.replay->gradient(i, forward, {}));
    w.whitener = std::make_unique<Whitener>(
        *w.replay, noise_blocks(*w.replay, w.measurement.table), noise,
        identification::row_noise(setup, w.measurement.table, *w.replay).sigma_mm);
    const identification::BaseColumns base =
        identification::base_columns(setup, *w.replay, catalogue, effects, w.gradient);
    w.block = block_of(*w.whitener, base.parameters, base.columns, w.measurement.program.empty());
    return w;
}

bool is_gain(const ColumnGroup& group) {
    return group.effect && group.effect->kind == effects::EffectKind::sensor_gain;
}

Eigen::MatrixXd effect_block(const Worked& w, const ColumnGroup& group) {
    Eigen::MatrixXd columns = columns_on(*w.replay, w.gradient, group);
    if (w.measurement.other_instrument && is_gain(group)) columns.setZero();
    return whitened(*w.whitener, std::move(columns));
}

/// The rival with all its linear parameters, those beside its textbook form too: a prediction that
/// gave it fewer would promise more than the measurement holds. The gain is that of one instrument.
ColumnGroup with_all_parameters(ColumnGroup rival) {
    if (!rival.effect || is_gain(rival)) return rival;  // or a table
    rival.parameters.clear();
    for (std::size_t j = 0; j < rival.effect->parameters.size(); ++j)
        if (!rival.effect->parameters[j].is_key()) rival.parameters.push_back(j);
    rival.features.assign(rival.parameters.size(), 0);  // counts the columns
    rival.shape.resize(0, 0);
    return rival;
}

/// Squared part of `target` that neither base nor rival can reproduce; base columns are matched by
/// name. Holds products only, so that a copy with one measurement more costs little.
class Mimic {
  public:
    explicit Mimic(Eigen::Index rival_columns)
        : beside_(0, rival_columns),
          rival_square_(Eigen::MatrixXd::Zero(rival_columns, rival_columns)),
          rival_product_(Eigen::VectorXd::Zero(rival_columns)) {}

    void add(const Block& block, const Eigen::MatrixXd& rival, const Eigen::VectorXd& target) {
        const std::vector<Eigen::Index> place = places_of(block.names);
        square_(place, place) += block.square;
        beside_(place, Eigen::all) += estimation::inner_products(block.base, rival);
        product_(place) += block.base.transpose() * target;
        rival_square_ += estimation::inner_products(rival);
        rival_product_ += rival.transpose() * target;
        energy_ += target.squaredNorm();
    }

    double left() const {
        const Eigen::Index p = square_.rows(), q = rival_square_.rows();
        Eigen::MatrixXd square(p + q, p + q);
        square << square_, beside_, beside_.transpose(), rival_square_;
        Eigen::VectorXd product(p + q);
        product << product_, rival_product_;
        return beside(square, product);
    }
    /// Without the rival: the part that the base cannot reproduce, i.e. the contribution of the
    /// target.
    double left_by_base() const { return beside(square_, product_); }

  private:
    /// Rows of the products for these names; new ones are added.
    std::vector<Eigen::Index> places_of(const std::vector<std::string>& names) {
        std::vector<Eigen::Index> place;
        for (const std::string& name : names) {
            const auto it = std::find(names_.begin(), names_.end(), name);
            place.push_back(it - names_.begin());
            if (it == names_.end()) names_.push_back(name);
        }
        const auto grown = static_cast<Eigen::Index>(names_.size());
        square_.conservativeResizeLike(Eigen::MatrixXd::Zero(grown, grown));
        beside_.conservativeResizeLike(Eigen::MatrixXd::Zero(grown, beside_.cols()));
        product_.conservativeResizeLike(Eigen::VectorXd::Zero(grown));
        return place;
    }

    double beside(const Eigen::MatrixXd& square, const Eigen::VectorXd& product) const {
        return std::max(0.0, energy_ - estimation::explained(square, product));
    }

    std::vector<std::string> names_;
    Eigen::MatrixXd square_, beside_;  ///< of the base; of the base with the rival
    Eigen::VectorXd product_;
    Eigen::MatrixXd rival_square_;
    Eigen::VectorXd rival_product_;
    double energy_ = 0.0;
};

/// What the rival will lose with the new readings, and how well that is known.
struct Prospect {
    double lost = 0.0;          ///< expected
    double contribution = 0.0;  ///< of the cause, with the new readings
    double known = 0.0;         ///< ... with the present ones
};

/// Probability that a rival loses what it takes to drop it. The chi-squared that it loses scatters
/// by twice its root, because of the noise; it grows with the square of the effect's size, which
/// the present readings tell to one part in the root of its contribution.
double probability_to_drop(const Prospect& p) {
    const double by_size = 2.0 * p.lost / std::sqrt(std::max(1.0, p.known));
    const double spread = std::hypot(2.0 * std::sqrt(p.lost), by_size);
    return estimation::normal_tail((rules::rival_limit(p.contribution) - p.lost) /
                                   std::max(1e-9, spread));
}

std::string expectation(double probability) {
    constexpr double hardly = 0.05;
    if (probability < hardly) return "alone it hardly settles the matter";
    return probability >= rules::settles
               ? "it is expected to settle the matter"
               : fmt::format("it settles the matter with a probability of {:.0f} %",
                             100.0 * probability);
}

/// The readings so far.
struct Present {
    const Prepared& prepared;
    Whitener whitener;
    Block block;
};

/// What an encoder does to its own readings shows in no repeat of them.
std::string without_measurement(const std::string& first, const std::string& second) {
    const auto of_sensor = [](const std::string& name) { return name.starts_with("sensor."); };
    if (of_sensor(first) != of_sensor(second))
        return fmt::format("to tell {} from {}: measure with a second instrument, {}", first,
                           second, import_of_second_instrument);
    return fmt::format("no ready measurement tells {} from {} at this size", first, second);
}

/// False for a repeat that shows little more than the same readings once more would: what the rival
/// loses there is that it is held in one form, and another form of it would lose nothing.
bool shows_more(const Worked& w, double more, double before, const Present& present) {
    constexpr double least = 3.0;
    if (!w.measurement.program.empty()) return true;
    const auto rows = static_cast<double>(w.replay->size());
    const double once_more = before * rows / static_cast<double>(present.prepared.replay.size());
    return more > least * once_more;
}

/// Values of a key that the search may choose when the new readings are there: finer than the grid,
/// and beyond it, because the time that all readings take grows.
std::vector<double> values_of_key(const effects::EffectParameter& key) {
    if (!key.refine) return key.grid;
    std::vector<double> values;
    for (std::size_t k = 0; k + 1 < key.grid.size(); ++k)
        for (const double part : {0.0, 0.25, 0.5, 0.75})
            values.push_back(key.grid[k] + part * (key.grid[k + 1] - key.grid[k]));
    for (const double more : {1.0, 1.5, 2.0, 4.0}) values.push_back(more * key.grid.back());
    return values;
}

/// The rival with its present keys, and with all others that are searched again; those of a ripple,
/// which are many, stay.
std::vector<ColumnGroup> forms_of(const ColumnGroup& rival) {
    constexpr std::size_t most = 64;
    std::vector<ColumnGroup> forms{with_all_parameters(rival)};
    if (!rival.effect) return forms;
    for (std::size_t j = 0; j < rival.effect->parameters.size(); ++j) {
        const effects::EffectParameter& key = rival.effect->parameters[j];
        if (!key.is_key()) continue;
        const std::vector<double> values = values_of_key(key);
        const std::size_t before = forms.size();
        if (before * (values.size() + 1) > most) continue;
        for (std::size_t k = 0; k < before; ++k)
            for (const double value : values) {
                forms.push_back(forms[k]);
                forms.back().keys[j] = value;
            }
    }
    return forms;
}

/// A form of the rival, and what it does to the present readings.
struct RivalForm {
    ColumnGroup group;
    Mimic now;
};

/// The forms of a pair's rival beside the claimed cause.
class Rivalry {
  public:
    Rivalry(const AmbiguousPair& pair, const Present& present) : pair_(pair) {
        const auto columns = [&](const ColumnGroup& group) {
            return whitened(present.whitener, columns_on(present.prepared.replay,
                                                         present.prepared.base.gradient, group));
        };
        const Eigen::VectorXd target = columns(*pair.claimed) * pair.values;
        for (ColumnGroup& group : forms_of(*pair.rival)) {
            const Eigen::MatrixXd rival = columns(group);
            forms_.push_back({std::move(group), Mimic(rival.cols())});
            forms_.back().now.add(present.block, rival, target);
        }
    }

    /// What the best form of the rival loses now.
    double before() const {
        double least = std::numeric_limits<double>::infinity();
        for (const RivalForm& form : forms_) least = std::min(least, form.now.left());
        return least;
    }
    Prospect after(const Worked& w) const {
        const Eigen::VectorXd target = effect_block(w, *pair_.claimed) * pair_.values;
        double least = std::numeric_limits<double>::infinity(), contribution = 0.0;
        for (const RivalForm& form : forms_) {
            Mimic then = form.now;
            then.add(w.block, effect_block(w, form.group), target);
            const double left = then.left();
            if (left < least) contribution = then.left_by_base();
            least = std::min(least, left);
        }
        return {least, contribution, forms_.front().now.left_by_base()};
    }

  private:
    const AmbiguousPair& pair_;
    std::vector<RivalForm> forms_;
};

NextMeasurement best_for(const AmbiguousPair& pair, const std::vector<Worked>& list,
                         const Present& present) {
    const Rivalry rivalry(pair, present);
    const double before = rivalry.before();
    NextMeasurement best{pair.claimed->name, pair.rival->name, "", "", 0.0, 0.0};
    double rate = 0.0;
    for (const Worked& w : list) {
        const Prospect prospect = rivalry.after(w);
        const double more = prospect.lost - before, gain = 0.5 * more;
        if (gain < 3.0 || !shows_more(w, more, before, present)) continue;
        // Degree of separation for each minute; beyond full separation there is no further benefit.
        const double probability = pair.believed * probability_to_drop(prospect);
        const double settled = std::min(1.0, probability / rules::settles);
        if (settled * settled / w.measurement.minutes <= rate) continue;
        rate = settled * settled / w.measurement.minutes;
        best.log_bayes_factor = gain;
        best.minutes = w.measurement.minutes;
        best.probability = probability;
        best.settles = probability >= rules::settles;
        best.program = w.measurement.program;
        best.text =
            fmt::format("to tell {} from {}: {} (about {:.0f} minutes; {})", best.first,
                        best.second, w.measurement.text, best.minutes, expectation(probability));
    }
    if (best.text.empty()) best.text = without_measurement(best.first, best.second);
    return best;
}

/// A cause may be claimed as a table and in its textbook form. What one of them asks for is taken
/// for both: that nothing is ready for the other would contradict it.
void drop_told(std::vector<NextMeasurement>& plan) {
    const auto asks = [](const NextMeasurement& n) { return n.minutes > 0.0; };
    std::set<std::pair<std::string, std::string>> asked;
    for (const NextMeasurement& n : plan)
        if (asks(n)) asked.emplace(n.first, n.second);
    std::erase_if(plan, [&](const NextMeasurement& n) {
        return !asks(n) && asked.contains({n.first, n.second});
    });
}

}  // namespace

std::vector<NextMeasurement> plan_next(const Prepared& prepared, const NoiseModel& noise,
                                       const std::vector<AmbiguousPair>& pairs,
                                       const std::function<bool()>& go_on) {
    const identification::BaseModel& base = prepared.base;
    const double end_s = prepared.table.rows.back().time_s;
    const auto stopped = [&] { return go_on && !go_on(); };
    std::vector<NextMeasurement> plan;
    if (pairs.empty()) return plan;
    Whitener whitener(prepared.replay, prepared.blocks, noise, base.sigma_mm);
    Block block = block_of(whitener, base.parameters, base.columns, false);
    const Present present{prepared, std::move(whitener), std::move(block)};
    std::vector<Worked> list;
    std::vector<Measurement> ready =
        repeated_measurements(base.setup, prepared.table, end_s + 600.0);
    for (Measurement& m : ready_measurements(base.setup, end_s + 600.0))
        ready.push_back(std::move(m));
    for (Measurement& m : ready) {
        if (stopped()) return plan;
        list.push_back(work_out(std::move(m), base.setup, prepared.catalogue,
                                base.setup.model.modelled, noise));
    }
    for (const AmbiguousPair& pair : pairs) {
        if (stopped()) break;
        plan.push_back(best_for(pair, list, present));
    }
    drop_told(plan);
    std::stable_sort(plan.begin(), plan.end(),
                     [](const NextMeasurement& a, const NextMeasurement& b) {
                         return a.log_bayes_factor > b.log_bayes_factor;
                     });
    return plan;
}

}  // namespace trunnion::diagnosis
