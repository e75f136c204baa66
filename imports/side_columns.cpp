#include "imports/side_columns.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "imports/columns.h"
#include "imports/units.h"

namespace trunnion::imports {
namespace {

using Words = std::set<std::string>;

bool any_of(const std::string& name, const Words& words) {
    const std::vector<std::string> list = words_of(name);
    return std::any_of(list.begin(), list.end(),
                       [&](const std::string& word) { return words.contains(word); });
}

/// Words of results that a list of single values may have too.
constexpr const char* result_words[] = {"reversal",
                                        "umkehrspanne",
                                        "umkehr",
                                        "hysteresis",
                                        "hysterese",
                                        "backlash",
                                        "lose",
                                        "repeatability",
                                        "wiederholgenauigkeit",
                                        "wiederholpraezision",
                                        "wiederholpr\xC3\xA4zision",
                                        "streuung",
                                        "spread",
                                        "scatter",
                                        "spannweite",
                                        "uncertainty",
                                        "unsicherheit",
                                        "standard",
                                        "stddev",
                                        "variance",
                                        "varianz",
                                        "mw",
                                        "stabw",
                                        "standardabweichung",
                                        "accuracy",
                                        "genauigkeit",
                                        "median",
                                        "maximum",
                                        "minimum",
                                        "count",
                                        "anzahl",
                                        "systematic",
                                        "systematisch",
                                        "tolerance",
                                        "toleranz",
                                        "limit",
                                        "grenze",
                                        "result",
                                        "results",
                                        "ergebnis",
                                        "ergebnisse",
                                        "statistics",
                                        "statistik",
                                        "summe",
                                        "sum",
                                        "mittlere",
                                        "means",
                                        "averages",
                                        "mittelwerte",
                                        "bidirectional",
                                        "deviation",
                                        "deviations",
                                        "abweichung",
                                        "error",
                                        "fehler",
                                        "diff",
                                        "difference",
                                        "differenz",
                                        "delta",
                                        "u",
                                        "\xCF\x83",
                                        "2\xCF\x83",
                                        "3\xCF\x83",
                                        "4\xCF\x83",
                                        "2s",
                                        "3s",
                                        "4s",
                                        "6s"};

const Words& more_results() {
    static const Words words(std::begin(result_words), std::end(result_words));
    return words;
}

bool is_plain_result(const std::string& name) {
    static const Words whole{"b",  "r", "m",  "e",  "a",  "s",  "2s", "4s",
                             "sd", "n", "bi", "ri", "mi", "ei", "ai", "si"};  // ISO 230-2: B_i ..
    static const Words words{"mean", "avg", "average",    "std", "stdev", "sigma",  "rms",
                             "max",  "min", "mittelwert", "s",   "range", "mittel", "xbar"};
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    const bool bar = has("x\xCC\x84") || has("x\xCC\x85");  // x with a bar above: a mean
    return bar || whole.contains(plain_name(name)) || any_of(name, words);
}

/// "Pos. Nr.", "No.", "#", "Index".
bool is_point_number(const std::string& name) {
    static const Words numbers{"no",    "nr",    "number", "nummer", "index",     "idx",  "i",
                               "n",     "id",    "lfd",    "line",   "zeile",     "step", "point",
                               "punkt", "count", "pt",     "row",    "messpunkt", "num"};
    static const Words beside{"pos", "position", "target", "ziel", "measuring", "of", "the"};
    const std::vector<std::string> list = words_of(name);
    if (list.empty()) return name == "#";
    return any_of(name, numbers) && std::all_of(list.begin(), list.end(), [&](const auto& word) {
               return numbers.contains(word) || beside.contains(word);
           });
}

bool is_remark(const std::string& name) {
    static const Words words{"remark", "remarks",   "bemerkung", "comment", "kommentar", "note",
                             "status", "operator",  "skip",      "ignore",  "unused",    "ok",
                             "notes",  "anmerkung", "quality",   "feed",    "vorschub"};
    return any_of(name, words);
}

}  // namespace

bool is_result(const TextColumn& column) {
    return is_plain_result(column.name);
}

bool is_condition(const TextColumn& column) {
    static const Words words{"temperature", "temp",          "pressure", "humidity", "time",
                             "temperatur",  "zeit",          "date",     "load",     "speed",
                             "datum",       "luftdruck",     "uhrzeit",  "druck",    "feuchte",
                             "last",        "lufttemperatur"};
    const auto unit = find_unit(column.unit);
    if (unit && unit->quantity != Quantity::length && unit->quantity != Quantity::angle)
        return true;
    return any_of(column.name, words);
}

bool is_beside_values(const TextColumn& column) {
    return is_condition(column) || is_point_number(column.name) || is_remark(column.name);
}

bool is_beside_runs(const TextColumn& column) {
    return is_result(column) || is_beside_values(column) || any_of(column.name, more_results());
}

bool is_result_row_name(const std::string& name) {
    static const Words figures{"e", "m", "b", "r", "a", "s", "up", "down", "bi", "uni", "dir"};
    const std::vector<std::string> list = words_of(name);
    const bool figure = !list.empty() && list.front() != "up" && list.front() != "down" &&
                        std::all_of(list.begin(), list.end(),
                                    [](const std::string& word) { return figures.contains(word); });
    return figure || is_plain_result(name) || any_of(name, more_results());
}

}  // namespace trunnion::imports
