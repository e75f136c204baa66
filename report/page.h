// One template for every HTML page: verdict first, then figures, then how to read them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace trunnion::report {

/// How a verdict is marked beside its words: by a rule in colour, never by colour alone.
enum class Tone : unsigned char { neutral, good, bad };

/// The scripts that a page may carry. `none` leaves a page without any script.
enum class PageScript : unsigned char { none, chart, run };

/// A file that the result was made from.
struct PageInput {
    std::string path;
    std::string sha256;  ///< 64 hexadecimal digits
};

/// What the foot of a page says about its making.
struct PageOrigin {
    std::string command;  ///< as typed, without the program's folder
    std::string version;  ///< of trunnion
    std::optional<std::uint64_t> seed;
    std::string date;  ///< as given by --date or SOURCE_DATE_EPOCH; empty: none is shown
    std::vector<PageInput> inputs;
};

/// A page as values. All `_html` fields are HTML already; all others are plain text.
struct Page {
    std::string title;    ///< in the window's title and above the verdict
    std::string subject;  ///< what was looked at: programs, machine
    Tone tone = Tone::neutral;
    std::string verdict;  ///< one or two sentences a shop reads
    std::string body_html;
    PageScript script = PageScript::none;
    std::string data_json;  ///< what the script reads; one JSON value
    PageOrigin origin;
};

/// The whole file: self-contained, under a content policy that runs only the script named by its
/// hash, readable on a phone of 360 px, on paper and in the dark. Same page, same bytes.
std::string page_html(const Page& page);

/// `<section>` with a heading. `body_html` is HTML, `heading` plain text.
std::string section_html(const std::string& heading, const std::string& body_html);

/// A picture with its caption. `svg` must have a title; `caption` is plain text.
std::string figure_html(const std::string& svg, const std::string& caption);

/// A paragraph of plain text.
std::string paragraph_html(const std::string& text);

/// A table. Cells are plain text; a column whose alignment is 'r' holds numbers.
struct PageTable {
    std::string caption;
    std::vector<std::string> header;
    std::string alignment;  ///< 'l' or 'r' for each column; missing ones are 'l'
    std::vector<std::vector<std::string>> rows;
};
/// Scrolls sideways inside its own frame where the page is narrow.
std::string table_html(const PageTable& table);

}  // namespace trunnion::report
