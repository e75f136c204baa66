#include "identification/unknowns.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "effects/settings.h"
#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion {

using Slot = Unknowns::Slot;

namespace {

/// "stylus+60.": a longer stylus or cup, followed by a direction.
std::string extension_name(bool stylus, double extension_mm) {
    return fmt::format("{}{:+}.", stylus ? "stylus" : "cup", extension_mm);
}

double set_up_derivative(const Slot& slot, const Contact& contact, const Perturbation& gradient) {
    if (slot.artefact >= 0)
        return contact.artefact == slot.artefact ? gradient.work_shift_mm(slot.axis) : 0.0;
    const bool stylus = contact.device != Device::ballbar;
    if (slot.extension_mm != 0.0)
        return slot.extension_mm == contact.extension_mm && slot.stylus == stylus
                   ? gradient.tip_shift_mm(slot.axis)
                   : 0.0;
    if (stylus) return 0.0;
    return slot.axis < 3 ? gradient.tip_shift_mm(slot.axis) : -1.0;
}

ExtensionErrors difference(const ExtensionErrors& from, ExtensionErrors to) {
    for (auto& [length_mm, shift] : to)
        if (const auto it = from.find(length_mm); it != from.end()) shift -= it->second;
    return to;
}

/// The slot of "stylus+60" or "cup+60".
void read_extension(const std::string& owner, Slot& slot) {
    const auto sign = owner.find_first_of("+-");
    if (sign == std::string::npos) return;
    const std::string word = owner.substr(0, sign);
    const auto length = parse_number(owner.substr(owner[sign] == '+' ? sign + 1 : sign));
    if (!length || (word != "stylus" && word != "cup")) return;
    slot.extension_mm = *length;
    slot.stylus = word == "stylus";
}

}  // namespace

Unknowns::Unknowns(const Setup& setup, const Replay& replay, const Catalogue& catalogue,
                   const std::vector<std::string>& effects)
    : setup_(setup) {
    for (const std::string& name : effects) add_effect_unknowns(catalogue, name);
    add_set_up(replay);
}

void Unknowns::add_effect_unknowns(const Catalogue& catalogue, const std::string& name) {
    const Effect* effect = find_effect(catalogue, name);
    if (!effect) refuse_effect_name(setup_, name);
    for (std::size_t j = 0; j < effect->parameters.size(); ++j) {
        const EffectParameter& p = effect->parameters[j];
        if (p.is_key()) continue;
        Slot slot;
        slot.effect = effect;
        slot.parameter = j;
        slot.fit = {name, p.name, p.unit, p.component, p.typical, 0.0, 0.0, 0.0, 0.0};
        add_prior(slot.fit);
        slots_.push_back(slot);
    }
}

void Unknowns::add_prior(FitParameter& fit) const {
    if (fit.effect != "location") return;
    const auto it = setup_.model.calibration.find(fit.name.substr(0, 4));
    if (it == setup_.model.calibration.end()) return;
    fit.prior_value = it->second.value;
    fit.prior_sigma = it->second.sigma;
}

void Unknowns::add_set_up(const Replay& replay) {
    std::vector<bool> used(setup_.artefacts.size(), false);
    bool bar = false;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        used[static_cast<std::size_t>(replay.contact(i).artefact)] = true;
        bar = bar || replay.contact(i).device == Device::ballbar;
    }
    for (std::size_t k = 0; k < used.size(); ++k)
        if (used[k] && setup_.artefacts[k].free_center)
            for (int d = 0; d < 3; ++d)
                push_set_up(setup_.artefacts[k].name + "." + "xyz"[d] + "_mm", static_cast<int>(k),
                            d);
    if (bar && setup_.ballbar->free_cup)
        for (int d = 0; d < 3; ++d) push_set_up(std::string("cup.") + "xyz"[d] + "_mm", -1, d);
    if (bar && setup_.ballbar->free_length) push_set_up("length_mm", -1, 3);
    add_extensions(replay);
}

/// A longer stylus or cup hangs only roughly below the usual one.
void Unknowns::add_extensions(const Replay& replay) {
    std::set<std::pair<bool, double>> used;
    for (std::size_t i = 0; i < replay.size(); ++i)
        if (const Contact& c = replay.contact(i); c.extension_mm != 0.0)
            used.insert({c.device != Device::ballbar, c.extension_mm});
    for (const auto& [stylus, extension_mm] : used)
        for (int d = 0; d < 3; ++d) {
            push_set_up(extension_name(stylus, extension_mm) + "xyz"[d] + "_mm", -1, d);
            slots_.back().extension_mm = extension_mm;
            slots_.back().stylus = stylus;
        }
}

void Unknowns::push_set_up(const std::string& name, int artefact, int axis) {
    Slot slot;
    slot.artefact = artefact;
    slot.axis = axis;
    slot.fit = {"setup", name, "mm", -1, 0.1, 0.0, 0.0, 0.0, 0.0};
    slots_.push_back(slot);
}

Eigen::MatrixXd columns_of(const std::vector<Slot>& slots, const Replay& replay,
                           const std::vector<Perturbation>& gradient) {
    const auto n = static_cast<Eigen::Index>(replay.size());
    Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(slots.size()));
    for (std::size_t j = 0; j < slots.size(); ++j) {
        const auto c = static_cast<Eigen::Index>(j);
        if (slots[j].effect) {
            columns.col(c) = effect_column(replay, gradient, *slots[j].effect,
                                           slots[j].effect->zeros(), slots[j].parameter);
            continue;
        }
        for (std::size_t i = 0; i < replay.size(); ++i)
            columns(static_cast<Eigen::Index>(i), c) =
                slots[j].fit.typical * set_up_derivative(slots[j], replay.contact(i), gradient[i]);
    }
    return columns;
}

Vector3& extension_error(Setup& setup, const Slot& slot) {
    ExtensionErrors& errors =
        slot.stylus ? setup.probe->extension_errors : setup.ballbar->extension_errors;
    return errors.try_emplace(slot.extension_mm, Vector3::Zero()).first->second;
}

void apply_step(Setup& setup, const std::vector<Slot>& slots, const Eigen::VectorXd& step) {
    std::map<const Effect*, std::vector<double>> by_effect;
    for (std::size_t j = 0; j < slots.size(); ++j) {
        const double by = step(static_cast<Eigen::Index>(j));
        const Slot& slot = slots[j];
        if (slot.effect) {
            auto& values = by_effect[slot.effect];
            if (values.empty()) values = slot.effect->zeros();
            values[slot.parameter] = by;
        } else if (slot.artefact >= 0) {
            setup.artefacts[static_cast<std::size_t>(slot.artefact)].center_W_mm(slot.axis) += by;
        } else if (slot.extension_mm != 0.0) {
            extension_error(setup, slot)(slot.axis) += by;
        } else if (slot.axis < 3) {
            setup.ballbar->cup_S_mm(slot.axis) += by;
        } else {
            setup.ballbar->length_mm += by;
        }
    }
    for (const auto& [effect, values] : by_effect) add_effect(setup, *effect, values);
}

ReplayOffsets offsets_between(const Setup& from, const Setup& to) {
    ReplayOffsets offsets;
    for (std::size_t k = 0; k < from.artefacts.size(); ++k)
        offsets.artefact_W.push_back(to.artefacts[k].center_W_mm - from.artefacts[k].center_W_mm);
    if (from.probe)
        offsets.stylus_S = difference(from.probe->extension_errors, to.probe->extension_errors);
    if (!from.ballbar) return offsets;
    offsets.long_cup_S = difference(from.ballbar->extension_errors, to.ballbar->extension_errors);
    offsets.cup_S = to.ballbar->cup_S_mm - from.ballbar->cup_S_mm;
    offsets.length = to.ballbar->length_mm - from.ballbar->length_mm;
    return offsets;
}

void shift_base(Setup& setup, const BaseModel& base, const Catalogue& catalogue,
                const Eigen::VectorXd& step) {
    std::vector<Slot> slots;
    for (const FitParameter& p : base.parameters) {
        Slot slot;
        slot.fit = p;
        if (p.effect != "setup") {
            slot.effect = find_effect(catalogue, p.effect);
            for (std::size_t j = 0; j < slot.effect->parameters.size(); ++j)
                if (slot.effect->parameters[j].name == p.name &&
                    slot.effect->parameters[j].component == p.component)
                    slot.parameter = j;
        } else if (p.name == "length_mm") {
            slot.axis = 3;
        } else {
            const auto dot_at = p.name.rfind('.');
            slot.axis = p.name[dot_at + 1] - 'x';
            const std::string owner = p.name.substr(0, dot_at);
            read_extension(owner, slot);
            for (std::size_t k = 0; k < setup.artefacts.size(); ++k)
                if (setup.artefacts[k].name == owner && p.typical > 0.0 && owner != "cup")
                    slot.artefact = static_cast<int>(k);
        }
        slots.push_back(slot);
    }
    Eigen::VectorXd by = step;
    for (Eigen::Index j = 0; j < by.size(); ++j)
        by(j) *= slots[static_cast<std::size_t>(j)].fit.typical;
    apply_step(setup, slots, by);
}

}  // namespace trunnion
