// A log made by one setup's control, judged with another's, in memory.
#pragma once

#include <catch2/catch.hpp>

#include "choices/control_gap.h"

namespace trunnion::log_bench {

inline setup::Setup setup_of(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "s.toml", notes);
}

inline interpreter::ProgramText program_of(const std::string& text) {
    return {"p.nc", text, nullptr};
}

/// The ends of all moves, as a trace gives them.
inline records::PositionLog log_of(const setup::Setup& there, const std::string& program) {
    interpreter::ProgramsInMemory none;
    choices::PathOptions ends;
    ends.ends_only = true;
    const choices::ControlPath path = path_of(there, program_of(program), none, ends);
    records::PositionLog log;
    log.path = "log.csv";
    for (const kinematics::AxisGeometry& axis : there.machine.chain.axes())
        log.axes.push_back(axis.axis);
    log.ends = true;
    log.blocks = records::BlockColumn::line;
    log.step = 1e-6;
    for (std::size_t k = 1; k < path.nodes.size(); ++k) {
        records::LoggedPosition row;
        row.at = offsets::axis_positions_of(path.nodes[k].at);
        row.block = path.blocks[path.nodes[k].block].line;
        row.end = true;
        row.line = static_cast<int>(k) + 1;
        log.rows.push_back(row);
    }
    return log;
}

inline choices::ControlGap gap_of(const setup::Setup& here, const records::PositionLog& log,
                                  const std::string& program) {
    interpreter::ProgramsInMemory none;
    const interpreter::ProgramText text = program_of(program);
    return choices::control_gap({here, log, text, 1'000'000, {}}, none,
                                [&text] { return std::vector{text}; });
}

}  // namespace trunnion::log_bench
