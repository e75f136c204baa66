// Style sheet and scripts of the pages, compiled in from web/dist with their hashes.
#pragma once

#include <string_view>

namespace trunnion::report {

struct PageAsset {
    std::string_view text;
    std::string_view hash;  ///< "sha256-...", as a content policy names it
};

// Written by cmake/page_assets.cmake at build time.
extern const PageAsset page_style;
extern const PageAsset chart_script;
extern const PageAsset run_script;

}  // namespace trunnion::report
