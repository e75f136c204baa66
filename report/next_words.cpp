#include "report/next_words.h"

#include <algorithm>
#include <utility>

namespace trunnion::report {
namespace {

using Rivals = std::pair<std::string, std::vector<std::string>>;

/// A text around the names of the pair: "to tell " A " from " B ": touch a sphere ..".
struct Sentence {
    std::string begin, end, program;
    std::vector<Rivals> pairs;  ///< names in their order, each with its rivals
};

Sentence sentence_of(const diagnosis::NextMeasurement& next) {
    const std::string names = next.first + " from " + next.second;
    const std::size_t at = next.text.find(names);
    if (at == std::string::npos) return {next.text, "", next.program, {}};
    return {next.text.substr(0, at),
            next.text.substr(at + names.size()),
            next.program,
            {{next.first, {next.second}}}};
}

bool alike(const Sentence& a, const Sentence& b) {
    return !a.pairs.empty() && !b.pairs.empty() && a.begin == b.begin && a.end == b.end &&
           a.program == b.program;
}

void add(Sentence& to, const Rivals& pair) {
    const auto same = std::find_if(to.pairs.begin(), to.pairs.end(),
                                   [&](const Rivals& known) { return known.first == pair.first; });
    if (same == to.pairs.end())
        to.pairs.push_back(pair);
    else
        same->second.push_back(pair.second.front());
}

std::string words_of(const Sentence& sentence) {
    std::string names;
    for (const auto& [name, rivals] : sentence.pairs) {
        names += (names.empty() ? "" : "; ") + name + " from ";
        for (std::size_t k = 0; k < rivals.size(); ++k) names += (k > 0 ? ", " : "") + rivals[k];
    }
    return sentence.begin + names + sentence.end;
}

}  // namespace

std::vector<PlannedMeasurement> planned_measurements(const diagnosis::Diagnosis& d) {
    std::vector<Sentence> sentences;
    for (const diagnosis::NextMeasurement& next : d.next) {
        Sentence one = sentence_of(next);
        const auto known = std::find_if(sentences.begin(), sentences.end(),
                                        [&](const Sentence& s) { return alike(s, one); });
        if (known == sentences.end())
            sentences.push_back(std::move(one));
        else
            add(*known, one.pairs.front());
    }
    std::vector<PlannedMeasurement> list;
    for (const Sentence& s : sentences) list.push_back({words_of(s), s.program});
    return list;
}

}  // namespace trunnion::report
