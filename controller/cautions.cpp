#include "controller/cautions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trunnion::controller {

namespace {

constexpr std::size_t most_kept = 200;  ///< a program may hold any number of arcs

struct CautionRow {
    CautionKind kind;
    const char *rule, *remedy;
};
constexpr CautionRow caution_rows[] = {
    {CautionKind::bare_words, "decimal-point",
     "Write the decimal points, or give parameter 3401 of the control in the setup."},
    {CautionKind::unset_offset, "offset",
     "Correct the number, or give the offset in [control.tools] of the setup (0 if it is 0)."},
    {CautionKind::no_offset, "offset", "Write the number of the offset."},
    {CautionKind::open_arc, "arc-radius",
     "Correct the end point or the centre (I, J, K from the start)."},
    {CautionKind::straight_arc, "arc-radius", "Write R or the centre, or G1."},
};

const CautionRow& row_of(CautionKind kind) {
    for (const CautionRow& row : caution_rows)
        if (row.kind == kind) return row;
    return caution_rows[0];
}

const char* what_is_used(char letter) {
    return letter == 'D' ? "a radius of 0 is used" : "a length of 0 is used";
}

std::string offsets_note(const std::vector<Caution>& all) {
    std::string names;
    for (const Caution& c : all)
        if (c.kind == CautionKind::unset_offset)
            names += fmt::format("{}{}{} (line {})", names.empty() ? "" : ", ", c.letter, c.number,
                                 c.line);
    return names.empty() ? names : "offsets that the setup does not set are used as 0: " + names;
}

std::string arcs_note(const std::vector<Caution>& all, std::size_t more) {
    std::size_t count = more;
    const Caution* first = nullptr;
    double widest = 0.0;
    for (const Caution& c : all) {
        if (c.kind != CautionKind::open_arc) continue;
        if (!first) first = &c;
        widest = std::max(widest, std::abs(c.end_mm - c.start_mm));
        ++count;
    }
    if (!first) return {};
    return fmt::format(
        "{} arc{} off the circle by up to {:.4f} mm, the first in line {}: with "
        "parameter 3410 at 0 or not given this is no alarm (else PS0020)",
        count, count == 1 ? " ends" : "s end", widest, first->line);
}

std::string text_of(const Caution& c) {
    switch (c.kind) {
        case CautionKind::bare_words:
            return "numbers without a decimal point are read as whole units (parameter 3401 is not "
                   "given; with 3401#0 = 0 they would be least increments)";
        case CautionKind::unset_offset:
            return fmt::format("the setup does not set offset {}{}: {}", c.letter, c.number,
                               what_is_used(c.letter));
        case CautionKind::no_offset:
            return fmt::format("{} without {} so far: {}",
                               c.letter == 'D' ? "G41 or G42" : "tool length compensation",
                               c.letter, what_is_used(c.letter));
        case CautionKind::straight_arc:
            return "G2 or G3 without R and centre: a straight line (3403#5 = 0)";
        case CautionKind::open_arc: break;
    }
    return fmt::format("radius {:.4f} at the arc's start and {:.4f} at its end", c.start_mm,
                       c.end_mm);
}

}  // namespace

ToldCaution told(const Caution& caution) {
    const CautionRow& row = row_of(caution.kind);
    return {row.rule, text_of(caution), row.remedy};
}

void Cautions::add(const Caution& c) {
    const bool offset = c.kind == CautionKind::unset_offset || c.kind == CautionKind::no_offset;
    if (offset && !offsets_.emplace(c.letter, c.number).second) return;
    if (c.kind == CautionKind::straight_arc && std::exchange(straight_told_, true)) return;
    if (c.kind == CautionKind::open_arc && !arc_lines_.insert(c.line).second) return;
    if (all_.size() == most_kept) {
        if (c.kind == CautionKind::open_arc) ++more_;
        return;
    }
    all_.push_back(c);
    fresh_.push_back(c);
}

std::vector<std::string> Cautions::notes() const {
    std::vector<std::string> out;
    for (const Caution& c : all_) {
        if (c.kind == CautionKind::bare_words) out.push_back(text_of(c));
        if (c.kind == CautionKind::no_offset || c.kind == CautionKind::straight_arc)
            out.push_back(fmt::format("line {}: {}", c.line, text_of(c)));
    }
    for (std::string line : {offsets_note(all_), arcs_note(all_, more_)})
        if (!line.empty()) out.push_back(std::move(line));
    return out;
}

}  // namespace trunnion::controller
