#include "choices/control_gap.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "choices/early_end.h"
#include "choices/gap_notes.h"
#include "choices/inch_rounding.h"
#include "choices/judged_noise.h"
#include "choices/log_meaning.h"
#include "choices/lost_rows.h"
#include "choices/program_shape.h"
#include "choices/trace_of_ends.h"

namespace trunnion::choices {

namespace {

constexpr double claimed = 0.5;          ///< least probability of a claim
constexpr std::size_t least_late = 3;    ///< blocks with wrong rows, where numbers are late
constexpr double contradicts = 0.9;      ///< of the loss: most that stays without the numbers
constexpr double almost_nothing = 0.05;  ///< of the loss: most that stays by the order of the rows
constexpr double much_less = 0.5;        ///< of the loss that causes leave, by another reading
/// Rows of a log, and their pairs with the points of a path, that take minutes without numbers
/// (assumed).
constexpr std::size_t many_rows = 4'000, many_pairs = 50'000'000;
constexpr double coarse_sigma = 0.005;  ///< mm or deg (assumed)
constexpr double other_start = 1.2;     ///< of the loss: most with a start that may be right

}  // namespace

bool is_claimed(const GapCause& cause) {
    return cause.probability * (1.0 + static_cast<double>(cause.rivals.size())) >= claimed;
}

const char* to_string(GapVerdict verdict) {
    constexpr const char* names[] = {"no-gap", "explained", "partly-explained", "ambiguous",
                                     "unexplained"};
    return names[static_cast<std::size_t>(verdict)];
}

namespace {

/// With the control at its machine zero at first, if this explains the log and its first row as the
/// start does not.
void try_other_start(const Asked& asked, const LogOfProgram& log, Answer& answer) {
    if (answer.gap.verdict == GapVerdict::no_gap || log.view.ends || log.view.begins_within ||
        log.view.from_zero)
        return;
    LogOfProgram other = from_machine_zero(log);
    const ComparedRun own = asked.comparer(log).run(answer.reached),
                      here = asked.comparer(other).run(answer.reached);
    const double noise = static_cast<double>(log.view.axes.size() * log.view.rows.size());
    const double most = is_left(answer.gap) ? other_start * own.loss + noise : 0.1 * own.loss;
    if (same_way(own.path, here.path) || here.loss > most) return;
    Answer second = judged(asked, std::move(other));
    if (!is_left(second.gap)) answer = std::move(second);
}

/// Another reading is taken if causes explain the log wholly by it.
void try_reading(const Asked& asked, LogOfProgram other, Answer& answer) {
    Answer second = judged(asked, std::move(other));
    if (!is_left(second.gap)) answer = std::move(second);
}

/// Without the numbers of blocks, if these contradict the positions: if causes explain the log
/// wholly so, or if almost nothing of the gap stays by the order of the rows. (A control that reads
/// ahead under G41 may tell the block that it has read, and begin and end its offset otherwise.)
void try_without_numbers(const Asked& asked, LogOfProgram& log, Answer& answer) {
    if (!is_left(answer.gap) || answer.left < least_late || log.view.keys == 0) return;
    LogOfProgram other = without_numbers(log);
    const setup::Setup& setup = asked.question.setup;
    const double own = asked.comparer(log).run(setup).loss,
                 here = asked.comparer(other).run(setup).loss;
    if (here > contradicts * own) return;
    Answer second = judged(asked, other);
    const bool almost = here <= almost_nothing * own &&
                        second.gap.after_rms_um < much_less * answer.gap.after_rms_um;
    if (is_left(second.gap) && !almost) return;
    answer = std::move(second);
    log = std::move(other);
}

/// Without numbers of blocks, the moves behind a large gap may seem to be no part of the log: as a
/// log of the whole program, they are.
void try_whole(const Asked& asked, LogOfProgram log, Answer& answer) {
    if (!is_left(answer.gap) || log.view.keys > 0 ||
        !ends_before(asked.comparer(log).run(asked.question.setup)))
        return;
    log.view.whole = true;
    try_reading(asked, std::move(log), answer);
}

/// A large gap hides that a log begins within the program. Then its rows were compared with moves
/// that it does not contain, and so is what the search made of them.
void try_begun_within(const Asked& asked, const LogOfProgram& log, Answer& answer) {
    if (!is_left(answer.gap) || log.view.begins_within) return;
    LogOfProgram other = begun_within(log);
    Answer second = judged(asked, other);
    if (!lacks_begin(other, asked.comparer(other).run(second.reached))) return;
    const double own = answer.gap.after_rms_um, here = second.gap.after_rms_um;
    if (!is_left(second.gap) || here * here < much_less * own * own) answer = std::move(second);
}

/// Causes hide where rows were lost, as long as they are not known.
void try_lost_rows(const Asked& asked, const LogOfProgram& log, Answer& answer) {
    if (!is_left(answer.gap)) return;
    auto other = with_lost_rows(log, asked.comparer(log).run(answer.reached));
    if (other) try_reading(asked, std::move(*other), answer);
}

/// A choice of the control may make the same way in other blocks. So numbers of blocks are read
/// otherwise only if no cause explains the log with these as they stand. `plain`: as it was read.
Answer judged_by_numbers(const Asked& asked, const LogOfProgram& plain, LogOfProgram& log) {
    if (log.lines_from_0) {
        Answer answer = judged(asked, plain);
        if (!is_left(answer.gap)) {
            log = plain;
            return answer;
        }
    }
    Answer answer = judged(asked, log);
    if (!is_left(answer.gap)) return answer;
    auto ordered = agreeing_in_order(asked.source(asked.question.setup), log);
    if (!ordered) return answer;
    log = std::move(*ordered);
    return judged(asked, log);
}

/// Rows that are set aside are no part of the answer, and no agreement.
void tell_foreign(std::size_t blocks, ControlGap& gap) {
    if (blocks == 0 || is_left(gap)) return;
    gap.verdict =
        gap.verdict == GapVerdict::no_gap ? GapVerdict::unexplained : GapVerdict::partly_explained;
    GapCause cause;
    cause.what = "the log has blocks that the program lacks";
    add_unknown(gap, blocks, std::move(cause));
}

/// A log that does not tell ends of moves from samples may have ends only: as samples, what they
/// show of short moves would not be seen. `setup`: of the control that they are compared with.
records::PositionLog log_as_meant(const Asked& asked, const setup::Setup& setup) {
    const records::PositionLog& log = asked.question.log;
    if (log.ends) return log;
    records::PositionLog trace = as_trace(log);
    const LogOfProgram of = log_of_program(trace, asked.texts, asked.question.max_blocks);
    return seems_trace(of, asked.comparer(of).run(setup)) ? trace : log;
}

/// Many samples without numbers beside a path of many points would take minutes: such a path is
/// made coarser, and the noise is then at least what its chords may be off. Means over many rows
/// show less than that.
void coarsen_if_long(const Asked& asked, LogOfProgram& log) {
    if (log.view.ends || log.view.keys > 0 || log.view.rows.size() < many_rows) return;
    const std::size_t nodes = asked.comparer(log).path(asked.question.setup).nodes.size();
    if (log.view.rows.size() * nodes < many_pairs || log.sigma >= coarse_sigma) return;
    log.least_sigma = coarse_sigma;
    set_sigma(log, coarse_sigma);
    log.notes.push_back(fmt::format(
        "{} rows without numbers of blocks beside a path of {} points: curves are compared to {} "
        "mm, to end in time; a log with numbers is compared to its own noise",
        log.view.rows.size(), nodes, log.path.chord_mm));
}

/// The answer for rows that are what `own` says.
Answer answered(const Asked& any, const records::PositionLog& own) {
    const GapQuestion meant{any.question.setup, own, any.question.program, any.question.max_blocks,
                            any.question.watch};
    const Asked asked{meant, any.programs, any.texts};
    LogOfProgram log = log_of_program(own, any.texts, meant.max_blocks);
    if (own.ends && !any.question.log.ends)
        log.notes.push_back(
            own.path +
            ": most rows stand on ends of moves, so all are taken as ends of moves, not as samples "
            "(a column 'motion' tells: G0 to G3 for an end, SAMPLE for a sample)");
    coarsen_if_long(asked, log);
    const LogOfProgram plain = log;
    settle_meaning(asked.source(meant.setup), log);
    log.view.period_min =
        minutes_of_samples(log.view, asked.comparer(log).run(asked.question.setup));
    settle_lost_rows(asked, log);
    Answer answer = judged_by_numbers(asked, plain, log);
    // Late numbers may show only beside the causes. They are wrong at most changes: what stays in
    // one or two blocks is no lateness, which would hide it.
    if (is_left(answer.gap) && answer.left >= least_late &&
        settle_lateness(asked.source(answer.reached), log))
        answer = judged(asked, log);
    try_other_start(asked, log, answer);
    try_without_numbers(asked, log, answer);
    try_whole(asked, log, answer);
    try_begun_within(asked, log, answer);
    try_lost_rows(asked, log, answer);
    settle_inch_rounding(asked, log, answer);
    tell_foreign(log.foreign.size(), answer.gap);
    tell_early_end(asked, log, answer);
    return answer;
}

/// A store far from the other control's hides that rows are ends of moves: the causes found may
/// show it, or these explain the log only so.
void try_ends(const Asked& asked, Answer& answer) {
    const records::PositionLog meant = log_as_meant(asked, answer.reached);
    if (meant.ends) {
        answer = answered(asked, meant);
        return;
    }
    if (!is_left(answer.gap)) return;
    const records::PositionLog ends = as_trace(asked.question.log);
    const LogOfProgram log = log_of_program(ends, asked.texts, asked.question.max_blocks);
    if (!may_be_trace(ends, asked.comparer(log).path(asked.question.setup))) return;
    Answer second = answered(asked, ends);
    if (!is_left(second.gap)) answer = std::move(second);
}

}  // namespace

ControlGap control_gap(const GapQuestion& question, interpreter::ProgramSource& programs,
                       const std::function<std::vector<interpreter::ProgramText>()>& called) {
    PathOptions first_look;
    first_look.moves_only = true;
    first_look.max_blocks = question.max_blocks;
    // Finds the called programs, too.
    if (path_of(question.setup, question.program, programs, first_look).limited)
        throw PathEnded{true};
    const std::vector<interpreter::ProgramText> all = called();
    const Asked asked{question, programs, all};
    LogOfProgram plain = log_of_program(question.log, all, question.max_blocks);
    coarsen_if_long(asked, plain);
    if (fits_nowhere(asked, plain)) return judged_foreign(asked, plain).gap;
    const records::PositionLog own = log_as_meant(asked, question.setup);
    Answer answer = answered(asked, own);
    if (!own.ends && answer.gap.verdict != GapVerdict::no_gap) try_ends(asked, answer);
    return std::move(answer.gap);
}

}  // namespace trunnion::choices
