// Totals of a run so far: moves, time, path length, notes.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace trunnion::controller {

struct RunRecord {
    std::uint64_t moves = 0;
    double time_s = 0.0;
    double path_mm = 0.0;
    std::vector<std::string> notes;
    std::set<std::string, std::less<>> noted;

    /// Adds a line to the notes unless it is already there.
    void note(std::string text) {
        if (noted.insert(text).second) notes.push_back(std::move(text));
    }
};

}  // namespace trunnion::controller
