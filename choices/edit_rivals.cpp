#include "choices/edit_rivals.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "choices/edited_block.h"
#include "choices/joint_stores.h"
#include "choices/row_fit.h"

namespace trunnion::choices {

namespace {

constexpr double edit_gap = 3.0;       ///< of a score: odds of 20 to 1
constexpr double hardly = 1e-6;        ///< of a weight
constexpr double worth_asking = 0.3;   ///< of a probability
constexpr double nearly_all = 0.9;     ///< of the excess: least that an edit removes to be told
constexpr double reaches_rows = 0.95;  ///< of those with a gap

const std::string edit_rival = "an edit: ";

/// Edits of the program on a control, beside a run of it.
std::vector<BlockEdit> edits_beside(const Comparer& comparer, const setup::Setup& setup,
                                    const ComparedRun& run, double row_limit, double least_gain) {
    const auto is_far = [&](std::size_t row) { return run.losses[row] > row_limit; };
    return edits_of({comparer, setup, run, is_far, least_gain});
}

/// The log without the rows that stay far away with the causes: an edit of another block explains
/// these, and is no rival.
LogView without_far_rows(const GapSearch& found, const Judged& by) {
    LogView view = by.comparer.log();
    for (std::size_t row = 0; row < view.rows.size(); ++row)
        if (found.run.losses[row] > by.row_limit) view.rows[row].weight *= hardly;
    return view;
}

/// How far a loss is from another one, as scores of searches are; what leaves as much is equal.
class Weigher {
  public:
    explicit Weigher(const Judged& by)
        : terms_(static_cast<double>(by.blocks.size() * by.comparer.log().axes.size())),
          n_(static_cast<double>(std::set<int>(by.blocks.begin(), by.blocks.end()).size() *
                                 by.comparer.log().axes.size())) {}
    double behind(double loss, double best) const {
        const double by = 0.5 * n_ * (std::log(noise(loss)) - std::log(noise(best)));
        return by < equal_score ? 0.0 : by;
    }
    /// The largest loss of a rival.
    double most(double best) const { return terms_ * noise(best) * std::exp(2.0 * edit_gap / n_); }

  private:
    double noise(double loss) const { return std::max(1.0, loss / terms_); }
    double terms_, n_;
};

/// The best edit beside some of the causes shares the probability of the others.
class Sharer {
  public:
    Sharer(const GapSearch& found, const Judged& by)
        : by_(by),
          weigher_(by),
          view_(without_far_rows(found, by)),
          comparer_(by.comparer.on(view_)),
          left_(comparer_.run(found.setup).loss) {}

    void share(const setup::Setup& setup, const std::vector<GapCause*>& causes) const {
        const ComparedRun run = comparer_.run(setup);
        const auto edits =
            edits_beside(comparer_, setup, run, by_.row_limit, run.loss - weigher_.most(left_));
        if (edits.empty()) return;
        const double odds = std::exp(-weigher_.behind(edits.front().run.loss, left_));
        for (GapCause* cause : causes) {
            cause->probability /= 1.0 + odds;
            cause->rivals.push_back(edit_rival + edits.front().said);
        }
    }

  private:
    const Judged& by_;
    Weigher weigher_;
    LogView view_;
    Comparer comparer_;
    double left_;  ///< loss with all causes
};

}  // namespace

void share_with_edits(const GapQuestion& question, const GapSearch& found, const Judged& by,
                      std::vector<GapCause>& causes) {
    const auto is_asked = [](const GapCause& c) { return c.probability >= worth_asking; };
    if (by.row_limit == infinite_loss || std::none_of(causes.begin(), causes.end(), is_asked))
        return;
    const Sharer sharer(found, by);
    std::vector<GapCause*> all;
    for (std::size_t k = 0; k < causes.size(); ++k) {
        all.push_back(&causes[k]);
        if (causes.size() < 2 || !is_asked(causes[k])) continue;
        setup::Setup setup = question.setup;
        for (std::size_t i = 0; i < causes.size(); ++i)
            if (i != k) found.steps[i].chosen.take(setup);
        sharer.share(setup, {&causes[k]});
    }
    sharer.share(question.setup, all);
}

bool may_be_edit(const GapCause& cause) {
    return std::any_of(cause.rivals.begin(), cause.rivals.end(),
                       [](const std::string& rival) { return rival.starts_with(edit_rival); });
}

std::string agreeing_edit(const GapQuestion& question, const GapSearch& found,
                          const ComparedRun& base, const Judged& by) {
    if (by.row_limit == infinite_loss) return "";
    const auto told = [&](const setup::Setup& setup, const ComparedRun& run) -> std::string {
        const double noise = static_cast<double>(by.blocks.size() * by.comparer.log().axes.size());
        for (const BlockEdit& edit : edits_beside(by.comparer, setup, run, by.row_limit,
                                                  nearly_all * std::max(0.0, run.loss - noise)))
            if (reached(run.losses, edit.run.losses, by.row_limit) >= reaches_rows &&
                !stays_wrong(run.losses, edit.run.losses, by.row_limit))
                return edit.said;
        return "";
    };
    if (std::string said = told(question.setup, base); !said.empty() || found.steps.empty())
        return said;
    return told(found.setup, found.run);
}

}  // namespace trunnion::choices
