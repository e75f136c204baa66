#include "regression/run_notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace trunnion::regression {

namespace {

bool has(const std::vector<std::string>& notes, const std::string& note) {
    return std::find(notes.begin(), notes.end(), note) != notes.end();
}

/// Codes that a reset may or may not set again (parameter 3402): a next program that does not say
/// them starts with what is left.
void add_codes_left(const ControlSnapshot& a, const ControlSnapshot& b,
                    std::vector<std::string>& notes) {
    for (const SnapshotField& field : snapshot_fields()) {
        const std::string_view name = field.name;
        if (name != "units" && name != "absolute or incremental" && name != "feed mode") continue;
        if (field.text(a) != field.text(b))
            notes.push_back(fmt::format("at the end {} is in force in A, {} in B", field.text(a),
                                        field.text(b)));
    }
}

}  // namespace

std::vector<std::string> notes_of(const RecordedRun* a, const RecordedRun& b) {
    static const std::vector<std::string> none;
    const auto &in_a = a != nullptr ? a->result.notes : none, &in_b = b.result.notes;
    std::vector<std::string> notes;
    for (const std::string& note : in_a) notes.push_back(has(in_b, note) ? note : "A: " + note);
    for (const std::string& note : in_b)
        if (!has(in_a, note)) notes.push_back("B: " + note);
    if (a != nullptr) add_codes_left(a->last_state, b.last_state, notes);
    return notes;
}

}  // namespace trunnion::regression
