#include "interpreter/word_rules.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace trunnion::interpreter {

namespace {

/// A value that violates the rule raises PS0007 (not an integer), PS0006 (negative),
/// `out_of_range`, or `missing` when the word is absent.
struct WordRule {
    char code_letter;   ///< G or M; 0: every block that passes no arguments
    int code10;         ///< of that code, times 10
    char letter;        ///< the word
    bool whole = true;  ///< must be an integer
    double most = 99999999.0;
    double least = 0.0;
    int out_of_range = 3;  ///< alarm
    int missing = 0;       ///< alarm; 0: the word may be absent
};

constexpr double any = 99999999.0;

/// Stands for all canned cycles, which have their rules in common.
constexpr int canned_cycle = 730;

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
    {'G', 300, 'P', true, 4, 2, 46},
    {'G', 310, 'P'},
    {'G', 531, 'P', true, 2, 0, 5458},
    {'G', 536, 'P', true, 2, 0, 5458},
    {'G', 541, 'P', true, 300, 1, 30, 30},
    {'G', 542, 'P', true, 8, 0, 30, 30},
    {'G', 682, 'P'},
    {'G', 682, 'Q'},
    {'G', 684, 'P'},
    {'G', 684, 'Q'},
    {'G', 960, 'P'},
    {'M', 980, 'P', true, 999999999.0, 0, 3, 76},
    {'M', 980, 'L'},
    {'M', 980, 'Q', true, 999999999.0},
    {'M', 1980, 'P', true, 999999999.0, 0, 3, 76},
    {'M', 1980, 'L'},
    {'M', 990, 'P', true, 999999999.0},
    {'M', 990, 'L'},
    {'G', canned_cycle, 'P'},
    {'G', canned_cycle, 'K'},
    {'G', canned_cycle, 'L'},
};

/// Of G65, G66 and G66.1, in whose blocks the other words are arguments.
constexpr WordRule program_of_call{'G', 650, 'P', true, any, 0, 3, 76};
constexpr WordRule repeats_of_call{'G', 650, 'L'};

int code10_of(const WordValue& word) {
    const double tenfold = word.value * 10.0;
    return tenfold >= 0.0 && tenfold < 1e6 ? static_cast<int>(tenfold + 0.5) : -1;
}

/// A set of rows, one bit each: which rules count for a block is found without a walk over them.
using RowSet = std::uint64_t;
static_assert(std::size(rows) <= 64);

constexpr RowSet bit_of(std::size_t row) {
    return RowSet{1} << row;
}

template <typename Condition>
constexpr RowSet rows_where(Condition condition) {
    RowSet set = 0;
    for (std::size_t i = 0; i < std::size(rows); ++i)
        if (condition(rows[i])) set |= bit_of(i);
    return set;
}

constexpr RowSet of_every_block = rows_where([](const WordRule& r) { return r.code_letter == 0; });
constexpr RowSet of_cycles = rows_where([](const WordRule& r) { return r.code10 == canned_cycle; });
constexpr RowSet with_required_word = rows_where([](const WordRule& r) { return r.missing != 0; });
constexpr RowSet of_fanuc_alone = rows_where([](const WordRule& r) {
    return r.letter == 'P' &&
           (r.code10 == 40 || r.code10 == 310 || r.code10 == 682 || r.code10 == canned_cycle);
});

/// The rows of each letter of a word, from A.
constexpr auto rows_of_letter = [] {
    std::array<RowSet, 26> sets{};
    for (std::size_t i = 0; i < sets.size(); ++i)
        sets[i] =
            rows_where([&](const WordRule& r) { return r.letter == 'A' + static_cast<int>(i); });
    return sets;
}();

struct CodeRows {
    int key = 0;
    RowSet set = 0;
};

constexpr int key_of(char letter, int code10) {
    return 2 * code10 + (letter == 'M' ? 1 : 0);
}

/// The rows of each code.
constexpr auto rows_of_codes = [] {
    std::array<CodeRows, std::size(rows)> sets{};
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const int key = key_of(rows[i].code_letter, rows[i].code10);
        sets[i] = {key, rows_where([&](const WordRule& r) {
                       return key_of(r.code_letter, r.code10) == key;
                   })};
    }
    return sets;
}();

constexpr std::size_t key_count = [] {
    int most = 0;
    for (const CodeRows& code : rows_of_codes) most = std::max(most, code.key);
    return static_cast<std::size_t>(most) + 1;
}();

/// One more than the index of a key in rows_of_codes; 0: a code without rules.
constexpr auto index_of_key = [] {
    std::array<std::uint8_t, key_count> index{};
    for (std::size_t i = 0; i < rows_of_codes.size(); ++i)
        index[static_cast<std::size_t>(rows_of_codes[i].key)] = static_cast<std::uint8_t>(i + 1);
    return index;
}();

RowSet rows_of_code(char letter, int code10) {
    const int key = key_of(letter, code10);
    if (key < 0 || static_cast<std::size_t>(key) >= key_count) return 0;
    const std::size_t index = index_of_key[static_cast<std::size_t>(key)];
    return index == 0 ? 0 : rows_of_codes[index - 1].set;
}

bool is_canned_cycle(int code10) {
    return code10 >= 730 && code10 <= 890 && code10 != 800 && code10 % 10 == 0;
}

/// Rows whose code and word (unless it is required) are in the block.
struct Applicable {
    RowSet set = 0;
    bool m_words = false;
};

Applicable applicable_rows(const BlockWords& block, bool hurco) {
    RowSet of_codes = of_every_block, of_words = with_required_word;
    bool m_words = false;
    for (const WordValue& word : block) {
        if (word.vacant) continue;
        if (word.letter >= 'A' && word.letter <= 'Z')
            of_words |= rows_of_letter[static_cast<std::size_t>(word.letter - 'A')];
        if (word.letter != 'G' && word.letter != 'M') continue;
        const int code10 = code10_of(word);
        m_words = m_words || word.letter == 'M';
        const bool cycle = word.letter == 'G' && is_canned_cycle(code10);
        of_codes |= rows_of_code(word.letter, cycle ? canned_cycle : code10);
    }
    if (hurco) of_codes &= ~of_fanuc_alone;
    return {of_codes & of_words, m_words};
}

std::string range_text(const WordRule& rule) {
    if (rule.out_of_range == 3) return {};
    const std::string fraction =
        rule.code10 % 10 == 0 ? "" : "." + std::to_string(rule.code10 % 10);
    return std::string("(") + rule.code_letter + std::to_string(rule.code10 / 10) + fraction +
           ": " + rule.letter + " is " + std::to_string(std::lround(rule.least)) + " to " +
           std::to_string(std::lround(rule.most)) + ")";
}

/// Alarm 0: the rule is kept. Column 0: the word is missing.
struct Violation {
    int alarm = 0, column = 0;
};

Violation violation_of(const WordRule& rule, const WordValue& word) {
    if (rule.out_of_range == 3 && word.value < 0.0) return {6, word.column};
    if (rule.whole && !is_whole(word.value)) return {7, word.column};
    if (word.value > rule.most || word.value < rule.least) return {rule.out_of_range, word.column};
    return {};
}

Violation violation_in(const WordRule& rule, const BlockWords& block, bool all_known) {
    bool found = false;
    for (const WordValue& word : block) {
        found = found || word.letter == '<';  // a program name replaces P
        if (word.letter != rule.letter || word.vacant) continue;
        found = true;
        if (const Violation v = violation_of(rule, word); v.alarm != 0) return v;
    }
    return {!found && all_known ? rule.missing : 0, 0};
}

/// One walk over the words, because programs call macros in their inner loops.
Violation violation_in_call(const BlockWords& block, bool all_known) {
    bool has_program = false;
    Violation in_repeats;
    for (const WordValue& word : block) {
        has_program = has_program || word.letter == '<';
        if (word.letter != 'P' && word.letter != 'L') continue;
        if (word.vacant) continue;
        const bool is_program = word.letter == 'P';
        const Violation v = violation_of(is_program ? program_of_call : repeats_of_call, word);
        if (is_program && v.alarm != 0) return v;
        if (!is_program && in_repeats.alarm == 0) in_repeats = v;
        has_program = has_program || is_program;
    }
    if (!has_program && all_known) return {program_of_call.missing, 0};
    return in_repeats;
}

/// Column of H in `G65 H80 P100` or `G65 H01 P#101`, else 0: custom macro A, whose H names an
/// operation and whose P is no program (assumed). H behind P or with a point is an argument.
int column_of_macro_a(const BlockWords& block) {
    const WordValue* const h = block.begin() + 1;
    if (block.count < 3 || h->letter != 'H' || h->decimal_point || h->value <= 0.0) return 0;
    if (!is_macro_call(block.words[0]) || code10_of(block.words[0]) != 650) return 0;
    return std::any_of(h, block.end(), [](const WordValue& w) { return w.letter == 'P'; })
               ? h->column
               : 0;
}

WordFault fault_of(const WordRule& rule, const Violation& v) {
    const bool of_any_word = v.alarm == 6 || v.alarm == 7;
    return {v.alarm, v.column, of_any_word ? std::string{} : range_text(rule)};
}

}  // namespace

bool is_whole(double value) {
    if (std::abs(value) < 1e9 && value == static_cast<int>(value)) return true;
    return std::abs(value - std::round(value)) <= 1e-6;
}

bool is_macro_call(const WordValue& word) {
    if (word.letter != 'G' || word.vacant) return false;
    const int code10 = code10_of(word);
    return code10 == 650 || code10 == 660 || code10 == 661;
}

std::optional<WordFault> find_m_fault(const WordValue& m_word) {
    constexpr WordRule rule{0, 0, 'M'};
    const Violation v = violation_of(rule, m_word);
    if (v.alarm == 0) return std::nullopt;
    return fault_of(rule, v);
}

std::optional<WordFault> find_word_fault(const BlockWords& block, DialectFamily family,
                                         bool all_known) {
    if (std::any_of(block.begin(), block.end(), is_macro_call)) {
        if (const int column = column_of_macro_a(block))
            return WordFault{1090, column,
                             "(custom macro A is not emulated; in a call P stands "
                             "before H, or H has a point)"};
        const Violation v = violation_in_call(block, all_known);
        return v.alarm == 0 ? std::nullopt : std::optional(fault_of(program_of_call, v));
    }
    const auto [set, m_words] = applicable_rows(block, family == DialectFamily::hurco);
    const auto violated_row = [&](RowSet left) {
        while (left != 0 && violation_in(rows[std::countr_zero(left)], block, all_known).alarm == 0)
            left &= left - 1;
        return left;
    };
    const auto fault_of_row = [&](RowSet left) {
        const WordRule& rule = rows[std::countr_zero(left)];
        return fault_of(rule, violation_in(rule, block, all_known));
    };
    if (const RowSet left = violated_row(set & ~of_cycles)) return fault_of_row(left);
    if (m_words)
        for (const WordValue& word : block)
            if (word.letter == 'M' && !word.vacant)
                if (auto fault = find_m_fault(word)) return fault;
    if (const RowSet left = violated_row(set & of_cycles)) return fault_of_row(left);
    return std::nullopt;
}

}  // namespace trunnion::interpreter
