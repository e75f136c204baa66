// Programs for tests of the comparer, made from strings.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "regression/compare_programs.h"
#include "setup/setup.h"

namespace trunnion::testing {

inline interpreter::ProgramText text_of(const std::string& name, const std::string& text) {
    const auto owner = std::make_shared<const std::string>(text);
    return {name, *owner, owner};
}

inline setup::Setup bc_table() {
    std::vector<std::string> notes;
    return setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml", notes);
}

inline regression::Comparison compare_texts(const std::string& a, const std::string& b,
                                            const setup::Setup& setup,
                                            regression::CompareOptions options = {}) {
    return regression::compare_programs(text_of("a.nc", a), setup, text_of("b.nc", b), setup,
                                        options);
}

inline regression::CompareOptions only(regression::Layer layer) {
    regression::CompareOptions options;
    options.by = layer;
    return options;
}

/// The number of the line that holds `text`, from 1.
inline int line_with(const std::string& program, const std::string& text) {
    const std::size_t at = program.find(text);
    return 1 + static_cast<int>(std::count(
                   program.begin(), program.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::logic_error("no '" + what + "' in the program");
    return text.replace(at, what.size(), with);
}

}  // namespace trunnion::testing
