// Vectors of eight numbers for innermost loops.
//
// Width       a function marked TRUNNION_WIDE_VECTORS is compiled for several processors, and the
//             one that runs decides at the start. Operations are those on eight separate numbers at
//             any width, without contraction (-ffp-contract=off): the results are the same on every
//             processor.
// Failure     none. Reads and writes are unaligned.
#pragma once

#include <cstring>

// Sanitizers would look into the choice, which is made before they are ready.
#if defined(__x86_64__) && defined(__linux__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TRUNNION_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TRUNNION_WIDE_VECTORS
#endif

namespace trunnion::estimation {

constexpr int lanes = 8;
using Lanes [[gnu::vector_size(lanes * sizeof(double))]] = double;
using HalfLanes [[gnu::vector_size(lanes / 2 * sizeof(double))]] = double;

/// Does one register hold all lanes? Where not, sums of half of them at a time stay in registers.
inline bool has_widest_vectors() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f");
#else
    return false;
#endif
}

template <class Part>
inline __attribute__((always_inline)) void load(const double* from, Part& to) {
    std::memcpy(&to, from, sizeof to);
}

inline __attribute__((always_inline)) void store(const Lanes& from, double* to) {
    std::memcpy(to, &from, sizeof from);
}

}  // namespace trunnion::estimation
