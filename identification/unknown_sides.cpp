#include "identification/unknown_sides.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "effects/settings.h"

namespace trunnion::identification {
namespace {

constexpr double tells = 4.0;  ///< difference of the weighted squares: two sigma

std::string name_of(const emulator::Replay& replay, const records::ReadingTable& table,
                    std::size_t open) {
    const emulator::UnknownSide& side = replay.unknown_sides()[open];
    const std::string& session = table.rows[replay.table_row(side.rows.front())].session;
    if (session.empty()) return table.names[side.axis];
    return table.names[side.axis] + " of " + session;
}

/// Unknown sides that influence one of the models, with the present assumption of the replay.
std::vector<FoundSide> seen_sides(const emulator::Replay& replay,
                                  const records::ReadingTable& table,
                                  const std::vector<std::size_t>& open,
                                  const emulator::EffectModels& models) {
    std::vector<FoundSide> list;
    for (const std::size_t k : open)
        for (const auto& model : models)
            if (sees_side(replay, k, *model)) {
                list.push_back({k, name_of(replay, table, k), replay.side(k)});
                break;
            }
    return list;
}

/// Reverses one side after the other until no reversal improves the fit.
void settle(std::vector<FoundSide>& sides, emulator::Replay& replay,
            const std::function<double()>& misfit) {
    if (sides.empty()) return;
    double now = misfit();
    for (bool changed = true; std::exchange(changed, false);)
        for (FoundSide& found : sides) {
            const auto other = static_cast<signed char>(-found.side);
            replay.assume_side(found.open, other);
            const double turned = misfit();
            found.worse = std::abs(turned - now);
            if (turned < now - 1e-9 * now) {
                now = turned;
                found.side = other;
                changed = true;
            } else {
                replay.assume_side(found.open, found.side);
            }
        }
}

}  // namespace

std::shared_ptr<const emulator::EffectModel> usual_model(const effects::Effect& effect,
                                                         std::vector<double> values) {
    for (std::size_t j = 0; j < values.size(); ++j)
        if (!effect.parameters[j].is_key()) values[j] = effect.parameters[j].typical;
    return effects::make_model(effect, std::move(values));
}

bool FoundSide::told() const {
    return worse >= tells;
}

double FoundSide::value() const {
    return side * std::tanh(0.25 * worse);
}

double FoundSide::sigma() const {
    return std::sqrt(1.0 - value() * value());
}

std::string to_string(const FoundSide& found) {
    const char side = found.side > 0 ? '+' : '-';
    if (!found.told())
        return fmt::format(
            "no row tells from which side {} came before its first motion, "
            "nor do the readings: taken as {}",
            found.axis, side);
    std::string words = fmt::format(
        "before its first motion {} came travelling {} (the other side fits "
        "worse by {:.3g} in weighted squares)",
        found.axis, side, found.worse);
    // The head line is of the first session.
    if (found.side < 0 && found.axis.find(" of ") == std::string::npos)
        words += fmt::format("; `predict` takes + unless the table has the line `# side = {}-`",
                             found.axis);
    return words;
}

std::string sides_taken_as_plus(const setup::Setup& setup, const records::ReadingTable& table) {
    const emulator::EffectModels models = effects::active_models(setup);
    if (models.empty()) return {};
    const emulator::Replay replay(setup, table);
    std::vector<std::size_t> open(replay.unknown_sides().size());
    std::iota(open.begin(), open.end(), 0);
    std::string names;
    for (const FoundSide& side : seen_sides(replay, table, open, models))
        names += (names.empty() ? "" : ", ") + side.axis;
    return names;
}

bool sees_side(const emulator::Replay& replay, std::size_t open,
               const emulator::EffectModel& model) {
    const emulator::UnknownSide& side = replay.unknown_sides()[open];
    for (const std::size_t i : side.rows) {
        kinematics::Perturbation plus, minus;
        AxisSample at = replay.sample(i);
        at.travel[index_of(side.axis)] = 1;
        model.perturb(at, replay.contact(i), plus);
        at.travel[index_of(side.axis)] = -1;
        model.perturb(at, replay.contact(i), minus);
        if (plus.axis != minus.axis) return true;
        for (std::size_t a = 0; a < axis_count; ++a)
            if (plus.motion[a].shift_mm != minus.motion[a].shift_mm) return true;
    }
    return false;
}

std::vector<FoundSide> choose_sides(const setup::Setup& setup, const records::ReadingTable& table,
                                    emulator::Replay& replay, const effects::Catalogue& catalogue,
                                    const std::vector<std::string>& effects) {
    emulator::EffectModels models = effects::active_models(setup);
    for (const std::string& name : effects)
        if (const effects::Effect* effect = effects::find_effect(catalogue, name))
            models.push_back(usual_model(*effect, effect->zeros()));
    std::vector<std::size_t> open(replay.unknown_sides().size());
    for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
    std::vector<FoundSide> sides = seen_sides(replay, table, open, models);
    settle(sides, replay, [&] {
        const BaseModel base = fit_base(setup, table, replay, catalogue, effects);
        return base.residual_mm.cwiseQuotient(base.sigma_mm).squaredNorm();
    });
    return sides;
}

std::vector<FoundSide> choose_sides_beside(const BaseModel& base,
                                           const records::ReadingTable& table,
                                           const std::vector<KeyedEffect>& effects,
                                           const std::vector<std::size_t>& open,
                                           emulator::Replay& replay) {
    emulator::EffectModels models;
    for (const KeyedEffect& e : effects) models.push_back(usual_model(*e.effect, e.values));
    std::vector<FoundSide> sides = seen_sides(replay, table, open, models);
    const double all = base.residual_mm.cwiseQuotient(base.sigma_mm).squaredNorm();
    settle(sides, replay, [&] { return all - explained(replay, base, effects); });
    return sides;
}

}  // namespace trunnion::identification
