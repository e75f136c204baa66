#include "imports/missing_values.h"

#include <fmt/format.h>

namespace trunnion::imports {

void MissingValues::add(int line, const std::string& column) {
    constexpr std::size_t most_told = 4;
    if (count_ < most_told)
        places_ += fmt::format("{}line {}{}", count_ == 0 ? "" : ", ", line,
                               column.empty() ? "" : " '" + column + "'");
    if (count_ == most_told) places_ += " ..";
    ++count_;
}

void MissingValues::note(const std::string& path, std::vector<std::string>& notes) const {
    if (count_ > 0)
        notes.push_back(fmt::format("{}: {} reading{} without a value {} left out: {}", path,
                                    count_, count_ > 1 ? "s" : "", count_ > 1 ? "are" : "is",
                                    places_));
}

}  // namespace trunnion::imports
