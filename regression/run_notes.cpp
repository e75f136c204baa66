#include "regression/run_notes.h"

#include <algorithm>

namespace trunnion::regression {

namespace {

bool has(const std::vector<std::string>& notes, const std::string& note) {
    return std::find(notes.begin(), notes.end(), note) != notes.end();
}

}  // namespace

std::vector<std::string> notes_of(const RecordedRun* a, const RecordedRun& b,
                                  const CompareOptions& options) {
    static const std::vector<std::string> none;
    const auto &in_a = a != nullptr ? a->result.notes : none, &in_b = b.result.notes;
    std::vector<std::string> notes;
    for (const std::string& note : in_a) notes.push_back(has(in_b, note) ? note : "A: " + note);
    for (const std::string& note : in_b)
        if (!has(in_a, note)) notes.push_back("B: " + note);
    const bool skips = b.skips || (a != nullptr && a->skips);
    std::string left =
        "not compared: branches that were not taken, blocks behind '/' and M01 as "
        "the operator may switch them";
    if (skips && !options.devices)
        left +=
            ", what a probe would answer (G31 runs to its end; --devices asks the emulated one)";
    notes.push_back(left);
    return notes;
}

}  // namespace trunnion::regression
