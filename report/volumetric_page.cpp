#include "report/volumetric_page.h"

#include <fmt/format.h>

#include "base/rounded.h"
#include "base/units.h"
#include "report/volumetric_pictures.h"
#include "report/volumetric_report.h"

namespace trunnion::report {
namespace {

std::string causes_section(const volumetric::VolumetricMap& map) {
    PageTable table{"", {"cause", "rms / µm", "largest / µm", "share"}, "lrrr", {}};
    for (const volumetric::VolumetricCause& cause : map.causes)
        table.rows.push_back({cause.name, three_digits(um_from_mm(cause.rms_mm), 3),
                              three_digits(um_from_mm(cause.largest_mm), 3),
                              fmt::format("{:.1f} %", 100.0 * cause.share)});
    return section_html("What contributes", table_html(table));
}

std::string pictures_section(const volumetric::VolumetricMap& map) {
    std::string body;
    for (const auto& [name, svg] : volumetric_pictures(map))
        body += figure_html(svg, name == "volumetric_axes.svg"
                                     ? "Worst and rms error along each axis"
                                     : "One height: colour is the length of the error, arrows "
                                       "its X and Y");
    return section_html("Where", body);
}

std::string reading_section(const volumetric::VolumetricMap& map) {
    std::string body = paragraph_html(
        "The error is the physical tip minus the nominal one, in the frame of the table. Each "
        "cause is computed alone; its share is its fraction of the sum of squares of all causes.");
    const auto list = [&](const char* words, const std::vector<Axis>& axes) {
        std::string names;
        for (const Axis axis : axes) names += ' ' + map.names[axis];
        if (!axes.empty()) body += paragraph_html(words + names + ".");
    };
    list("The setup gives no travel, ±200 mm or ±180 degrees assumed:", map.assumed);
    list("The travel goes beyond a table of errors, held at its last value there:", map.clamped);
    return section_html("How to read this", body);
}

}  // namespace

Page volumetric_page(const volumetric::VolumetricMap& map) {
    const volumetric::VolumetricPoint& worst = map.points[map.worst];
    Page page;
    page.title = "Error of the tool point over the working volume";
    page.subject =
        fmt::format("{}, tool {:g} mm, {} poses", map.machine, map.length_mm, map.points.size());
    page.verdict = fmt::format("The largest tip error is {}, at {}{}; rms over all poses {}.",
                               length_words(um_from_mm(worst.error_W_mm.norm())),
                               place_text(map.names, map.axes, worst.at),
                               map.causes.empty() ? "" : ", mostly by " + cause_name(map, worst),
                               length_words(um_from_mm(map.rms_mm)));
    page.body_html = causes_section(map) + pictures_section(map) + reading_section(map);
    return page;
}

}  // namespace trunnion::report
