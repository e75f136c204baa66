#include "interpreter/word_rules.h"

#include <algorithm>
#include <cmath>

namespace trunnion::interpreter {

namespace {

constexpr double any = 99999999.0;

constexpr WordRule rows[] = {
    {0, 0, 'T'},
    {0, 0, 'H'},
    {0, 0, 'D'},
    {0, 0, 'S', false},
    {'G', 40, 'P'},
    {'G', 40, 'X', false},
    {'G', 40, 'U', false},
    {'G', 100, 'L'},
    {'G', 100, 'P'},
    {'G', 300, 'P', true, true, 4, 2, 46},
    {'G', 531, 'P', true, true, 2, 0, 5458},
    {'G', 536, 'P', true, true, 2, 0, 5458},
    {'G', 541, 'P', true, true, 300, 1, 31, 31},
    {'G', 542, 'P', true, true, 8, 0, 31, 31},
    {'G', 682, 'P'},
    {'G', 682, 'Q'},
    {'G', 684, 'P'},
    {'G', 684, 'Q'},
    {'G', 960, 'P'},
    {'G', 650, 'P', true, true, any, 0, 3, 76},
    {'G', 650, 'L'},
    {'G', 660, 'P', true, true, any, 0, 3, 76},
    {'G', 660, 'L'},
    {'G', 661, 'P', true, true, any, 0, 3, 76},
    {'G', 661, 'L'},
    {'M', 980, 'P', true, true, 999999999.0, 0, 3, 76},
    {'M', 980, 'L'},
    {'M', 980, 'Q', true, true, 999999999.0},
    {'M', 1980, 'P', true, true, 999999999.0, 0, 3, 76},
    {'M', 1980, 'L'},
    {'M', 990, 'P', true, true, 999999999.0},
    {'M', 990, 'L'},
};

/// Common rules of the canned cycles.
constexpr WordRule cycle_rows[] = {{'G', 730, 'P'}, {'G', 730, 'K'}, {'G', 730, 'L'}};

int code10_of(const WordValue& word) {
    const double tenfold = word.value * 10.0;
    return tenfold >= 0.0 && tenfold < 1e6 ? static_cast<int>(tenfold + 0.5) : -1;
}

bool is_fanuc_alone(const WordRule& rule) {
    return rule.letter == 'P' && (rule.code10 == 40 || rule.code10 == 682 || rule.code10 == 730);
}

/// The codes of a block; there are few, so a linear scan is fast.
class Codes {
  public:
    explicit Codes(const BlockWords& block) : block_(block) {
        for (const WordValue& w : block)
            if (w.letter == 'G' && !w.vacant) {
                const int code = code10_of(w);
                calls = calls || code == 650 || code == 660 || code == 661;
                cycles = cycles || (code >= 730 && code <= 890 && code != 800 && code % 10 == 0);
            }
    }
    bool has(const WordRule& rule) const {
        return std::any_of(block_.begin(), block_.end(), [&](const WordValue& w) {
            return w.letter == rule.code_letter && !w.vacant && code10_of(w) == rule.code10;
        });
    }
    bool calls = false, cycles = false;

  private:
    const BlockWords& block_;
};

std::string range_text(const WordRule& rule) {
    if (rule.out_of_range == 3) return {};
    const std::string fraction =
        rule.code10 % 10 == 0 ? "" : "." + std::to_string(rule.code10 % 10);
    return std::string("(") + rule.code_letter + std::to_string(rule.code10 / 10) + fraction +
           ": " + rule.letter + " is " + std::to_string(std::lround(rule.least)) + " to " +
           std::to_string(std::lround(rule.most)) + ")";
}

std::optional<WordFault> fault_of(const WordRule& rule, const WordValue& word) {
    const auto fault = [&](int alarm) { return WordFault{alarm, word.column, {}}; };
    if (rule.no_sign && rule.out_of_range == 3 && word.value < 0.0) return fault(6);
    if (rule.whole && std::abs(word.value - std::round(word.value)) > 1e-6) return fault(7);
    if (word.value > rule.most || word.value < rule.least)
        return WordFault{rule.out_of_range, word.column, range_text(rule)};
    return std::nullopt;
}

std::optional<WordFault> apply(const WordRule& rule, const BlockWords& block, bool all_known) {
    bool found = false;
    for (const WordValue& word : block) {
        found = found || word.letter == '<';  // a program name replaces P
        if (word.letter != rule.letter || word.vacant) continue;
        found = true;
        if (const auto fault = fault_of(rule, word)) return fault;
    }
    if (!found && all_known && rule.missing != 0)
        return WordFault{rule.missing, 0, range_text(rule)};
    return std::nullopt;
}

}  // namespace

std::span<const WordRule> word_rules() {
    return rows;
}

std::optional<WordFault> find_m_fault(const WordValue& m_word) {
    return fault_of({0, 0, 'M'}, m_word);
}

std::optional<WordFault> find_word_fault(const BlockWords& block, DialectFamily family,
                                         bool all_known) {
    const bool hurco = family == DialectFamily::hurco;
    const Codes codes(block);
    for (const WordRule& rule : rows) {
        const bool of_call = rule.code_letter == 'G' && rule.code10 >= 650 && rule.code10 <= 661;
        if (codes.calls && !of_call) continue;
        if (rule.code_letter != 0 && !codes.has(rule)) continue;
        if (hurco && is_fanuc_alone(rule)) continue;
        if (const auto fault = apply(rule, block, all_known)) return fault;
    }
    if (!codes.calls)
        for (const WordValue& word : block)
            if (word.letter == 'M' && !word.vacant)
                if (const auto fault = find_m_fault(word)) return fault;
    if (codes.cycles && !codes.calls)
        for (const WordRule& rule : cycle_rows) {
            if (hurco && is_fanuc_alone(rule)) continue;
            if (const auto fault = apply(rule, block, all_known)) return fault;
        }
    return std::nullopt;
}

}  // namespace trunnion::interpreter
