#include "diagnosis/next_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "diagnosis/measurements.h"
#include "diagnosis/rules.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

/// Columns for one set of rows: base (by name), claimed and rival, in sigma.
struct Block {
    std::vector<std::string> names;
    Eigen::MatrixXd base;
};

std::vector<std::string> names_of(const std::vector<identification::FitParameter>& parameters) {
    std::vector<std::string> names;
    for (const identification::FitParameter& p : parameters)
        names.push_back(p.effect + "." + p.name + "." + std::to_string(p.component));
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

Worked work_out(Measurement m, const setup::Setup& setup, const effects::Catalogue& catalogue,
                const std::vector<std::string>& effects, const NoiseModel& noise) {
    Worked w;
    w.measurement = std::move(m);
    w.replay = std::make_unique<emulator::Replay>(setup, w.measurement.table);
    const kinematics::ForwardModel forward(setup.machine);
    for (std::size_t i = 0; i < w.replay->size(); ++i)
        w.gradient.push_back(w.replay->gradient(i, forward, {}));
    w.whitener = std::make_unique<Whitener>(
        *w.replay, noise_blocks(*w.replay, w.measurement.table), noise,
        identification::row_noise(setup, w.measurement.table, *w.replay).sigma_mm);
    const identification::BaseColumns base =
        identification::base_columns(setup, *w.replay, catalogue, effects, w.gradient);
    w.block = {names_of(base.parameters), whitened(*w.whitener, base.columns)};
    return w;
}

Eigen::MatrixXd effect_block(const Worked& w, const ColumnGroup& group) {
    return whitened(*w.whitener, columns_on(*w.replay, w.gradient, group));
}

/// The rival with all its linear parameters, those beside its textbook form too: a prediction that
/// gave it fewer would promise more than the measurement holds.
ColumnGroup with_all_parameters(ColumnGroup rival) {
    if (!rival.effect) return rival;  // a table
    rival.parameters.clear();
    for (std::size_t j = 0; j < rival.effect->parameters.size(); ++j)
        if (!rival.effect->parameters[j].is_key()) rival.parameters.push_back(j);
    rival.features.assign(rival.parameters.size(), 0);  // counts the columns
    rival.shape.resize(0, 0);
    return rival;
}

/// Squared part of `target` that neither base nor rival can reproduce; base columns are matched by
/// name.
class Mimic {
  public:
    void add(const Block& block, const Eigen::MatrixXd& rival, const Eigen::VectorXd& target) {
        std::vector<Eigen::Index> place;
        for (const std::string& name : block.names) {
            const auto it = std::find(names_.begin(), names_.end(), name);
            place.push_back(it - names_.begin());
            if (it == names_.end()) names_.push_back(name);
        }
        pieces_.push_back({place, block.base, rival, target});
    }

    /// Without the rival: the part that the base cannot reproduce, i.e. the contribution of the
    /// target.
    double left(bool with_rival = true) const {
        const auto q = with_rival ? pieces_.front().rival.cols() : 0;
        const auto p = static_cast<Eigen::Index>(names_.size()) + q;
        Eigen::MatrixXd square = Eigen::MatrixXd::Zero(p, p);
        Eigen::VectorXd product = Eigen::VectorXd::Zero(p);
        double energy = 0.0;
        for (const Piece& piece : pieces_) {
            Eigen::MatrixXd a = Eigen::MatrixXd::Zero(piece.target.size(), p);
            for (std::size_t j = 0; j < piece.place.size(); ++j)
                a.col(piece.place[j]) = piece.base.col(static_cast<Eigen::Index>(j));
            if (with_rival) a.rightCols(q) = piece.rival;
            square.noalias() += a.transpose() * a;
            product.noalias() += a.transpose() * piece.target;
            energy += piece.target.squaredNorm();
        }
        return std::max(0.0, energy - product.dot(estimation::solve_ranked(square, product).value));
    }

  private:
    struct Piece {
        std::vector<Eigen::Index> place;
        Eigen::MatrixXd base, rival;
        Eigen::VectorXd target;
    };
    std::vector<std::string> names_;
    std::vector<Piece> pieces_;
};

/// Factor on the loss at which a rival is dropped, for the noise of the new readings.
constexpr double settled_margin = 1.5;

NextMeasurement best_for(const AmbiguousPair& pair, const std::vector<Worked>& list,
                         const Prepared& prepared, const NoiseModel& noise) {
    const identification::BaseModel& base = prepared.base;
    const Whitener whitener(prepared.replay, prepared.blocks, noise, base.sigma_mm);
    const auto columns = [&](const ColumnGroup& group) {
        return whitened(whitener, columns_on(prepared.replay, base.gradient, group));
    };
    Mimic now;
    const Block old{names_of(base.parameters), whitened(whitener, base.columns)};
    const ColumnGroup rival_group = with_all_parameters(*pair.rival);
    const Eigen::MatrixXd rival = columns(rival_group);
    const Eigen::VectorXd target = columns(*pair.claimed) * pair.values;
    now.add(old, rival, target);
    const double before = now.left();
    NextMeasurement best{pair.claimed->name, pair.rival->name, "", "", 0.0, 0.0};
    double rate = 0.0;
    for (const Worked& w : list) {
        Mimic then = now;
        then.add(w.block, effect_block(w, rival_group),
                 effect_block(w, *pair.claimed) * pair.values);
        const double lost = then.left(), gain = 0.5 * (lost - before);
        if (gain < 3.0) continue;
        // Degree of separation for each minute; beyond full separation there is no further benefit.
        const double settled =
            std::min(1.0, lost / (settled_margin * rules::rival_limit(then.left(false))));
        if (settled * settled / w.measurement.minutes <= rate) continue;
        rate = settled * settled / w.measurement.minutes;
        best.log_bayes_factor = gain;
        best.minutes = w.measurement.minutes;
        best.settles = settled == 1.0;
        best.program = w.measurement.program;
        best.text = fmt::format("to tell {} from {}: {} (about {:.0f} minutes; {})", best.first,
                                best.second, w.measurement.text, best.minutes,
                                best.settles ? "it is expected to settle the matter"
                                             : "it may take more than this one");
    }
    if (best.text.empty())
        best.text = fmt::format("no ready measurement tells {} from {} at this size", best.first,
                                best.second);
    return best;
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
    std::vector<Worked> list;
    for (Measurement& m : ready_measurements(base.setup, end_s + 600.0)) {
        if (stopped()) return plan;
        list.push_back(work_out(std::move(m), base.setup, prepared.catalogue,
                                base.setup.model.modelled, noise));
    }
    for (const AmbiguousPair& pair : pairs) {
        if (stopped()) break;
        plan.push_back(best_for(pair, list, prepared, noise));
    }
    std::stable_sort(plan.begin(), plan.end(),
                     [](const NextMeasurement& a, const NextMeasurement& b) {
                         return a.log_bayes_factor > b.log_bayes_factor;
                     });
    return plan;
}

}  // namespace trunnion::diagnosis
