#include "cli/heap.h"

#include <array>
#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <malloc.h>
#include <sys/mman.h>
#endif

namespace trunnion::cli {
#ifdef __GLIBC__
namespace {

constexpr int megabyte = 1 << 20;
constexpr std::size_t block = std::size_t{31} * megabyte;  // below the threshold of own mappings

/// Asks for large pages in a free block of the heap.
void advise(void* memory) {
    constexpr std::uintptr_t page = 2 * megabyte;
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + block) / page * page;
    // A system without them ignores it.
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace

// Matrices of a few megabytes are allocated and freed all the time. Without this glibc takes each
// of them from the kernel anew, page by page, a fifth of the time of `diagnose`.
void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 32 * megabyte);  // the most that it accepts
    mallopt(M_TRIM_THRESHOLD, 256 * megabyte);
    mallopt(M_TOP_PAD, 4 * megabyte);
}

// The first touch of each small page is a tenth of the time of `diagnose`. Blocks are taken from
// the end of the heap, and stay there when they are freed.
void use_large_pages() {
    std::array<void*, 6> blocks{};
    for (void*& memory : blocks)
        if ((memory = std::malloc(block)) != nullptr) advise(memory);
    for (void* memory : blocks) std::free(memory);
}
#else
void keep_freed_memory() {}
void use_large_pages() {}
#endif

}  // namespace trunnion::cli
