// What the trial of a main program (trial.cpp) and the reading of its other blocks (rest.cpp)
// share.
#pragma once

#include <span>
#include <vector>

#include "check/section.h"
#include "interpreter/known_values.h"

namespace trunnion::check {

/// True when the code calls a program, or may do.
bool is_call(char letter, int code10, const CheckOptions& options);

/// The known words left for the control after the language has taken G67 and those of M98, M198 or
/// M99; empty when the words are arguments or belong to a called program, or may do.
std::optional<interpreter::BlockWords> left_for_control(const interpreter::BlockWords& all,
                                                        const CheckOptions& options);

/// Of a constant word or an expression. Throws Alarm.
std::optional<double> value_of(const interpreter::ParsedProgram& program,
                               const interpreter::Item& item,
                               const interpreter::KnownValues& known);
/// Number of the variable that an assignment sets. Throws Alarm.
std::optional<int> target_of(const interpreter::ParsedProgram& program,
                             const interpreter::Item& item, const interpreter::KnownValues& known);

/// Where an alarm has no column of its own, that of the item.
template <typename Work>
void at_column(const interpreter::Item& item, Work work) {
    try {
        work();
    } catch (Alarm& alarm) {
        if (alarm.where.column == 0) alarm.where.column = item.column;
        throw;
    }
}

/// Whether a run comes to a block: always, if a condition holds that is not known, never with the
/// values that the program sets, or when a program that ends with M99 is started itself.
enum class Reach : unsigned char { certain, conditional, never, as_main };

/// "PS0112 ZERO DIVIDE" and what the alarm's own text adds.
std::string alarm_line(const Alarm& alarm, const CheckOptions& options);
struct ReachedBlock {
    const interpreter::Block& block;
    Reach reach = Reach::certain;
};

/// The finding on an alarm of a block: an error, a warning or a note, by its reach.
void add_alarm(const Alarm& alarm, const CheckSection& section, ReachedBlock at,
               const CheckOptions& options, Findings& findings);

/// The findings on what the blocks since the last call do.
void add_cautions(Trial& trial, const CheckSection& section, const interpreter::Block& block,
                  Findings& findings);

/// The blocks of a section that were carried out one after another.
struct CarriedOut {
    std::vector<bool> done;  ///< by index in the section
    std::size_t stopped_at = 0;
    bool ended = false;  ///< at M02, M30 or behind the last block
    bool lost = false;   ///< in a loop that did not end: nothing is known of the blocks behind
};

/// The blocks that were not carried out: checks of their words alone.
void read_rest(const CheckSection& section, const CarriedOut& so_far, Trial& trial,
               const CheckOptions& options, Findings& findings);

}  // namespace trunnion::check
