// Findings of one file: sorted, one for each cause.
#include <fmt/format.h>

#include <algorithm>

#include "check/section.h"

namespace trunnion::check {

namespace {

/// Numbers farther apart than this belong to different ranges.
constexpr int same_range = 100;
constexpr std::size_t few = 3;

std::string name_of(const Numbered& what, int number) {
    return fmt::format("{}{:0{}}", what.letter, number, what.letter[0] == 'O' ? 4 : 1);
}

std::string with_names(std::string text, const std::string& names) {
    return text.replace(text.find('*'), 1, names);
}

/// The places of one range by number, each by its index among the findings.
using Range = std::map<int, std::vector<std::size_t>>;

std::string names_of(const Range& range, const Numbered& what) {
    const int first = range.begin()->first, last = range.rbegin()->first;
    const auto count = static_cast<int>(range.size());
    if (range.size() > few)
        return fmt::format("{} to {} ({}{} of them)", name_of(what, first), name_of(what, last),
                           last - first + 1 == count ? "all " : "", count);
    std::string names;
    for (const auto& [number, places] : range)
        names += (names.empty() ? "" : ", ") + name_of(what, number);
    return names;
}

/// Leaves the first place of the range if there are more than a few.
void merge(const Range& range, std::vector<Findings::Found>& found,
           std::set<std::size_t>& dropped) {
    std::set<std::size_t> places;
    for (const auto& [number, where] : range) places.insert(where.begin(), where.end());
    if (range.size() < 2 || places.size() <= few) return;
    Findings::Found& first = found[*places.begin()];
    first.finding.text = with_names(first.what->many, names_of(range, *first.what)) +
                         fmt::format(", in {} places, last in line {}", places.size(),
                                     found[*places.rbegin()].finding.line);
    dropped.insert(std::next(places.begin()), places.end());
}

/// Near numbers of one cause in one finding.
std::vector<Finding> one_for_each_range(std::vector<Findings::Found> found) {
    std::map<std::string, Range> causes;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (const auto& what = found[i].what) causes[what->one][what->number].push_back(i);
    std::set<std::size_t> dropped;
    for (const auto& [cause, numbers] : causes) {
        Range range;
        const auto close = [&] {
            merge(range, found, dropped);
            range.clear();
        };
        for (const auto& [number, places] : numbers) {
            if (!range.empty() && number - range.rbegin()->first > same_range) close();
            range[number] = places;
        }
        close();
    }
    std::vector<Finding> kept;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!dropped.contains(i)) kept.push_back(std::move(found[i].finding));
    return kept;
}

/// What makes findings equal: rule and text; of an arc the text without its lengths, because one
/// cause (centres as places, a wrong plane) makes each arc wrong by another length.
std::pair<std::string, std::string> cause_of(const Finding& finding) {
    std::string text = finding.text;
    if (finding.rule == "arc-radius")
        std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '-'; });
    return {finding.rule, text};
}

/// If there are more than a few equal findings (notes: more than one), only the first is kept, with
/// their number.
std::vector<Finding> one_for_each_cause(std::vector<Finding> found) {
    std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> same;
    for (std::size_t i = 0; i < found.size(); ++i) same[cause_of(found[i])].push_back(i);
    std::set<std::size_t> dropped;
    for (const auto& [cause, places] : same) {
        const bool note = found[places.front()].severity == Severity::note;
        if (places.size() <= (note ? 1 : few)) continue;
        found[places.front()].text +=
            fmt::format(" ({} times, last in line {})", places.size(), found[places.back()].line);
        dropped.insert(places.begin() + 1, places.end());
    }
    std::vector<Finding> kept;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!dropped.contains(i)) kept.push_back(std::move(found[i]));
    return kept;
}

}  // namespace

void Findings::add(const char* rule, Severity severity, BlockPlace place, std::string text,
                   std::string remedy) {
    add({rule, severity, program_.source.name, place.block.line, std::max(1, place.column),
         std::move(text), std::move(remedy)});
}

void Findings::add(const char* rule, BlockPlace place, Numbered what, std::string remedy) {
    add(rule, Severity::error, place, with_names(what.one, name_of(what, what.number)),
        std::move(remedy));
    found_.back().what = std::move(what);
}

bool Findings::has_error(int line) const {
    return std::any_of(found_.begin(), found_.end(), [&](const Found& f) {
        return f.finding.line == line && f.finding.severity == Severity::error;
    });
}

bool Findings::has(const std::string& rule, int line) const {
    return std::any_of(found_.begin(), found_.end(), [&](const Found& f) {
        return f.finding.line == line && f.finding.rule == rule;
    });
}

std::vector<Finding> Findings::take() {
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
        return a.finding.line != b.finding.line ? a.finding.line < b.finding.line
                                                : a.finding.column < b.finding.column;
    });
    return one_for_each_cause(one_for_each_range(std::move(found_)));
}

}  // namespace trunnion::check
