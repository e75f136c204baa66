#include "effects/settings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/alarm.h"
#include "base/nearest.h"
#include "base/read_file.h"
#include "base/toml_reader.h"
#include "base/units.h"
#include "effects/effect_names.h"
#include "emulator/control_compensation.h"

namespace trunnion::effects {
namespace {

struct Unit {
    const char* name;
    const char* base;
    double factor;
};

constexpr Unit units[] = {{"um", "mm", 1e-3},
                          {"mm", "mm", 1.0},
                          {"m", "mm", 1e3},
                          {"urad", "rad", 1e-6},
                          {"mrad", "rad", 1e-3},
                          {"rad", "rad", 1.0},
                          {"arcsec", "rad", pi / 648000.0},
                          {"deg", "deg", 1.0},
                          {"ppm", "ppm", 1.0},
                          {"us", "s", 1e-6},
                          {"ms", "s", 1e-3},
                          {"s", "s", 1.0}};

[[noreturn]] void refuse(const std::string& message, const std::string& text, std::size_t at) {
    throw InputError(message, {"--inject", 1, static_cast<int>(at) + 1}, text);
}

/// Parses "name", "=", numbers and units of one option.
class Scanner {
  public:
    explicit Scanner(const std::string& text) : text_(text) {}

    void skip() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    }
    bool take(char c) {
        skip();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    bool done() {
        skip();
        return at_ >= text_.size();
    }
    std::string word() {
        skip();
        word_ = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                      text_[at_] == '.' || text_[at_] == '_'))
            ++at_;
        return text_.substr(word_, at_ - word_);
    }
    double number(const std::string& unit) {
        skip();
        char* end = nullptr;
        const double value = std::strtod(text_.c_str() + at_, &end);
        const auto stop = static_cast<std::size_t>(end - text_.c_str());
        if (stop == at_) fail("a number is missing");
        const std::size_t start = std::exchange(at_, stop);
        const double in_unit = value * factor_of_unit(unit);
        if (std::isfinite(in_unit)) return in_unit;
        at_ = start;
        fail("this is not a finite number");
    }
    std::vector<double> numbers(const std::string& unit) {
        if (!take('[')) return {number(unit)};
        std::vector<double> list;
        do list.push_back(number(unit));
        while (take(','));
        if (!take(']')) fail("']' is missing");
        return list;
    }
    [[noreturn]] void fail(const std::string& message) const { refuse(message, text_, at_); }
    /// At the word read last.
    [[noreturn]] void fail_word(const std::string& message) const { refuse(message, text_, word_); }

  private:
    /// Factor of the unit after a number, in the parameter's unit.
    double factor_of_unit(const std::string& unit) {
        const std::size_t before = at_;
        skip();
        const bool micro = text_.compare(at_, 2, "µ") == 0;  // as reports print it
        if (micro) at_ += 2;
        const std::string name = (micro ? "u" : "") + word();
        if (name.empty() || name == unit) return 1.0;
        for (const Unit& u : units)
            if (name == u.name && unit == u.base) return u.factor;
        if (name == "deg" && unit == "rad") return rad_from_deg(1.0);
        at_ = before;
        fail("unit '" + name + "' does not fit a parameter in " + unit);
    }

    const std::string& text_;
    std::size_t at_ = 0, word_ = 0;
};

bool is_set_by(const EffectParameter& p, const std::string& name) {
    return p.name == name || (!name.empty() && p.also_set_by == name);
}

const EffectParameter* find_parameter(const Effect& effect, const std::string& name) {
    for (const EffectParameter& p : effect.parameters)
        if (is_set_by(p, name)) return &p;
    return nullptr;
}

std::vector<std::string> names_of(const Effect& effect) {
    std::vector<std::string> names;
    for (const EffectParameter& p : effect.parameters) names.push_back(p.name);
    return names;
}

}  // namespace

setup::EffectSetting parse_injection(const std::string& text, const Catalogue& catalogue) {
    Scanner scan(text);
    setup::EffectSetting setting;
    setting.name = scan.word();
    const Effect* effect = find_effect(catalogue, setting.name);
    if (!effect)
        scan.fail_word("no effect is named '" + setting.name + "'" +
                       did_you_mean(setting.name, names_of(catalogue)));
    if (effect->parameters.empty()) scan.fail_word("this machine has nothing for " + setting.name);
    if (scan.take('=')) {
        const EffectParameter& first = effect->parameters.front();
        setting.parameters[first.name] = scan.numbers(first.unit);
    } else if (scan.take(':')) {
        do {
            const std::string name = scan.word();
            const EffectParameter* parameter = find_parameter(*effect, name);
            if (!parameter)
                scan.fail_word(setting.name + " has no parameter '" + name + "'" +
                               did_you_mean(name, names_of(*effect)));
            if (!scan.take('=')) scan.fail("'=' is missing after " + name);
            setting.parameters[name] = scan.numbers(parameter->unit);
        } while (scan.take(','));
    } else if (scan.done()) {
        scan.fail_word(setting.name + " without a value does nothing: " + setting.name + ": " +
                       effect->parameters.front().name + "=...");
    }
    if (!scan.done()) scan.fail("this is not understood");
    try {
        values_of(*effect, setting);
    } catch (const InputError& error) {
        refuse(error.message, text, 0);
    }
    return setting;
}

std::vector<double> values_of(const Effect& effect, const setup::EffectSetting& setting) {
    std::vector<double> values = effect.zeros();
    for (const auto& [name, list] : setting.parameters) {
        std::size_t used = 0;
        for (std::size_t j = 0; j < values.size(); ++j) {
            const EffectParameter& p = effect.parameters[j];
            if (!is_set_by(p, name)) continue;
            const auto k = static_cast<std::size_t>(std::max(0, p.component));
            if (k < list.size()) values[j] = list[k];
            used = std::max(used, k + 1);
        }
        if (used == 0)
            throw InputError("effect " + effect.name + " has no parameter '" + name + "'");
        if (list.size() != used)
            throw InputError("parameter " + name + " of " + effect.name + " expects " +
                             std::to_string(used) + (used == 1 ? " value" : " values"));
    }
    return values;
}

setup::EffectSetting setting_of(const Effect& effect, const std::vector<double>& values) {
    setup::EffectSetting setting{effect.name, {}};
    for (std::size_t j = 0; j < values.size(); ++j)
        setting.parameters[effect.parameters[j].name].push_back(values[j]);
    std::erase_if(setting.parameters, [&](const auto& entry) {
        const EffectParameter* parameter = find_parameter(effect, entry.first);
        if (parameter && parameter->is_key()) return false;
        return std::all_of(entry.second.begin(), entry.second.end(),
                           [](double v) { return v == 0.0; });
    });
    return setting;
}

namespace {

/// The file of the setup, read again to report positions in it.
TomlFile file_of(const setup::Setup& setup) {
    return {read_file(setup.path), setup.path};
}

const TomlValue* find_value(const TomlValue* table, const std::string& key) {
    return table ? table->find(key) : nullptr;
}

[[noreturn]] void refuse_parameter(const setup::Setup& setup, const std::string& effect,
                                   const std::string& parameter, const std::string& message) {
    const TomlFile file = file_of(setup);
    const TomlValue* table = find_value(file.root().find("effects"), effect);
    if (const TomlValue* value = find_value(table, parameter)) file.fail(*value, message);
    throw InputError("[effects]: " + message, {setup.path, 0, 0});
}

/// Checks each parameter separately, for its position.
void check_parameters(const setup::Setup& setup, const Effect& effect,
                      const setup::EffectSetting& setting) {
    for (const auto& parameter : setting.parameters) try {
            values_of(effect, {setting.name, {parameter}});
        } catch (const InputError& error) {
            refuse_parameter(setup, setting.name, parameter.first, error.message);
        }
}

}  // namespace

void refuse_effect_name(const setup::Setup& setup, const std::string& name) {
    const std::string message =
        "no effect is named '" + name + "'" + did_you_mean(name, names_of(make_catalogue(setup)));
    const TomlFile file = file_of(setup);
    if (const TomlValue* effect = find_value(file.root().find("effects"), name))
        file.fail(*effect, message);
    if (const TomlValue* list = find_value(file.root().find("model"), "modelled"))
        for (const TomlValue& item : list->items)
            if (item.text == name) file.fail(item, message);
    throw InputError(message);
}

namespace {

/// The play of an axis where it depends on the place.
class PlayOverPlace final : public emulator::EffectModel {
  public:
    PlayOverPlace(EffectFunction backlash, Axis axis, kinematics::ErrorCurve gap)
        : backlash_(std::move(backlash)), axis_(axis), gap_(std::move(gap)) {}
    void perturb(const AxisSample& sample, const emulator::Contact& contact,
                 kinematics::Perturbation& out) const override {
        backlash_(sample, contact, std::array{gap_(sample.position[axis_])}, out);
    }

  private:
    EffectFunction backlash_;
    Axis axis_;
    kinematics::ErrorCurve gap_;
};

bool has_gaps(const setup::Setup& setup) {
    return std::any_of(setup.gap.begin(), setup.gap.end(),
                       [](const kinematics::ErrorCurve& gap) { return !gap.is_zero(); });
}

}  // namespace

emulator::EffectModels active_models(const setup::Setup& setup) {
    emulator::EffectModels models;
    if (auto compensation = emulator::control_compensation(setup))
        models.push_back(std::move(compensation));
    if (setup.effects.empty() && !has_gaps(setup)) return models;
    const Catalogue catalogue = make_catalogue(setup);
    for (const Effect& effect : catalogue)
        if (effect.kind == EffectKind::backlash && !setup.gap[index_of(*effect.axis)].is_zero())
            models.push_back(std::make_shared<PlayOverPlace>(effect.add, *effect.axis,
                                                             setup.gap[index_of(*effect.axis)]));
    for (const setup::EffectSetting& setting : setup.effects) {
        const Effect* effect = find_effect(catalogue, setting.name);
        if (!effect) refuse_effect_name(setup, setting.name);
        check_parameters(setup, *effect, setting);
        models.push_back(make_model(*effect, values_of(*effect, setting)));
    }
    return models;
}

}  // namespace trunnion::effects
