#include "choices/judged_noise.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "choices/row_fit.h"
#include "choices/sparse_noise.h"

namespace trunnion::choices {

namespace {

constexpr double beyond_digits = 1.1;          ///< times the noise of the digits: it is another one
constexpr double clearly_less = 0.7;           ///< of a noise that was seen before
constexpr double dependence_by_chance = 1e-6;  ///< p of differences that depend on the positions

class JudgedByRows {
  public:
    JudgedByRows(const Asked& asked, LogOfProgram log) : asked_(asked), log_(std::move(log)) {}

    Answer judged() const {
        const auto noise = noise_beside(asked_.question.setup);
        if (!noise) return beside_causes(judged_at_sigma(asked_, log_), noise);
        const LogOfProgram noisy = with(*noise);
        Answer answer = judged_at_sigma(asked_, noisy);
        const bool quiet = answer.gap.verdict == GapVerdict::no_gap;
        if (!quiet && !is_left(answer.gap)) return answer;
        // What seems to be noise may be what an exact cause does, or depend on the positions.
        Answer exact = judged_at_sigma(asked_, log_);
        if (!is_left(exact.gap)) return exact;
        if (!quiet) return beside_causes(std::move(answer), noise);
        exact = beside_causes(std::move(exact), noise);
        return !is_left(exact.gap) || depends(noisy) ? exact : answer;
    }

  private:
    /// A gap in most rows hides the noise, until its causes are known.
    Answer beside_causes(Answer answer, const std::optional<SparseNoise>& before) const {
        if (!is_left(answer.gap)) return answer;
        const auto noise = noise_beside(answer.reached);
        if (!noise || (before && noise->sigma > clearly_less * before->sigma)) return answer;
        Answer second = judged_at_sigma(asked_, with(*noise));
        const bool better = second.gap.verdict != GapVerdict::no_gap && !is_left(second.gap);
        return better ? std::move(second) : std::move(answer);
    }
    std::optional<SparseNoise> noise_beside(const setup::Setup& setup) const {
        const ComparedRun run = asked_.comparer(log_).run(setup);
        auto out = sparse_noise(log_.view, run, blocks_of(log_.view, run));
        if (out && out->sigma < beyond_digits * log_.sigma) out.reset();
        return out;
    }
    LogOfProgram with(const SparseNoise& noise) const {
        LogOfProgram out = log_;
        set_sigma(out, noise.sigma);
        out.noise = LogNoise::repeats;
        out.view.freedom = noise.freedom;
        if (!out.view.begins_within && !out.view.from_zero) set_start(asked_.question.log, out);
        out.notes.push_back(fmt::format(
            "the log states no noise: its rows scatter by {:.2g} um about the path; what differs "
            "from row to row by no more than that is not seen",
            1e3 * noise.sigma));
        return out;
    }
    bool depends(const LogOfProgram& noisy) const {
        const ComparedRun run = asked_.comparer(noisy).run(asked_.question.setup);
        return p_of_dependence(noisy.view, run) < dependence_by_chance;
    }

    const Asked& asked_;
    LogOfProgram log_;
};

}  // namespace

Answer judged(const Asked& asked, LogOfProgram log) {
    if (log.noise != LogNoise::assumed || log.dense) return judged_at_sigma(asked, std::move(log));
    return JudgedByRows(asked, std::move(log)).judged();
}

}  // namespace trunnion::choices
