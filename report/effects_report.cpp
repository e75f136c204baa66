#include "report/effects_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/rounded.h"
#include "report/json_values.h"
#include "report/paragraph.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

/// Without exponent and closing zeros: 20, 0.00002.
std::string as_typed(double value) {
    std::string text = three_digits(value);
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string parameter_name(const effects::EffectParameter& p) {
    return p.component < 0 ? p.name : fmt::format("{}[{}]", p.name, "xyz"[p.component]);
}

std::string headed_lines(const std::string& head, const std::string& words) {
    std::string text;
    constexpr std::size_t column = 10, width = 70;
    const auto lines = wrapped(words, width);
    for (std::size_t i = 0; i < lines.size(); ++i)
        text += fmt::format("{:<{}}{}\n", i == 0 ? head : "", column, lines[i]);
    return text;
}

}  // namespace

std::string effects_json(const std::vector<effects::Effect>& list,
                         const std::vector<FileRead>& inputs) {
    Json json{{"schema", "trunnion.effects/1"}, {"effects", Json::array()}};
    for (const effects::Effect& effect : list) {
        Json parameters = Json::array();
        for (const effects::EffectParameter& p : effect.parameters)
            parameters.push_back(
                {{"name", parameter_name(p)}, {"unit", p.unit}, {"typical", p.typical}});
        json["effects"].push_back({{"name", effect.name},
                                   {"what", effect.what},
                                   {"cause", effect.cause},
                                   {"remedy", effect.remedy},
                                   {"formula", effect.formula},
                                   {"parameters", parameters}});
    }
    add_inputs(json, inputs);
    return json_text(json, 2) + "\n";
}

std::string effect_text(const effects::Effect& effect) {
    std::string text = fmt::format("{}\n", effect.name);
    text += headed_lines("what", effect.what);
    text += headed_lines("cause", effect.cause);
    text += headed_lines("remedy", effect.remedy);
    text += headed_lines("formula", effect.formula);
    for (const effects::EffectParameter& p : effect.parameters)
        text += fmt::format("          {:<24} {:<8} typical {}\n", parameter_name(p), p.unit,
                            as_typed(p.typical));
    if (!effect.parameters.empty())
        text += fmt::format("example   --inject '{}: {}={}'\n", effect.name,
                            effect.parameters.front().name,
                            as_typed(effect.parameters.front().typical));
    return text;
}

std::string effects_text(const std::vector<effects::Effect>& list) {
    std::string text;
    for (const effects::Effect& effect : list) {
        const auto lines = wrapped(effect.what, 57);
        for (std::size_t i = 0; i < lines.size(); ++i)
            text += fmt::format("{:<22} {}\n", i == 0 ? effect.name : "", lines[i]);
    }
    return text;
}

}  // namespace trunnion::report
