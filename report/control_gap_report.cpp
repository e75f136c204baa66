#include "report/control_gap_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/rounded.h"
#include "base/text.h"
#include "report/json_values.h"
#include "report/paragraph.h"

namespace trunnion::report {

namespace {

using Json = nlohmann::ordered_json;

constexpr double much = 0.5;  ///< of a gap: a cause that is not sure is told with it

/// A difference of a place in mm or deg.
std::string apart_words(const choices::GapPlace& place) {
    return three_digits(place.apart, 4);
}

Json place_json(const choices::GapPlace& place) {
    return {{"program", valid_utf8(place.program)},
            {"line", place.line},
            {"block", valid_utf8(place.block)},
            {"apart_um", 1000.0 * place.apart},
            {"log_line", place.log_line}};
}

Json shrink_json(const choices::GapShrink& s, double noise_um) {
    return {{"rms_before_um", s.before_um},
            {"rms_after_um", s.after_um},
            {"noise_um", noise_um},
            {"shrink", s.shrink},
            {"ci95", {s.low, s.high}}};
}

Json blocks_json(const std::vector<choices::GapBlock>& blocks) {
    Json list = Json::array();
    for (const choices::GapBlock& b : blocks)
        list.push_back(
            {{"by", "block"},
             {"component", fmt::format("line {}", b.worst.line)},
             {"share", b.share},
             {"p_value", b.p_value},
             {"text", fmt::format("{}: up to {} mm or deg, {} % of the gap", place_words(b.worst),
                                  apart_words(b.worst), percent(b.share))},
             {"place", place_json(b.worst)}});
    return list;
}

Json cause_json(const choices::GapCause& cause, double noise_um) {
    Json parameters = Json::array();
    for (const choices::FittedNumber& n : cause.numbers)
        parameters.push_back({{"name", n.name},
                              {"value", n.to},
                              {"declared", n.from},
                              {"sigma", json_number(n.sigma)},
                              {"unit", n.unit}});
    return {{"effect", cause.name},
            {"probability", cause.probability},
            {"rivals", cause.rivals},
            {"parameters", parameters},
            {"share", cause.share},
            {"heldout", shrink_json(cause.heldout, noise_um)},
            {"what", cause.what},
            {"blocks", cause.blocks},
            {"first", place_json(cause.first)},
            {"worst", place_json(cause.worst)}};
}

std::string cause_text(const choices::GapCause& cause) {
    std::string out =
        fmt::format("\n{}  {} % of the gap, probability {}\n  {}\n", cause.name,
                    percent(cause.share), probability_words(cause.probability), cause.what);
    for (const choices::FittedNumber& n : cause.numbers) out += "  " + number_words(n) + '\n';
    out += paragraph(
        fmt::format("{} block{}; first at {}: {}; worst at {}: {} mm or deg", cause.blocks,
                    cause.blocks == 1 ? "" : "s", place_words(cause.first),
                    apart_words(cause.first), place_words(cause.worst), apart_words(cause.worst)),
        2);
    if (!cause.known) return out;
    if (!cause.rivals.empty())
        out += paragraph(
            fmt::format("this log cannot tell it from: {}", fmt::join(cause.rivals, ", ")), 2);
    return out + fmt::format("  held out: {} -> {}: shrinks by {} % ({} to {})\n",
                             length_words(cause.heldout.before_um),
                             length_words(cause.heldout.after_um), percent(cause.heldout.shrink),
                             percent(cause.heldout.low), percent(cause.heldout.high));
}

std::string blocks_text(const char* head, const std::vector<choices::GapBlock>& blocks) {
    std::string out = blocks.empty() ? "" : head;
    for (const choices::GapBlock& b : blocks)
        out += fmt::format("  {}: up to {} mm or deg, {} % of it\n", place_words(b.worst),
                           apart_words(b.worst), percent(b.share));
    return out;
}

/// Nothing differs but that the log ends.
bool agrees_up_to_stop(const choices::ControlGap& gap) {
    return gap.stands_there && gap.causes.size() == 1 &&
           gap.causes.front().first.line == gap.ends_before.line &&
           gap.causes.front().first.log_line == gap.ends_before.log_line;
}

/// A cause that would remove much, but is not sure, is said to be so.
std::string unexplained_words(const choices::ControlGap& gap) {
    const auto most = std::find_if(gap.causes.begin(), gap.causes.end(), [](const auto& cause) {
        return cause.known && cause.share >= much;
    });
    if (most == gap.causes.end()) return "; no choice and no store of this control explains it.";
    return fmt::format(
        "; no choice and no store of this control surely explains it ({} would "
        "remove {} %, probability {}).",
        most->name, percent(most->share), probability_words(most->probability));
}

}  // namespace

std::string place_words(const choices::GapPlace& place) {
    if (place.line == 0) return "the start";
    const std::string where = place.program.empty() ? "" : printable(place.program) + ", ";
    return fmt::format("{}line {} `{}`", where, place.line, printable(place.block));
}

std::string number_words(const choices::FittedNumber& n) {
    // To the digits of the found one: "from 10.1 to 10.000000" would tell another change.
    std::string from = rounded(n.from, n.sigma).value;
    if (from.find('.') != std::string::npos && from.find('e') == std::string::npos) {
        from.erase(from.find_last_not_of('0') + 1);
        if (from.back() == '.') from.pop_back();
    }
    return fmt::format("{} from {} to {}{}{}", n.name, from, with_sigma(n.to, n.sigma),
                       n.unit.empty() ? "" : " ", n.unit);
}

std::string verdict_sentence(const choices::ControlGap& gap) {
    using choices::GapVerdict;
    if (gap.verdict == GapVerdict::no_gap)
        return fmt::format("The control moves as the log says, within its noise{}.",
                           gap.ends_before.line == 0 ? std::string()
                                                     : "; it lacks the moves from " +
                                                           place_words(gap.ends_before) + " on");
    if (agrees_up_to_stop(gap))
        return fmt::format(
            "Log and control agree within the noise, but the log lacks the moves from {} on: the "
            "other control stopped there, or the log was cut off.",
            place_words(gap.ends_before));
    const std::string size = fmt::format("Log and control differ by {} rms, at most {} mm or deg",
                                         length_words(gap.rms_um), apart_words(gap.worst));
    if (gap.verdict == GapVerdict::unexplained) return size + unexplained_words(gap);
    std::vector<std::string> names;
    bool stays = false;
    for (const choices::GapCause& cause : gap.causes) {
        stays = stays || !cause.known;
        if (cause.known && choices::is_claimed(cause))
            names.push_back(cause.name + (cause.rivals.empty() ? "" : " (or a rival)"));
    }
    const bool one = names.size() <= 1;
    // Equal stores may all be below one half.
    if (names.empty()) names.emplace_back("One of several choices or stores");
    return fmt::format("{}. {} explain{} {} % of it on blocks left out{}.", size,
                       fmt::join(names, " and "), one ? "s" : "", percent(gap.explained),
                       stays ? "; what stays is more than noise" : "");
}

std::string control_gap_json(const choices::ControlGap& gap, const std::vector<FileRead>& inputs) {
    Json json{{"schema", "trunnion.diagnosis/1"},
              {"of", "control"},
              {"verdict", to_string(gap.verdict)},
              {"noise_source", to_string(gap.noise)},
              {"gap",
               {{"rms_um", gap.rms_um},
                {"noise_um", gap.noise_um},
                {"excess_um", gap.excess_um},
                {"p_value", gap.p_value},
                {"first", place_json(gap.first)},
                {"worst", place_json(gap.worst)}}}};
    json["where"] = blocks_json(gap.where);
    json["causes"] = Json::array();
    for (const choices::GapCause& cause : gap.causes)
        json["causes"].push_back(cause_json(cause, gap.noise_um));
    json["after"] = {{"rms_um", gap.after_rms_um},
                     {"explained", gap.explained},
                     {"heldout_shrink", gap.after.shrink},
                     {"ci95", {gap.after.low, gap.after.high}},
                     {"unexplained_share", 1.0 - gap.explained},
                     {"where", blocks_json(gap.left)}};
    json["setup"] = Json::array();
    json["next_measurement"] = Json::array();
    json["unseen"] = gap.unseen;
    json["rows"] = gap.rows;
    json["blocks"] = gap.blocks;
    json["stopped"] = gap.stopped;
    json["ends_before"] = gap.ends_before.line == 0 ? Json() : place_json(gap.ends_before);
    json["stands_there"] = gap.stands_there;
    add_inputs(json, inputs);
    return json.dump(1) + "\n";
}

std::string control_gap_text(const choices::ControlGap& gap) {
    std::string out =
        fmt::format("verdict: {}\n", to_string(gap.verdict)) + paragraph(verdict_sentence(gap), 0);
    out += fmt::format("{} positions in {} blocks, rms {}, noise {} ({})\n", gap.rows, gap.blocks,
                       length_words(gap.rms_um), length_words(gap.noise_um), to_string(gap.noise));
    if (!gap.stopped.empty()) out += "this control stops: " + printable(gap.stopped) + '\n';
    if (gap.verdict == choices::GapVerdict::no_gap) return out;
    out +=
        fmt::format("first at {}: {} mm or deg\n", place_words(gap.first), apart_words(gap.first));
    out += blocks_text("most of the gap:\n", gap.where);
    for (const choices::GapCause& cause : gap.causes) out += cause_text(cause);
    if (!gap.causes.empty())
        out +=
            "\n" + paragraph(fmt::format("after: rms {}; the gap shrinks by {} % ({} to {}) "
                                         "on blocks left out",
                                         length_words(gap.after_rms_um), percent(gap.after.shrink),
                                         percent(gap.after.low), percent(gap.after.high)),
                             0);
    out += gap.causes.empty() ? std::string() : blocks_text("what stays:\n", gap.left);
    return out;
}

}  // namespace trunnion::report
