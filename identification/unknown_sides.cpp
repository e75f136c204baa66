#include "identification/unknown_sides.h"

#include <fmt/format.h>

#include "effects/settings.h"

namespace trunnion::identification {
namespace {

constexpr double tells = 4.0;  ///< difference of the weighted squares: two sigma

class SideChoice {
  public:
    SideChoice(const setup::Setup& setup, const records::ReadingTable& table,
               emulator::Replay& replay, const effects::Catalogue& catalogue,
               const std::vector<std::string>& effects)
        : setup_(setup),
          table_(table),
          replay_(replay),
          catalogue_(catalogue),
          effects_(effects),
          models_(effects::active_models(setup)) {
        for (const std::string& name : effects)
            if (const effects::Effect* effect = effects::find_effect(catalogue, name)) {
                std::vector<double> values = effect->zeros();
                for (std::size_t j = 0; j < values.size(); ++j)
                    if (!effect->parameters[j].is_key()) values[j] = effect->parameters[j].typical;
                models_.push_back(effects::make_model(*effect, values));
            }
    }

    std::vector<std::string> best() {
        std::vector<std::size_t> open;
        for (std::size_t k = 0; k < replay_.unknown_sides().size(); ++k)
            if (matters(k)) open.push_back(k);
        if (open.empty()) return {};
        side_.assign(replay_.unknown_sides().size(), 1);
        double now = misfit();
        std::vector<double> worse(side_.size(), 0.0);
        for (bool changed = true; std::exchange(changed, false);)
            for (const std::size_t k : open) {
                turn(k);
                const double other = misfit();
                worse[k] = std::abs(other - now);
                if (other < now - 1e-9 * now)
                    now = other, changed = true;
                else
                    turn(k);
            }
        std::vector<std::string> notes;
        for (const std::size_t k : open) notes.push_back(note(k, worse[k]));
        return notes;
    }

  private:
    /// Some effect reads otherwise on the other side.
    bool matters(std::size_t k) const {
        for (const std::size_t i : replay_.unknown_sides()[k].rows) {
            kinematics::Perturbation plus, minus;
            AxisSample other = replay_.sample(i);
            other.travel[index_of(replay_.unknown_sides()[k].axis)] = -1;
            for (const auto& model : models_) {
                model->perturb(replay_.sample(i), replay_.contact(i), plus);
                model->perturb(other, replay_.contact(i), minus);
            }
            if (plus.axis != minus.axis) return true;
            for (std::size_t a = 0; a < axis_count; ++a)
                if (plus.motion[a].shift_mm != minus.motion[a].shift_mm) return true;
        }
        return false;
    }

    void turn(std::size_t k) {
        side_[k] = static_cast<signed char>(-side_[k]);
        replay_.assume_side(k, side_[k]);
    }

    double misfit() const {
        const BaseModel base = fit_base(setup_, table_, replay_, catalogue_, effects_);
        return base.residual_mm.cwiseQuotient(base.sigma_mm).squaredNorm();
    }

    std::string note(std::size_t k, double worse) const {
        const char side = side_[k] > 0 ? '+' : '-';
        const std::string name = setup_.machine.chain.names()[replay_.unknown_sides()[k].axis];
        if (worse < tells)
            return fmt::format(
                "{}: no row tells from which side {} came before its first motion, "
                "nor do the readings: taken as {}",
                table_.path, name, side);
        return fmt::format(
            "{}: before its first motion {} came travelling {} (the other side fits "
            "worse by {:.3g} in weighted squares)",
            table_.path, name, side, worse);
    }

    const setup::Setup& setup_;
    const records::ReadingTable& table_;
    emulator::Replay& replay_;
    const effects::Catalogue& catalogue_;
    const std::vector<std::string>& effects_;
    emulator::EffectModels models_;
    std::vector<signed char> side_;
};

}  // namespace

std::vector<std::string> choose_sides(const setup::Setup& setup, const records::ReadingTable& table,
                                      emulator::Replay& replay, const effects::Catalogue& catalogue,
                                      const std::vector<std::string>& effects) {
    return SideChoice(setup, table, replay, catalogue, effects).best();
}

}  // namespace trunnion::identification
