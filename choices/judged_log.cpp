#include "choices/judged_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "choices/agreeing_range.h"
#include "choices/block_texts.h"
#include "choices/edit_rivals.h"
#include "choices/far_blocks.h"
#include "choices/folds.h"
#include "choices/gap_causes.h"
#include "choices/gap_notes.h"
#include "choices/gap_search.h"
#include "choices/gap_teller.h"
#include "choices/program_stores.h"
#include "choices/row_fit.h"
#include "choices/shift_twins.h"
#include "choices/small_shift.h"
#include "controller/alarms.h"
#include "estimation/distributions.h"

namespace trunnion::choices {

namespace {

constexpr double gap_sigmas = 6.0;  ///< of a row: a gap begins there
constexpr double explained_from = 0.8;
constexpr double least_left = 0.005;  ///< of the gap: minimum for a block listed as remaining
constexpr double chance =
    1e-6;                      ///< p of a small excess over the noise that is searched all the same
constexpr double rare = 1e-3;  ///< the same where the noise is only known from some rows: what is
                               ///< searched for nothing is taken back
constexpr double quite_sure = 0.8;    ///< probability of a cause of such an excess
constexpr double all_rows = 0.95;     ///< part of the rows that an explanation reaches
constexpr double surely_more = 1e-9;  ///< p of a mean that no noise has

}  // namespace

void add_unknown(ControlGap& gap, std::size_t blocks, GapCause cause) {
    cause.name = "unknown";
    cause.known = false;
    cause.blocks = blocks;
    cause.probability = 1.0;
    cap_probability(cause, 1.0);
    gap.causes.push_back(cause);
}

bool is_left(const ControlGap& gap) {
    return gap.verdict == GapVerdict::unexplained || gap.verdict == GapVerdict::partly_explained;
}

namespace {

/// `whole`: the causes bring (almost) all rows with a gap down to noise, and spoil none.
GapVerdict verdict_of(const ControlGap& gap, bool whole) {
    const bool none = std::none_of(gap.causes.begin(), gap.causes.end(), is_claimed);
    if (none) return GapVerdict::unexplained;
    if (gap.explained < explained_from || !whole) return GapVerdict::partly_explained;
    const bool rivals = std::any_of(gap.causes.begin(), gap.causes.end(),
                                    [](const GapCause& c) { return !c.rivals.empty(); });
    return rivals ? GapVerdict::ambiguous : GapVerdict::explained;
}

void tell_base(const LogOfProgram& log, const ComparedRun& base, const Teller& teller,
               ControlGap& gap) {
    gap.noise = log.noise;
    gap.rows = log.view.rows.size();
    gap.rms_um = teller.mean_um(base.losses);
    gap.noise_um = teller.noise_um();
    gap.excess_um = std::sqrt(std::max(0.0, gap.rms_um * gap.rms_um - gap.noise_um * gap.noise_um));
    const double terms = teller.noise_loss();
    gap.p_value = std::isfinite(log.view.freedom)
                      ? estimation::f_tail(base.loss / terms, terms, log.view.freedom)
                      : estimation::chi_squared_tail(base.loss, terms);
    const double limit = gap_sigmas * gap_sigmas;
    gap.first = teller.first(base, [&](std::size_t row) { return base.losses[row] > limit; });
    gap.worst = teller.worst(base, [](std::size_t) { return true; });
    gap.where = teller.where(base, base.loss - teller.noise_loss());
    if (base.path.alarm)
        gap.stopped =
            fmt::format("{} at line {}",
                        controller::alarm_title(base.path.alarm->number, base.path.alarm->text),
                        base.path.alarm->where.line);
    gap.after_rms_um = gap.rms_um;
    tell_rest(log.view, base, gap.notes);
}

/// No cause is claimed: all of the gap is unknown, whatever a doubtful one would remove.
GapCause nothing_explains(const ControlGap& gap) {
    GapCause out;
    out.what = "no choice and no store in the tables explains the gap";
    out.share = 1.0;
    out.first = gap.first;
    out.worst = gap.worst;
    return out;
}

/// Beside the causes that are claimed.
GapCause what_stays(const ControlGap& gap, const ComparedRun& run, const Judged& by) {
    GapCause out;
    out.what = "no choice and no store in the tables explains what stays";
    out.share = 1.0 - gap.explained;
    const auto is_far = [&](std::size_t row) { return run.losses[row] > by.row_limit; };
    out.first = by.teller.first(run, is_far);
    out.worst = by.teller.worst(run, [](std::size_t) { return true; });
    return out;
}

void tell_causes(const GapQuestion& question, const GapSearch& found, const ComparedRun& base,
                 const Judged& by, ControlGap& gap) {
    for (std::size_t k = 0; k < found.steps.size(); ++k)
        gap.causes.push_back(cause_of(question, found, k, by));
    const double excess = by.excess;
    gap.explained =
        excess > 0.0 ? std::clamp((base.loss - sum_of(found.left_out)) / excess, 0.0, 1.0) : 0.0;
    if (by.row_limit == infinite_loss)
        for (GapCause& cause : gap.causes) cap_probability(cause, gap.explained);
    cap_by_needed(question, found, by, gap.causes);
    share_with_edits(question, found, by, gap.causes);
    share_with_twins(by.comparer, question.setup, found, gap.causes);
    for (std::size_t k = 0; k < found.steps.size(); ++k)
        if (is_claimed(gap.causes[k]) && !may_be_edit(gap.causes[k]))
            found.steps[k].chosen.take(gap.setup);
    std::stable_sort(gap.causes.begin(), gap.causes.end(),
                     [](const GapCause& a, const GapCause& b) { return a.share > b.share; });
    const double part = reached(base.losses, found.run.losses, by.row_limit);
    const bool whole =
        part >= all_rows && !stays_wrong(base.losses, found.run.losses, by.row_limit);
    gap.verdict = verdict_of(gap, whole);
    gap.after = by.teller.shrink(base.losses, found.left_out);
    gap.after_rms_um = by.teller.mean_um(found.run.losses);
    for (const GapBlock& block : by.teller.where(found.run, excess))
        if (block.share > least_left || (!whole && block.p_value < surely_more))
            gap.left.push_back(block);
    if (gap.verdict == GapVerdict::unexplained)
        add_unknown(gap, gap.blocks, nothing_explains(gap));
    else if (gap.verdict == GapVerdict::partly_explained && !whole)
        add_unknown(gap, gap.left.size(), what_stays(gap, found.run, by));
    gap.unseen = found.unseen;
}

/// p of a small excess over the noise that is searched all the same.
double searched_below(const LogOfProgram& log) {
    return std::isfinite(log.view.freedom) ? rare : chance;
}

/// What noise alone might be must be explained wholly and surely.
bool is_convincing(const ControlGap& gap) {
    const bool whole = gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous;
    return whole && std::all_of(gap.causes.begin(), gap.causes.end(), [](const GapCause& c) {
               return c.probability >= quite_sure || !c.rivals.empty();
           });
}

void take_back(const GapQuestion& question, ControlGap& gap) {
    gap.verdict = GapVerdict::no_gap;
    gap.causes.clear();
    gap.left.clear();
    gap.unseen.clear();
    gap.setup = question.setup;
    gap.explained = 0.0;
    gap.after = {};
    gap.after_rms_um = gap.rms_um;
}

/// An edit of the program, or another meaning of the columns, with which the log agrees.
void tell_other_readings(const GapQuestion& question, const GapSearch& found,
                         const ComparedRun& base, const Judged& by, ControlGap& gap) {
    if (const std::string edit = agreeing_edit(question, found, base, by); !edit.empty())
        gap.notes.push_back("the log agrees if " + edit +
                            ": the program that ran may have been edited there");
    if (const std::string meaning = agreeing_columns(by.comparer, question.setup, base.loss);
        !meaning.empty())
        gap.notes.push_back(fmt::format("the log agrees if {}", meaning));
}

/// Number of blocks with a row whose loss is larger.
std::size_t blocks_beyond(const ComparedRun& run, const std::vector<int>& blocks,
                          double row_limit) {
    std::set<int> out;
    for (std::size_t row = 0; row < blocks.size(); ++row)
        if (run.losses[row] > row_limit) out.insert(blocks[row]);
    return out.size();
}

/// What is known of the answer before anything is compared.
void begin(const GapQuestion& question, const LogOfProgram& log, Answer& out) {
    out.reached = out.gap.setup = question.setup;
    out.gap.notes = log.notes;
    tell_sampling(log.view, out.gap.notes);
}

}  // namespace

Answer judged_foreign(const Asked& asked, const LogOfProgram& log) {
    const GapQuestion& question = asked.question;
    Answer out;
    begin(question, log, out);
    ControlGap& gap = out.gap;
    const Comparer comparer = asked.comparer(log);
    const ComparedRun base = comparer.run(question.setup);
    const std::vector<int> blocks = blocks_of(log.view, base);
    gap.blocks = std::set<int>(blocks.begin(), blocks.end()).size();
    const BlockTexts texts(question.program, asked.texts);
    const Teller teller(log, texts, blocks, directions_of(log.view, base));
    tell_base(log, base, teller, gap);
    gap.left = gap.where;
    gap.verdict = GapVerdict::unexplained;
    add_unknown(gap, gap.blocks, nothing_explains(gap));
    gap.notes.emplace_back(
        "most of the straight ways of the log go where no move of this program goes, whatever the "
        "options of this control, so no cause was sought: is this the program that was logged?");
    return out;
}

Answer judged_at_sigma(const Asked& asked, LogOfProgram log) {
    const GapQuestion& question = asked.question;
    // Not Answer{{}, setup}: without memory for the copy, GCC 12 destroys a gap that it never made.
    Answer out;
    begin(question, log, out);
    ControlGap& gap = out.gap;
    const ComparedRun first = asked.comparer(log).run(question.setup);
    const std::vector<int> blocks = blocks_of(log.view, first);
    // A motion that the log samples coarsely looks like noise, and would hide a gap.
    if (const auto scatter = scatter_about(log.view, first, blocks);
        log.noise == LogNoise::repeats && scatter && *scatter < log.sigma)
        set_sigma(log, *scatter);
    const Comparer comparer = asked.comparer(log);
    const ComparedRun base = comparer.run(question.setup);
    gap.blocks = std::set<int>(blocks.begin(), blocks.end()).size();
    const BlockTexts texts(question.program, asked.texts);
    const Teller teller(log, texts, blocks, directions_of(log.view, base));
    tell_base(log, base, teller, gap);
    const bool quiet = is_quiet(log, base);
    const double alike = quiet ? correlation_of(log.view, base, blocks) : 0.0;
    if (quiet)
        gap.p_value = is_rounding(log.view, base)
                          ? 1.0
                          : std::min(gap.p_value, p_of_shift(log.view, base, blocks, alike));
    if (quiet && gap.p_value > searched_below(log)) {
        gap.unseen = tell_ranges(comparer, {question.setup, base}, gap.notes);
        return out;
    }
    const ShiftTwins twins = twins_of_external(comparer, {question.setup, base});
    ProgramStores used = stores_of(asked.texts);
    used.left_local = !twins.local;
    used.left_preset = !twins.preset;
    const SearchQuestion search{comparer, question.setup, base, blocks, used, alike};
    GapSearch found = search_causes(search, question.watch);
    const auto limit = [&] {
        return quiet ? infinite_loss
                     : row_limit_of(log, base, found.run, blocks, 1e-3 * gap.rms_um);
    };
    if (!quiet) found = beside_far_blocks(search, std::move(found), limit(), question.watch);
    settle_in_ranges(search, found);
    // Within the noise no row shows whether it is reached: their means do.
    const Judged by{comparer, teller,
                    blocks,   base.loss - (quiet ? found.run.loss : teller.noise_loss()),
                    limit(),  beside_remainder(log, base, found.run, blocks, limit())};
    tell_causes(question, found, base, by, gap);
    if (quiet && (!is_convincing(gap) ||
                  p_of_shift(log.view, found.run, blocks, alike) < searched_below(log)))
        take_back(question, gap);
    for (std::string& name : tell_ranges(comparer, {found.setup, found.run}, gap.notes))
        gap.unseen.push_back(std::move(name));
    out.reached = found.setup;
    out.left = blocks_beyond(found.run, blocks, by.row_limit);
    if (is_left(gap)) tell_other_readings(question, found, base, by, gap);
    return out;
}

}  // namespace trunnion::choices
