#include "report/control_gap_page.h"

#include <fmt/format.h>

#include "base/rounded.h"
#include "base/text.h"
#include "report/control_gap_report.h"

namespace trunnion::report {

namespace {

std::string gap_size(double apart) {
    return three_digits(apart, 4);
}

PageTable cause_table(const choices::ControlGap& gap) {
    PageTable table{"",
                    {"cause", "what it does", "share, %", "probability", "could also be",
                     "left-out blocks, rms", "shrinks by, %"},
                    "llrrlll",
                    {}};
    for (const choices::GapCause& c : gap.causes) {
        std::string what = c.what;
        for (const choices::FittedNumber& n : c.numbers) what += "; " + number_words(n);
        const std::string rivals = fmt::format("{}", fmt::join(c.rivals, ", "));
        const std::string left_out = fmt::format("{} to {}", length_words(c.heldout.before_um),
                                                 length_words(c.heldout.after_um));
        const std::string shrink = fmt::format("{} ({} to {})", percent(c.heldout.shrink),
                                               percent(c.heldout.low), percent(c.heldout.high));
        // What no cause explains predicts nothing.
        table.rows.push_back({c.name, what, percent(c.share), probability_words(c.probability),
                              rivals.empty() ? "none" : rivals, c.known ? left_out : "",
                              c.known ? shrink : ""});
    }
    return table;
}

PageTable cause_places(const choices::ControlGap& gap) {
    PageTable table{
        "", {"cause", "blocks", "first", "mm or deg", "worst", "mm or deg"}, "lrlrlr", {}};
    for (const choices::GapCause& c : gap.causes)
        table.rows.push_back({c.name, std::to_string(c.blocks), place_words(c.first),
                              gap_size(c.first.apart), place_words(c.worst),
                              gap_size(c.worst.apart)});
    return table;
}

PageTable block_table(const std::vector<choices::GapBlock>& blocks) {
    PageTable table{"", {"block", "up to, mm or deg", "share, %", "line of the log"}, "lrrr", {}};
    for (const choices::GapBlock& b : blocks)
        table.rows.push_back({place_words(b.worst), gap_size(b.worst.apart), percent(b.share),
                              std::to_string(b.worst.log_line)});
    return table;
}

Tone gap_tone(choices::GapVerdict verdict) {
    if (verdict == choices::GapVerdict::no_gap) return Tone::good;
    return verdict == choices::GapVerdict::explained ? Tone::neutral : Tone::bad;
}

std::string gap_sections(const choices::ControlGap& gap) {
    std::string out;
    if (!gap.causes.empty())
        out += section_html("Which choice or store", table_html(cause_table(gap))) +
               section_html("Where each shows", table_html(cause_places(gap)));
    if (!gap.where.empty())
        out += section_html("Blocks with most of the gap", table_html(block_table(gap.where)));
    if (!gap.causes.empty() && !gap.left.empty())
        out += section_html("What stays", table_html(block_table(gap.left)));
    return out;
}

std::string gap_notes(const choices::ControlGap& gap) {
    std::string notes;
    for (const std::string& note : gap.notes) notes += paragraph_html(printable(note));
    return notes.empty() ? "" : section_html("Notes", notes);
}

std::string how_to_read(const choices::ControlGap& gap) {
    std::string out = paragraph_html(
        "The program ran on the emulated control once for each choice and each store of its "
        "tables; each logged position was compared with the end position of its block. A cause is "
        "reported only if blocks that took no part in the decision improve too. A choice without "
        "listed rivals may have one that is not in the table.");
    if (!gap.unseen.empty())
        out += fmt::format(
            "<details><summary>{} settings and stores that this program cannot tell</summary>{}"
            "</details>\n",
            gap.unseen.size(), paragraph_html(fmt::format("{}", fmt::join(gap.unseen, ", "))));
    return section_html("How to read this", out);
}

}  // namespace

Page control_gap_page(const choices::ControlGap& gap, const std::string& log,
                      const std::string& program) {
    Page page;
    page.title = "Control log against emulated control";
    page.subject = valid_utf8(fmt::format("log {}; program {}", log, program));
    page.verdict = verdict_sentence(gap);
    if (!gap.stopped.empty())
        page.verdict += " This control stops: " + printable(gap.stopped) + ".";
    page.tone = gap_tone(gap.verdict);
    page.body_html = gap_sections(gap) + gap_notes(gap) + how_to_read(gap);
    return page;
}

}  // namespace trunnion::report
