// One program of a file (from its O number to the next) as the checks see it.
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

/// A number of a program, cut to what an int holds: no N, O or code is that large.
inline int whole_of(double value) {
    constexpr double most = 2e9;
    return std::isnan(value) ? 0 : static_cast<int>(std::clamp(value, -most, most));
}

struct CheckSection {
    const interpreter::ParsedProgram* program = nullptr;
    std::vector<const interpreter::Block*> blocks;
    std::map<int, std::vector<const interpreter::Block*>> numbered;  ///< by N
    std::set<int> targets;       ///< N numbers that a GOTO with a constant names
    bool computed_jump = false;  ///< some GOTO computes its target
    bool subprogram = false;     ///< ends with M99
};

/// Splits a file at its O numbers and `%`.
std::vector<CheckSection> sections_of(const interpreter::ParsedProgram& program);

/// The value of a word when it is a constant.
std::optional<double> word_value(const interpreter::ParsedProgram& program,
                                 const interpreter::Block& block, char letter);
/// Does the block hold this M or G code (times 10) as a constant?
bool has_code(const interpreter::ParsedProgram& program, const interpreter::Block& block,
              char letter, int code10);
int code10_of(double value);

/// Collects findings of one file.
class Findings {
  public:
    explicit Findings(const interpreter::ParsedProgram& program) : program_(program) {}
    void add(const char* rule, Severity severity, const interpreter::Block& block, int column,
             std::string text, std::string remedy);
    void add(Finding finding) { found_.push_back(std::move(finding)); }
    /// Is there an error at this line already?
    bool has_error(int line) const;
    /// By place; what is said more often than a few times is said once, with how often.
    std::vector<Finding> take();

  private:
    const interpreter::ParsedProgram& program_;
    std::vector<Finding> found_;
};

void check_flow(const CheckSection& section, Findings& findings);
void check_calls(const interpreter::ParsedProgram& program,
                 const std::vector<CheckSection>& sections, const CheckOptions& options,
                 Findings& findings);
void check_codes(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// Values of words by the table of interpreter/word_rules.h, and variables that do not exist or
/// cannot be written.
void check_words(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// Carries out a main program as far as it runs straight on with constant words.
void check_trial(const CheckSection& section, const CheckOptions& options, Findings& findings);
/// One finding when the program is written for a lathe or for a Haas: their own codes are no errors
/// of it then. Returns true in this case.
bool check_family(const std::vector<CheckSection>& sections, const CheckOptions& options,
                  Findings& findings);

/// The constant words of a block; `all`: none is computed. Throws nothing; more words than a
/// control reads give nothing.
struct ConstantWords {
    interpreter::BlockWords words;
    bool all = true;
};
std::optional<ConstantWords> constant_words(const interpreter::ParsedProgram& program,
                                            const interpreter::Block& block);
/// Does the block call a program, by its own words or by a code that a parameter maps?
bool calls_program(const interpreter::ParsedProgram& program, const interpreter::Block& block,
                   const CheckOptions& options);

void check_arcs(const CheckSection& section, const CheckOptions& options, Findings& findings);

}  // namespace trunnion::check
