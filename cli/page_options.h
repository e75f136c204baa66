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

/// Footer of a page. The date is that of --date, else of SOURCE_DATE_EPOCH (UTC), else none, so
/// that the same inputs give the same bytes on any day. `inputs`: path and SHA-256 of each input
/// file.
report::PageOrigin page_origin(const CLI::App& command, const PageOptions& options,
                               std::vector<report::PageInput> inputs);

/// Path and SHA-256 of each input file of the command line, and of `also_read` (e.g. the default
/// setup). Folders, standard input and unreadable files are omitted.
std::vector<report::PageInput> page_inputs(const CLI::App& command,
                                           const std::vector<std::string>& also_read = {});

/// The complete file: the page with its footer.
std::string finished_page(report::Page page, const CLI::App& command, const PageOptions& options,
                          const std::vector<std::string>& also_read = {});

}  // namespace trunnion::cli
