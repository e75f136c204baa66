#include "choices/inch_rounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace trunnion::choices {

namespace {

constexpr double increment_mm = 25.4e-4;  ///< Fanuc, increment system IS-B: 0.0001 inch
constexpr double beside_sigmas = 3.0;

/// G20, or G70 of a Hurco's BNC, anywhere.
bool has_inches(const std::vector<interpreter::ProgramText>& texts, bool hurco) {
    const auto has = [](const std::string& text, const char* code) {
        for (std::size_t at = text.find(code); at != std::string::npos;
             at = text.find(code, at + 1)) {
            const std::size_t end = at + 3;
            if (end >= text.size() ||
                (!std::isdigit(static_cast<unsigned char>(text[end])) && text[end] != '.'))
                return true;
        }
        return false;
    };
    return std::any_of(texts.begin(), texts.end(), [&](const interpreter::ProgramText& program) {
        const std::string text(program.text);
        return has(text, "G20") || (hurco && has(text, "G70"));
    });
}

}  // namespace

void settle_inch_rounding(const Asked& asked, const LogOfProgram& log, Answer& answer) {
    ControlGap& gap = answer.gap;
    const bool claims = std::any_of(gap.causes.begin(), gap.causes.end(),
                                    [](const GapCause& c) { return c.known && is_claimed(c); });
    if (gap.verdict != GapVerdict::unexplained || claims || log.noise == LogNoise::given ||
        !has_inches(asked.texts,
                    asked.question.setup.dialect.family == interpreter::DialectFamily::hurco))
        return;
    const ComparedRun run = asked.comparer(log).run(asked.question.setup);
    const double most = increment_mm + beside_sigmas * log.sigma;
    for (const Pair& pair : run.pairs)
        for (const Axis axis : log.view.axes)
            if (std::abs(pair.apart[axis]) > most) return;
    gap.verdict = GapVerdict::no_gap;
    gap.causes.clear();
    gap.left.clear();
    gap.notes.push_back(fmt::format(
        "the log differs by {:.2g} um at most: no more than 0.0001 inch, in which a control counts "
        "this program's inches",
        1000.0 * gap.worst.apart));
}

}  // namespace trunnion::choices
