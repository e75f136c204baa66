// Compiled blocks of text that runs again, found by place and linked to their successors.
#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/code.h"
#include "interpreter/program_files.h"

namespace trunnion::interpreter {

/// Where a jump leads; `block` is -1 until it was compiled.
struct JumpTarget {
    TextPlace place;
    int block = -1;
};

class BlockCache {
  public:
    /// Number of the block at `byte` of file `file`, or -1.
    int find(int file, std::uint64_t byte) const;
    int add(int file, const Block& block);

    /// When full, the rest of the text is read anew each time; after `patience` such blocks the
    /// runner starts over with an empty cache, so that a new loop gets its place.
    bool full() const;
    static constexpr std::size_t patience = 1u << 17;
    void clear();

    /// Open ends: `next` of block n is n, link n is -2 - n, none is -1.
    static constexpr int of_link(int link) { return -2 - link; }
    void connect(int open_end, int block);

    std::vector<Block> blocks;
    std::vector<JumpTarget> links;
    Code code;

  private:
    struct Entry {
        std::uint64_t key = 0;
        int block = -1;
    };
    static constexpr std::size_t table_size = 1u << 16;
    static constexpr std::size_t most_blocks = table_size / 2;
    static constexpr std::size_t most_code_bytes = 4u << 20;

    std::size_t slot(std::uint64_t key) const;

    std::vector<Entry> table_;  ///< open addressing; empty until the first block comes
};

}  // namespace trunnion::interpreter
