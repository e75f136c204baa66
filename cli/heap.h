// How memory is taken from the system: work on matrices takes and frees a lot of it (heap.cpp).
#pragma once

namespace trunnion::cli {

/// Keeps what is freed for the next matrix. Once, before anything is allocated.
void keep_freed_memory();

/// Lets the system give memory in large pages, where it has them. For long work on matrices.
void use_large_pages();

}  // namespace trunnion::cli
