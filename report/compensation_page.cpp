#include "report/compensation_page.h"

#include <fmt/format.h>

#include "base/rounded.h"
#include "base/units.h"

namespace trunnion::report {
namespace {

std::string um(double mm) {
    return three_digits(um_from_mm(mm), 3);
}

std::string urad(double rad) {
    return three_digits(urad_from_rad(rad), 3);
}

PageTable errors_table(const compensation::CompensatedProgram& c) {
    PageTable table{"Largest errors at a block's end",
                    {"of what", "original", "compensated", "unit"},
                    "lrrl",
                    {}};
    table.rows.push_back({"tip", um(c.before.tip_mm), um(c.after.tip_mm), "µm"});
    table.rows.push_back({"direction where the rotaries correct it", urad(c.before.turned_rad),
                          urad(c.after.turned_rad), "µrad"});
    table.rows.push_back({"direction where they keep their words", urad(c.before.kept_rad),
                          urad(c.after.kept_rad), "µrad"});
    if (c.in_gap.tip_mm > 0.0)
        table.rows.push_back({"tip, while an axis that turned round is inside its gap", "",
                              um(c.in_gap.tip_mm), "µm"});
    return table;
}

}  // namespace

Page compensation_page(const compensation::CompensatedProgram& c, const std::string& machine,
                       const std::string& program) {
    Page page;
    page.title = "Compensated program";
    page.subject = program + " on " + machine;
    page.verdict =
        fmt::format("The tip error falls from {} to {}: the largest at the ends of {} blocks.",
                    length_words(um_from_mm(c.before.tip_mm)),
                    length_words(um_from_mm(c.after.tip_mm)), c.blocks.size());
    page.tone = c.after.tip_mm <= c.before.tip_mm ? Tone::good : Tone::bad;
    page.body_html = section_html("Before and after", table_html(errors_table(c)));
    std::string notes;
    for (const std::string& note : c.notes) notes += paragraph_html(note);
    if (!notes.empty()) page.body_html += section_html("Notes", notes);
    page.body_html += section_html(
        "How to read this",
        paragraph_html("Both programs were executed on the emulated control. The error is the "
                       "physical tip, with the errors and effects of the setup, minus the tip that "
                       "the control of the original believes.") +
            paragraph_html(
                "The setup's errors must be those of the machine: identify them first."));
    return page;
}

}  // namespace trunnion::report
