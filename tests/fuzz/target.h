// What every fuzz target shares: the entry point, and a law that ends the program when it is
// broken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace trunnion::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// How many inputs were not refused: the short run wants its corpus to be read to the end.
inline int accepted = 0;

inline void law(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "broken law: %s\n", what);
    std::abort();
}

}  // namespace trunnion::fuzz
