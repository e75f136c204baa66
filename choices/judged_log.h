// One reading of a log judged: its gap, and what explains it.
#pragma once

#include <vector>

#include "choices/compared_run.h"
#include "choices/control_gap.h"
#include "choices/log_meaning.h"
#include "choices/log_view.h"

namespace trunnion::choices {

/// What a log is judged with.
struct Asked {
    const GapQuestion& question;
    interpreter::ProgramSource& programs;
    const std::vector<interpreter::ProgramText>& texts;

    Comparer comparer(const LogOfProgram& log) const {
        return {log.view, question.program, programs, log.path};
    }
    LogSource source(const setup::Setup& setup) const {
        return {question.log, texts,
                [this, &setup](const LogOfProgram& log) { return comparer(log).run(setup); }};
    }
};

struct Answer {
    ControlGap gap;
    setup::Setup reached;  ///< with every cause of the search, claimed or not
    std::size_t left = 0;  ///< blocks that stay far away beside the causes
};

/// Something of the gap stays.
bool is_left(const ControlGap& gap);

/// A structured gap that no row of the tables explains, with its share and its places; it is as
/// sure as there are blocks with it.
void add_unknown(ControlGap& gap, std::size_t blocks, GapCause cause);

/// Of a log that fits the program nowhere: its gap, without a search.
Answer judged_foreign(const Asked& asked, const LogOfProgram& log);

/// By a search of its own, with the noise that the log has.
Answer judged_at_sigma(const Asked& asked, LogOfProgram log);

}  // namespace trunnion::choices
