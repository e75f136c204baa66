#include "regression/run_notes.h"

#include <algorithm>

namespace trunnion::regression {

namespace {

bool has(const std::vector<std::string>& notes, const std::string& note) {
    return std::find(notes.begin(), notes.end(), note) != notes.end();
}

}  // namespace

std::vector<std::string> notes_of(const RecordedRun* a, const RecordedRun& b) {
    static const std::vector<std::string> none;
    const auto &in_a = a != nullptr ? a->result.notes : none, &in_b = b.result.notes;
    std::vector<std::string> notes;
    for (const std::string& note : in_a) notes.push_back(has(in_b, note) ? note : "A: " + note);
    for (const std::string& note : in_b)
        if (!has(in_a, note)) notes.push_back("B: " + note);
    return notes;
}

}  // namespace trunnion::regression
