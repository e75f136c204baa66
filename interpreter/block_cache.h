// Compiled blocks of text that is executed repeatedly, found by position and linked to their
// successors.
#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/code.h"
#include "interpreter/program_files.h"

namespace trunnion::interpreter {

/// Target of a jump; `block` is -1 until it is compiled.
struct JumpTarget {
    TextPlace place;
    int block = -1;
};

class BlockCache {
  public:
    /// Number of the block at `byte` of file `file`, or -1.
    int find(int file, std::uint64_t byte) const;
    int add(int file, const Block& block);

    /// When the cache is full, further text is parsed at each execution. After `patience` such
    /// blocks the runner clears the cache, so that a new loop is cached.
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

    std::vector<Entry> table_;  ///< open addressing; empty until the first block is added
};

}  // namespace trunnion::interpreter
