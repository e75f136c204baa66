// The template of every HTML page: verdict first, then figures, then explanations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/read_file.h"

namespace trunnion::report {

/// Mark of a verdict besides its words: a coloured rule; colour is never the only mark.
enum class Tone : unsigned char { neutral, good, bad };

/// The script of a page. `none`: a page without any script.
enum class PageScript : unsigned char { none, chart, run };

/// A file that the result was made from.
using PageInput = FileRead;

/// Footer of a page: how it was made.
struct PageOrigin {
    std::string command;  ///< as typed, without the folder of the program
    std::string version;  ///< of trunnion
    std::optional<std::uint64_t> seed;
    std::string date;  ///< from --date or SOURCE_DATE_EPOCH; empty: not shown
    std::vector<PageInput> inputs;
};

/// A page as values. Fields named `_html` contain HTML; all others plain text.
struct Page {
    std::string title;    ///< window title, also above the verdict
    std::string subject;  ///< what was examined: programs, machine
    Tone tone = Tone::neutral;
    std::string verdict;  ///< one or two sentences for the workshop
    std::string body_html;
    PageScript script = PageScript::none;
    std::string data_json;  ///< input of the script; one JSON value
    PageOrigin origin;
};

/// The complete file: self-contained, with a content policy that allows only the script with the
/// given hash; readable on a phone of 360 px, on paper and in dark mode. Equal pages give equal
/// bytes.
std::string page_html(const Page& page);

/// `<section>` with a heading. `body_html` is HTML, `heading` plain text.
std::string section_html(const std::string& heading, const std::string& body_html);

/// A picture with caption. `svg` must have a title; `caption` is plain text.
std::string figure_html(const std::string& svg, const std::string& caption);

/// A paragraph of plain text.
std::string paragraph_html(const std::string& text);

/// A table. Cells are plain text; a column with alignment 'r' contains numbers.
struct PageTable {
    std::string caption;
    std::vector<std::string> header;
    std::string alignment;  ///< 'l' or 'r' for each column; default 'l'
    std::vector<std::vector<std::string>> rows;
};
/// On a narrow page the table scrolls horizontally in its own frame.
std::string table_html(const PageTable& table);

}  // namespace trunnion::report
