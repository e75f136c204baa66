// One program of a file (from its O number to the next); each group of checks is a file: *.cpp
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "check/check.h"
#include "interpreter/parse.h"

namespace trunnion::check {

/// Limits a number to the range of int; no N, O or code is that large.
inline int whole_of(double value) {
    constexpr double most = 2e9;
    return std::isnan(value) ? 0 : static_cast<int>(std::clamp(value, -most, most));
}

struct CheckSection {
    const interpreter::ParsedProgram* program = nullptr;
    std::vector<const interpreter::Block*> blocks;
    std::map<int, std::vector<const interpreter::Block*>> numbered;  ///< by N number
    std::set<int> targets;       ///< N numbers that are constant GOTO targets
    bool computed_jump = false;  ///< a GOTO computes its target
    bool subprogram = false;     ///< ends with M99
    bool foreign = false;        ///< for a lathe or a Haas
    bool may_start = false;      ///< first in the file, not called, no macro (from O8000) by custom
    int last_line = 0;           ///< before the next program
};

/// Splits a file at its O numbers and `%`.
std::vector<CheckSection> sections_of(const interpreter::ParsedProgram& program);

/// The value of a word if it is a constant.
std::optional<double> word_value(const interpreter::ParsedProgram& program,
                                 const interpreter::Block& block, char letter);
/// True when the block has this M or G code (times 10) as a constant.
bool has_code(const interpreter::ParsedProgram& program, const interpreter::Block& block,
              char letter, int code10);
int code10_of(double value);
/// True when the next block is reached by a jump only: unconditional GOTO, M30, M02, M99.
bool leaves(const interpreter::ParsedProgram& program, const interpreter::Block& block);

/// Collects findings of one file.
/// A word of a block: its column, from 1.
struct BlockPlace {
    const interpreter::Block& block;
    int column = 1;
};

/// A number whose findings are one cause together with its neighbours: variables of an undeclared
/// range, programs of a missing folder.
struct Numbered {
    std::string one, many;  ///< texts; * is the number, or the numbers
    const char* letter;     ///< "#", "O"
    int number = 0;
};

class Findings {
  public:
    explicit Findings(const interpreter::ParsedProgram& program) : program_(program) {}
    void add(const char* rule, Severity severity, BlockPlace place, std::string text,
             std::string remedy);
    void add(Finding finding) { found_.push_back({std::move(finding), {}}); }
    /// Near numbers become one finding at the first place.
    void add(const char* rule, BlockPlace place, Numbered what, std::string remedy);
    /// True when there is already an error on this line.
    bool has_error(int line) const;
    bool has(const std::string& rule, int line) const;
    /// Sorted by position; a finding repeated more than a few times is reported once with its
    /// number.
    std::vector<Finding> take();

    struct Found {
        Finding finding;
        std::optional<Numbered> what;
    };

  private:
    const interpreter::ParsedProgram& program_;
    std::vector<Found> found_;
};

/// Number of the program that the block calls by M98, M198, G65, G66 with a constant P; `column`
/// becomes that of P.
std::optional<int> called_program(const interpreter::ParsedProgram& program,
                                  const interpreter::Block& block, int& column);
/// True for the first program of a file unless it is called in it or has the number of a macro.
bool may_start(const CheckSection& section);
/// Programs that do not end, or that start again; small letters.
void check_ends(const interpreter::ParsedProgram& program,
                const std::vector<CheckSection>& sections, const CheckOptions& options,
                Findings& findings);
void check_flow(const CheckSection& section, Findings& findings);
void check_calls(const interpreter::ParsedProgram& program,
                 const std::vector<CheckSection>& sections, const CheckOptions& options,
                 Findings& findings);
void check_codes(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// Checks values of words against the table of interpreter/word_rules.h, and reports variables that
/// do not exist or are not writable.
void check_words(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// Executes a main program as far as it is sequential and its values are known.
void check_trial(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// One finding when the program is for a lathe or a Haas. Returns true in this case: nothing else
/// is reported of it.
bool check_family(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// What a G code without a meaning here does on a Haas; nullptr: unknown.
const char* haas_meaning(int code10);

/// The words of a block, those that are computed as vacant; `all`: none is computed. Never throws;
/// a block with more words than a control reads gives none.
struct ConstantWords {
    interpreter::BlockWords words;
    bool all = true;
};
std::optional<ConstantWords> constant_words(const interpreter::ParsedProgram& program,
                                            const interpreter::Block& block);
/// True when the words of the block are arguments: G65, G66, or a code mapped by a parameter.
bool passes_arguments(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                      const CheckOptions& options);

void check_arcs(const CheckSection& section, const CheckOptions& options, Findings& findings);

}  // namespace trunnion::check
