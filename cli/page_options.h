// Options of every command that writes a page: --html and --date, and the page's origin.
#pragma once

#include <string>
#include <vector>

#include "report/page.h"

namespace CLI {
class App;
}

namespace trunnion::cli {

struct PageOptions {
    std::string html;  ///< path of the page; empty: none
    std::string date;  ///< shown in its footer
};

/// Adds --html and --date.
void add_page_options(CLI::App& command, PageOptions& options);

/// "trunnion run O8001 --truth": the command in shell syntax, options in the order of the help.
std::string command_text(const CLI::App& command);

/// Foot of a page. The date is that of --date, else of SOURCE_DATE_EPOCH (UTC), else none: the same
/// inputs give the same bytes on any day. Inputs are all files that the command has read so far.
report::PageOrigin page_origin(const CLI::App& command, const PageOptions& options);

/// The file: the page with its foot.
std::string finished_page(report::Page page, const CLI::App& command, const PageOptions& options);

}  // namespace trunnion::cli
