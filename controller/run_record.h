// Totals of a run so far: moves, time, path length, notes.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "controller/cautions.h"
#include "controller/run_result.h"

namespace trunnion::controller {

struct RunRecord {
    std::uint64_t moves = 0;
    double time_s = 0.0;
    double path_mm = 0.0;
    std::vector<std::string> notes;
    std::set<std::string, std::less<>> noted;
    std::vector<TurnedStart> turned_starts;
    Cautions cautions;

    /// Adds a line to the notes unless it is already there.
    void note(std::string text) {
        if (noted.insert(text).second) notes.push_back(std::move(text));
    }
    /// Adds a start unless its block has one already.
    void add(TurnedStart start) {
        for (const TurnedStart& known : turned_starts)
            if (known.line == start.line && known.program == start.program) return;
        turned_starts.push_back(std::move(start));
    }
};

}  // namespace trunnion::controller
